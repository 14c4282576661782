// SPDX-License-Identifier: MIT
//
// GNOMON_EXPECTS: states what a caller owes a function. It is checked in debug builds and in builds
// that define GNOMON_CHECKED (all test presets); a violation prints the condition and its place and
// aborts. It is for a caller's bug alone: bad data is a Result (result.hpp).
#pragma once

#include <cstdio>
#include <cstdlib>

#if !defined(NDEBUG) || defined(GNOMON_CHECKED)
/// States what the caller owes. Where it does not hold and checks are on, prints condition and
/// place and aborts; where they are off, the condition is not looked at.
#define GNOMON_EXPECTS(condition)                                                                 \
    ((condition) ? static_cast<void>(0)                                                           \
                 : (std::fprintf(stderr, "%s:%d: expected %s\n", __FILE__, __LINE__, #condition), \
                    std::abort()))
#else
#define GNOMON_EXPECTS(condition) static_cast<void>(0)
#endif
