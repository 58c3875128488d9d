#pragma once

/// SHELFBEAM_FOR_EACH_CPU compiles a function for several kinds of processor; the program selects the best
/// version when it starts. SHELFBEAM_VECTORIZE precedes a loop over lanes with independent iterations. Files
/// named *_kernels.cpp are compiled without errno and floating-point traps (cmake/layer.cmake).

// Function multiversioning is resolved before the sanitizers start, which crashes the program.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SHELFBEAM_FOR_EACH_CPU __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#define SHELFBEAM_INLINE __attribute__((always_inline))
#else
#define SHELFBEAM_FOR_EACH_CPU
#define SHELFBEAM_INLINE
#endif
// The compiler does not vectorize loops over lanes that it has unrolled completely.
#if defined(__GNUC__) && !defined(__clang__)
#define SHELFBEAM_VECTORIZE _Pragma("GCC ivdep") _Pragma("GCC unroll 1")
#else
#define SHELFBEAM_VECTORIZE
#endif
