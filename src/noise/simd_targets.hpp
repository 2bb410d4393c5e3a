#pragma once
// Which instruction sets Highway compiles for; include before any of its headers. Highway counts
// AES to the baseline of AVX2, which x86-64-v3 lacks; nothing here uses it.

#define HWY_DISABLE_PCLMUL_AES 1
