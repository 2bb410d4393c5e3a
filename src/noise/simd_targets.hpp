#pragma once
// Which instruction sets Highway compiles for; include before any of its headers. Highway counts
// AES to the baseline of AVX2, which x86-64-v3 lacks; nothing here uses it. Vectors without a fixed
// size (SVE) cannot be members of a struct.

#define HWY_DISABLE_PCLMUL_AES 1
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
