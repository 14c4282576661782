// SPDX-License-Identifier: MIT
//
// Why it is exact: the origin is a multiple of a power of two at least as large as the mesh, and
// all positions far from zero are multiples of their own last bit. Position minus origin is then a
// multiple of that bit too and smaller than the position: it fits a float (Sterbenz's lemma is the
// special case of one vertex). It is checked for every vertex all the same.
#include "internal/mesh_origin.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::scene::internal {
namespace {

constexpr double far_in_diagonals = 8.0;

bool is_exact(const Mesh& mesh, int axis, double origin) {
    return std::all_of(mesh.positions.begin(), mesh.positions.end(), [&](const glm::vec3& p) {
        const double moved = static_cast<double>(p[axis]) - origin;
        const double rounded = static_cast<float>(moved);
        return rounded == moved && origin + rounded == static_cast<double>(p[axis]);
    });
}

/// A power of two at least as large.
double grid_of(double diagonal) { return std::exp2(std::ceil(std::log2(diagonal))); }

}  // namespace

glm::dvec3 near_origin(const Bounds& bounds) {
    glm::dvec3 origin(0.0);
    const double diagonal = bounds.diagonal();
    if (!(diagonal > 0.0) || !std::isfinite(diagonal)) return origin;
    const double grid = grid_of(diagonal);
    for (int axis = 0; axis < 3; ++axis) {
        const double center = bounds.center()[axis];
        if (std::abs(center) > far_in_diagonals * diagonal) {
            origin[axis] = std::round(center / grid) * grid;
        }
    }
    return origin;
}

void rebase_far_mesh(Mesh& mesh) {
    if (mesh.positions.empty()) return;
    glm::dvec3 low = mesh.positions.front();
    glm::dvec3 high = low;
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    const double diagonal = glm::length(high - low);
    if (!(diagonal > 0.0)) return;
    const double grid = grid_of(diagonal);
    for (int axis = 0; axis < 3; ++axis) {
        const double center = (low[axis] + high[axis]) * 0.5;
        if (std::abs(center) <= far_in_diagonals * diagonal) continue;
        const double origin = std::round(center / grid) * grid;
        if (!is_exact(mesh, axis, origin)) continue;
        mesh.origin[axis] += origin;
        for (glm::vec3& p : mesh.positions) {
            p[axis] = static_cast<float>(static_cast<double>(p[axis]) - origin);
        }
    }
}

}  // namespace gnomon::scene::internal
