#pragma once

/// Stands before a function whose loops are worth long vectors: g++ compiles it for each of three generations
/// of x86-64 processors (2, 4 and 8 numbers at a time), and the program takes the one for its processor when
/// it starts. What it calls has to be inlined to gain. All of them give the same bits: no operation is fused
/// or reordered (docs/decisions/0001). Nothing happens in a build for one processor (RECOIL_NATIVE), for
/// others than x86-64, and with clang++. Loops in them without a reduction carry `#pragma GCC ivdep`, not
/// `omp simd`: behind the last whole vector g++ then goes on with shorter ones (docs/decisions/0033).
#if defined(__x86_64__) && !defined(__AVX2__) && defined(__GNUC__) && !defined(__clang__)
#define RECOIL_MULTIVERSION [[gnu::target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")]]
#else
#define RECOIL_MULTIVERSION
#endif

/// What such a function calls is inlined: before functions, and behind the parameters of lambdas.
#define RECOIL_INLINE __attribute__((always_inline))
