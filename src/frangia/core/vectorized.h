#pragma once

/// Compiles a function for several instruction sets; the program chooses one for the machine when
/// it starts. "avx2" selects by instruction set, whereas "arch=..." would select by processor
/// vendor. FRANGIA_VECTORIZED_WIDE adds AVX-512 and is used only where a measurement showed a gain.
/// All versions give the same bytes, because floating-point contraction is off. Sanitizers run
/// before the choice is made, so sanitizer builds use the default version only.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FRANGIA_VECTORIZED __attribute__((target_clones("avx2", "default")))
#define FRANGIA_VECTORIZED_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define FRANGIA_VECTORIZED
#define FRANGIA_VECTORIZED_WIDE
#endif
