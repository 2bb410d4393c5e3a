# Compiler settings for every target: `wold_options`.

include(CheckCXXCompilerFlag)

add_library(wold_options INTERFACE)
target_include_directories(wold_options INTERFACE ${CMAKE_SOURCE_DIR}/src)

# Contraction to fused multiply-add is the compiler's choice, and differs from one to the next: the
# same input must give the same bits. Where speed asks for it, code says so (Highway's MulAdd).
target_compile_options(wold_options INTERFACE -ffp-contract=off -fno-math-errno
                       -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                       -Wnon-virtual-dtor -Wcast-align -Wunused -Woverloaded-virtual)
if(WOLD_WERROR)
  target_compile_options(wold_options INTERFACE -Werror)
endif()

if(WOLD_ARCH AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  check_cxx_compiler_flag(-march=${WOLD_ARCH} WOLD_HAS_ARCH)
  if(WOLD_HAS_ARCH)
    target_compile_options(wold_options INTERFACE -march=${WOLD_ARCH})
  else()
    message(WARNING "The compiler does not know -march=${WOLD_ARCH}; using its default.")
  endif()
endif()

set(WOLD_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize, e.g. address,undefined or thread")
if(WOLD_SANITIZE)
  target_compile_options(wold_options INTERFACE -fsanitize=${WOLD_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(wold_options INTERFACE -fsanitize=${WOLD_SANITIZE})
endif()

if(WOLD_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "WOLD_FUZZ needs clang: cmake --preset fuzz")
  endif()
  target_compile_options(wold_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

find_program(WOLD_CCACHE ccache)
if(WOLD_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${WOLD_CCACHE})
endif()
find_program(WOLD_MOLD mold)
if(WOLD_MOLD)
  add_link_options(-fuse-ld=mold)
endif()
