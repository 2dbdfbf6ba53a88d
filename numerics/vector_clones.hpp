#pragma once

/// Before the definition of a function whose loops the compiler vectorises: it is compiled for
/// wider registers as well, and the processor's own are chosen when the program starts. The same
/// operations in the same order, so the same bits on every machine. Without effect where compiler
/// or sanitizer do not get along with such clones.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define BORESIGHT_VECTOR_CLONES [[gnu::target_clones("default", "avx2", "avx512f")]]
#else
#define BORESIGHT_VECTOR_CLONES
#endif
