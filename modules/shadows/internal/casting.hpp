// SPDX-License-Identifier: MIT
//
// What a face weighs, by the kind of casting of its component and the side that it has of the light
// (docs/conventions.md, "Two kinds of casting").
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

namespace gnomon::shadows::internal {

/// So that a margin is never reached, whatever its arithmetic rounds.
inline constexpr double margin_slack = 1e-9;

/// What the faces of a component weigh that are averted, edge-on and facing.
using Casting = std::array<std::int8_t, 3>;

struct Castings {
    std::vector<Casting> of_component;
    bool uniform = true;  ///< all components cast alike
    /// How far a point light may move, and no component's kind changes; infinite for a direction.
    double margin = 0.0;
};

/// Replaces `castings` and `solid_averted` (Facing::solid_averted). The light is finite. Cost:
/// linear in the components.
void find_castings(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps, Castings& castings,
                   std::vector<std::uint8_t>& solid_averted);

}  // namespace gnomon::shadows::internal
