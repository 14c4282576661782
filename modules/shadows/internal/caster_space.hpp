// SPDX-License-Identifier: MIT
//
// CasterSpace: the space in which one caster's shadows are decided, and the ways into it. It is the
// caster's own; for a singular pose, which has no way into it, the one that the pose leads to, with
// its origin at the caster's (docs/conventions.md, "Poses are doubles"). Lights and faces arrive
// here exactly as detection sees them.
#pragma once

#include <array>
#include <optional>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

#include "face_tree.hpp"
#include "local_light.hpp"

namespace gnomon::shadows::internal {

using Corners = std::array<glm::dvec3, 3>;

class CasterSpace {
public:
    CasterSpace() = default;
    CasterSpace(const ShadowMesh& mesh, const glm::dmat4& world_from_local);

    /// A pose that is not finite, or a mesh without faces, casts nothing and has no place.
    [[nodiscard]] bool casts() const { return casts_; }
    /// Holds all faces, whatever was rounded on the way.
    [[nodiscard]] const Box<double>& world_bounds() const { return world_bounds_; }
    [[nodiscard]] glm::dvec3 origin_world() const { return glm::dvec3(pose_.world_from_local[3]); }
    /// Rounding to single precision moves a light by at most this times its distance from the
    /// origin, in the world, and turns a direction by at most this many radians.
    [[nodiscard]] double light_rounding() const { return light_rounding_; }

    /// nullopt where the coordinates leave the range of the exact predicates: nothing of the caster
    /// is of a size that matters there.
    [[nodiscard]] std::optional<glm::dvec3> point(const glm::dvec3& point_world) const;
    /// Rounded to what the renderer uses. nullopt as above.
    [[nodiscard]] std::optional<glm::dvec4> light(const glm::dvec4& light_world) const;

    [[nodiscard]] const FaceTree& faces() const { return *faces_; }
    [[nodiscard]] Box<double> box(const Box<float>& box_local) const;
    [[nodiscard]] Corners corners(const FaceTree::Triangle& face) const;
    /// The sign of the face's weight were it to cast two-sided: 0 where its plane contains the
    /// light.
    [[nodiscard]] int facing(const Corners& face, const glm::dvec4& light) const;

private:
    Pose pose_;
    glm::dmat4 parent_from_local_{1.0};  // of a singular pose: its linear part
    const FaceTree* faces_ = nullptr;
    Box<double> world_bounds_;
    double light_rounding_ = 0.0;
    bool casts_ = false;
};

}  // namespace gnomon::shadows::internal
