// SPDX-License-Identifier: MIT
//
// Shadow volumes, in every way that gnomon can draw them.
#pragma once

#include <optional>

#include <gnomon/shadows/shadow_system.hpp>

#include "technique.hpp"

namespace gnomon::report::internal {

enum class Projection : std::uint8_t {
    Reversed,  ///< infinite, depth 1 near and 0 far
    Epsilon,   ///< infinite, depth 0 near, 1 far but for an epsilon
    Clamped,   ///< a far plane; volumes are not clipped by it
};

struct VolumeTechnique {
    shadows::SystemOptions system = {};
    shadows::NearCaps near_caps = shadows::NearCaps::Facing;
    Projection projection = Projection::Reversed;
    gpu::Format format = gpu::Format::Depth32FloatStencil8;
    double near_scale = 1.0;  ///< of the subject's near plane
    std::optional<std::size_t> most_lights = std::nullopt;
    /// Casters are simplified to this share of their triangles.
    std::optional<double> proxy_share = std::nullopt;
    bool proxy_inset = false;  ///< and drawn in by what that may have moved
    /// Volumes end after this share of the scene's diagonal.
    std::optional<double> reach_share = std::nullopt;
};

[[nodiscard]] Result<std::unique_ptr<Technique>> create_volumes(const Setup& setup,
                                                                const VolumeTechnique& how);

/// Whether this build can simplify casters.
[[nodiscard]] bool can_simplify();
/// Casters of the scene with about `share` of their triangles, not in the depth buffer. `inset`:
/// vertices go inwards along their normals by the error that simplifying reports, so that little of
/// a stand-in lies outside of what it stands for. Fails with Unsupported where can_simplify() is
/// false.
[[nodiscard]] Result<std::vector<shadows::Caster>> simplified_casters(const scene::Scene& scene,
                                                                      double share, bool inset);

}  // namespace gnomon::report::internal
