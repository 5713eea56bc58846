// Loops that are compiled twice: for the baseline machine, and for vectors of 32 bytes where the machine has them.
#pragma once

/// Written before a function. Both versions give the same bits: AVX2 alone fuses no operations and reorders no sums.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define MRPBENCH_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define MRPBENCH_WIDE
#endif
