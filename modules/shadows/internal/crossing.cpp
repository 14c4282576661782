// SPDX-License-Identifier: MIT
#include "crossing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <gnomon/shadows/orientation.hpp>

namespace gnomon::shadows::internal {

namespace {

/// The sign of det(u, v, w), or 0 where its rounding might have decided. The bound is Shewchuk's,
/// (7 + 56 e) e times the permanent, which allows for vectors that are rounded differences; 8 e
/// covers the products of the permanent itself.
int certain_sign(const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& w) {
    const glm::dvec3 n = glm::cross(u, v);
    const double det = glm::dot(n, w);
    const glm::dvec3 minors(std::abs(u.y * v.z) + std::abs(u.z * v.y),
                            std::abs(u.z * v.x) + std::abs(u.x * v.z),
                            std::abs(u.x * v.y) + std::abs(u.y * v.x));
    const double bound = 8.0 * 0x1p-53 * glm::dot(minors, glm::abs(w));
    return det > bound ? 1 : (det < -bound ? -1 : 0);
}

}  // namespace

int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                const glm::dvec4& light) {
    const glm::dvec3 towards = glm::dvec3(light) - light.w * a;
    const int sign = certain_sign(b - a, c - a, towards);
    return sign != 0 ? sign : exact_orientation(a, b, c, light);
}

Sight::Sight(const glm::dvec3& point, const glm::dvec4& light, double slack)
    : point_(point),
      light_(light),
      towards_(glm::dvec3(light) - light.w * point),
      inverse_(1.0 / towards_),
      slack_(slack),
      end_(light.w != 0.0 ? 1.0 : std::numeric_limits<double>::infinity()) {}

bool Sight::enters(const Box<double>& box) const {
    double near = 0.0;
    double far = end_;
    for (int i = 0; i < 3; ++i) {
        const double low = box.min[i] - slack_ - point_[i];
        const double high = box.max[i] + slack_ - point_[i];
        if (towards_[i] == 0.0) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        const double first = low * inverse_[i];
        const double last = high * inverse_[i];
        near = std::max(near, std::min(first, last));
        far = std::min(far, std::max(first, last));
    }
    // Each parameter is off by a few units in its last place at most.
    return !(near > far * (1.0 + 0x1p-48));
}

bool Sight::crosses(const std::array<glm::dvec3, 3>& face) const {
    const auto& [a, b, c] = face;
    const glm::dvec3 to_a = a - point_;
    const glm::dvec3 to_b = b - point_;
    const glm::dvec3 to_c = c - point_;
    int ab = certain_sign(to_a, to_b, towards_);
    int bc = certain_sign(to_b, to_c, towards_);
    if (ab * bc < 0) return false;
    int ca = certain_sign(to_c, to_a, towards_);
    if (ab * ca < 0 || bc * ca < 0) return false;
    if (ab == 0) ab = exact_side(a, b, light_, point_);
    if (bc == 0) bc = exact_side(b, c, light_, point_);
    if (ab == 0 || ab != bc) return false;
    if (ca == 0) ca = exact_side(c, a, light_, point_);
    if (ca != ab) return false;
    // The line crosses the face; the way does where its ends lie on either side.
    return orientation(a, b, c, light_) * orientation(a, b, c, glm::dvec4(point_, 1.0)) < 0;
}

}  // namespace gnomon::shadows::internal
