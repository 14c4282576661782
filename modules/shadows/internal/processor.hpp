// SPDX-License-Identifier: MIT
//
// What the processor at hand can do beyond the language and the compiler's own target. Functions
// that use more carry the attribute `gnu::target`; nothing else is compiled for them.
#pragma once

#if defined(__GNUC__) && defined(__x86_64__)
#define GNOMON_HAS_AVX2
#include <immintrin.h>
#endif

namespace gnomon::shadows::internal {

/// Has memory fetched that is read soon; a hint, which no result depends on.
inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__)
    __builtin_prefetch(address);
#endif
}

#ifdef GNOMON_HAS_AVX2
inline bool has_avx2() {
    return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("popcnt") != 0;
}
#endif

}  // namespace gnomon::shadows::internal
