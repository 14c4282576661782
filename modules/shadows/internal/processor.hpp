// SPDX-License-Identifier: MIT
//
// Which instructions beyond the compiler's own target the processor at hand has. Functions that use
// them carry the attribute `gnu::target`; nothing else is compiled for them.
#pragma once

#if defined(__GNUC__) && defined(__x86_64__)
#define GNOMON_HAS_AVX2
#include <immintrin.h>
#endif

namespace gnomon::shadows::internal {

#ifdef GNOMON_HAS_AVX2
inline bool has_avx2() { return __builtin_cpu_supports("avx2") != 0; }
#endif

}  // namespace gnomon::shadows::internal
