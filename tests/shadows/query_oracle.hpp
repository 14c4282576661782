// SPDX-License-Identifier: MIT
//
// What lies between a point and a light, face by face in integers without limit: no tree, no
// filter, no expansion. For shadow queries to be held against.
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include <gnomon/shadows/shadow_mesh.hpp>

#include "tests/shadows/big_integer.hpp"

namespace gnomon::test {

inline BigVector exactly(const glm::dvec3& v) {
    return {BigInteger::of(v.x), BigInteger::of(v.y), BigInteger::of(v.z)};
}
inline int sign_of_dot(const BigVector& a, const BigVector& b) {
    return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]).sign();
}
inline BigVector to_light(const glm::dvec4& light, const BigVector& from) {
    const BigVector l = exactly(glm::dvec3(light));
    return light.w != 0.0 ? l - from : l;
}

/// The side of the plane through light, p and q on which x is; on it, x counts as moved by (t, t^2,
/// t^3).
inline int oracle_side(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec4& light,
                       const glm::dvec3& x) {
    const BigVector from = exactly(x);
    const int side =
        sign_of_dot(cross(exactly(p) - from, exactly(q) - from), to_light(light, from));
    if (side != 0) return side;
    const BigVector normal = cross(exactly(q) - exactly(p), to_light(light, exactly(p)));
    for (const BigInteger& component : normal) {
        if (component.sign() != 0) return -component.sign();
    }
    return 0;
}

/// The side of the face's plane on which a light or, as (x, y, z, 1), a point is.
inline int oracle_facing(const std::array<glm::dvec3, 3>& face, const glm::dvec4& light) {
    const BigVector a = exactly(face[0]);
    return sign_of_dot(cross(exactly(face[1]) - a, exactly(face[2]) - a), to_light(light, a));
}

inline bool oracle_crosses(const std::array<glm::dvec3, 3>& face, const glm::dvec3& x,
                           const glm::dvec4& light) {
    const int facing = oracle_facing(face, light);
    if (facing == 0 || facing * oracle_facing(face, glm::dvec4(x, 1.0)) != -1) return false;
    const int ab = oracle_side(face[0], face[1], light, x);
    return ab == oracle_side(face[1], face[2], light, x) &&
           ab == oracle_side(face[2], face[0], light, x);
}

/// `x` and `light` in the mesh's space.
inline std::uint32_t oracle_count(const shadows::ShadowMesh& mesh, const glm::dvec3& x,
                                  const glm::dvec4& light) {
    std::uint32_t count = 0;
    for (const auto& [a, b, c] : mesh.faces()) {
        const auto p = mesh.positions();
        count += oracle_crosses({glm::dvec3(p[a]), glm::dvec3(p[b]), glm::dvec3(p[c])}, x, light)
                     ? 1U
                     : 0U;
    }
    return count;
}

}  // namespace gnomon::test
