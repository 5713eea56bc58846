// Loops that are compiled for several machines: the baseline, and those with vectors of 32 and of 64 bytes.
#pragma once

/// Written before a function. All versions give the same bits: vectors reorder no sums, and `-ffp-contract=off` fuses
/// no operations.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#if __GNUC__ >= 12  // older ones cannot choose by levels
#define MRPBENCH_WIDE __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define MRPBENCH_WIDE __attribute__((target_clones("avx2", "default")))
#endif
#else
#define MRPBENCH_WIDE
#endif

/// Written before a loop whose rows do not overlap, where there are too many to compare at run time.
#if defined(__clang__)
#define MRPBENCH_NO_OVERLAP _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define MRPBENCH_NO_OVERLAP _Pragma("GCC ivdep")
#else
#define MRPBENCH_NO_OVERLAP
#endif
