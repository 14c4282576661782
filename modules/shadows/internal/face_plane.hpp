// SPDX-License-Identifier: MIT
//
// The face plane in single precision and the bound on its error. With u = 2^-24 and e = 2^-53, for
// exact corners a, b, c:
//
//   n = (b - a) x (c - a) in double:  |error of n_i| <= 5 e P_i,  P_i = |e1_j e2_k| + |e1_k e2_j|
//   rounded to float:                 |error of n_i| <= E_n = u max|n_i| + 5 e max P_i
//   d = -n . a:  |error of d| <= E_d = u |d| + sum |a_i| (5 e P_i + 4 e |n_i|)
//   s = n . L + d w in float adds 4 u (sum |n_i L_i| + |d w|) <= 4 (E_n sum |L_i| + E_d |w|)
//
// so |s - exact| <= 5 (E_n sum |L_i| + E_d |w|) plus underflow. What is stored is 6 E_n and 6 E_d
// rounded up, which covers the rounding of the bound's own evaluation; facing.cpp adds the smallest
// normal number for underflow.
#pragma once

#include <cmath>
#include <limits>

#include <glm/glm.hpp>

#include <gnomon/shadows/orientation.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

namespace gnomon::shadows::internal {

inline float round_up(double value) {
    const auto rounded = static_cast<float>(value);
    return static_cast<double>(rounded) < value
               ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
               : rounded;
}

/// A face without area, exactly: normal and bounds are all zero.
inline bool is_degenerate(const FacePlane& plane) {
    return plane.normal == glm::vec3(0.0F) && plane.normal_error == 0.0F &&
           plane.offset_error == 0.0F;
}

inline FacePlane make_face_plane(const glm::vec3& a_float, const glm::vec3& b, const glm::vec3& c) {
    constexpr double u = 0x1p-24;
    constexpr double e = 0x1p-53;
    const glm::dvec3 a(a_float);
    const glm::dvec3 e1 = glm::dvec3(b) - a;
    const glm::dvec3 e2 = glm::dvec3(c) - a;
    const glm::dvec3 n = glm::cross(e1, e2);
    glm::dvec3 permanent;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        permanent[i] = std::abs(e1[j] * e2[k]) + std::abs(e1[k] * e2[j]);
    }
    const double worst = std::max({permanent.x, permanent.y, permanent.z});
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (largest <= 5.0 * e * worst && exactly_collinear(a_float, b, c)) return {};

    const double d = -glm::dot(n, a);
    double offset_error = u * std::abs(d);
    for (int i = 0; i < 3; ++i) {
        offset_error += std::abs(a[i]) * (5.0 * e * permanent[i] + 4.0 * e * std::abs(n[i]));
    }
    FacePlane plane;
    plane.normal = glm::vec3(n);
    plane.offset = static_cast<float>(d);
    plane.normal_error = round_up(6.0 * (u * largest + 5.0 * e * worst +
                                         static_cast<double>(std::numeric_limits<float>::min())));
    plane.offset_error =
        round_up(6.0 * (offset_error + static_cast<double>(std::numeric_limits<float>::min())));
    return plane;
}

}  // namespace gnomon::shadows::internal
