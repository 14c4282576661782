// SPDX-License-Identifier: MIT
//
// The near-clip volume of one light and one view: what depth_pass_is_valid() asks of casters, with
// all that is the same for many casters done once.
#pragma once

#include <array>
#include <cstddef>

#include <glm/glm.hpp>

#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/technique.hpp>
#include <gnomon/shadows/view.hpp>

namespace gnomon::shadows::internal {

class NearClip {
public:
    NearClip(const glm::dvec4& light_world, const View& view);

    /// depth_pass_is_valid(). Cost: some hundred flops, and some thousand where nothing separates
    /// the two.
    [[nodiscard]] bool is_clear_of(const OrientedBounds& bounds) const;
    /// The same of a mesh's faces, one by one: true for many a caster whose bounds are not clear,
    /// in a room above all. Cost: some dozen flops a face, until the first that is not.
    [[nodiscard]] bool is_clear_of(const ShadowMesh& mesh,
                                   const glm::dmat4& world_from_local) const;
    /// The same for all that a sphere in the world may hold; true for most that are not near the
    /// volume. Cost: some dozen flops.
    [[nodiscard]] bool is_clear_of_sphere(const glm::dvec3& center, double radius) const;

private:
    // What the volume takes of an axis.
    struct Side {
        glm::dvec3 normal{0.0};
        double low = 0.0;
        double high = 0.0;
    };
    [[nodiscard]] Side extent_along(const glm::dvec3& unit) const;

    glm::dvec3 eye_;
    glm::dvec3 forward_;
    glm::dvec3 light_{0.0};  // relative to the eye
    bool directional_;
    bool finite_ = false;
    std::array<glm::dvec3, 9> hull_{};
    std::ptrdiff_t hull_count_ = 0;
    std::array<glm::dvec3, 16> edges_{};
    std::array<Side, 9> sides_{};
    std::ptrdiff_t side_count_ = 0;
};

}  // namespace gnomon::shadows::internal
