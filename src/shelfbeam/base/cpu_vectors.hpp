#pragma once

/// SHELFBEAM_FOR_EACH_CPU compiles a function for several kinds of processor, of which the best is chosen
/// when the program starts; SHELFBEAM_VECTORIZE stands before a loop over lanes whose iterations are
/// independent. Such files are compiled without errno and floating-point traps (src/CMakeLists.txt).

// Function multiversioning resolves before sanitizers have started, which they do not survive.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SHELFBEAM_FOR_EACH_CPU __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#define SHELFBEAM_INLINE __attribute__((always_inline))
#else
#define SHELFBEAM_FOR_EACH_CPU
#define SHELFBEAM_INLINE
#endif
// Unrolled whole, loops over lanes would no longer be turned into vectors.
#if defined(__GNUC__) && !defined(__clang__)
#define SHELFBEAM_VECTORIZE _Pragma("GCC ivdep") _Pragma("GCC unroll 1")
#else
#define SHELFBEAM_VECTORIZE
#endif
