#pragma once

/// A function compiled for newer instruction sets too, the one that the machine has chosen when the
/// program starts. "avx2" asks for the instructions; an "arch" would ask for one maker's processor.
/// WIDELY: for sixteen numbers at once as well, where that was measured to gain. Without
/// contraction all give the same bytes. Sanitizers run before the choice is made, so they get the
/// plain one.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FRANGIA_VECTORIZED __attribute__((target_clones("avx2", "default")))
#define FRANGIA_VECTORIZED_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define FRANGIA_VECTORIZED
#define FRANGIA_VECTORIZED_WIDE
#endif
