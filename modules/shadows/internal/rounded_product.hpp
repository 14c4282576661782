// SPDX-License-Identifier: MIT
//
// A product that is rounded whatever the compiler may fuse (-ffp-contract=fast).
#pragma once

namespace gnomon::shadows::internal {

/// a * b, rounded to double. Written to memory and read back, so that it cannot become part of a
/// fused multiply-add: for places where other bits would mean another decision.
inline double rounded_product(double a, double b) {
    const volatile double rounded = a * b;
    return rounded;
}

}  // namespace gnomon::shadows::internal
