// SPDX-License-Identifier: MIT
//
// What is wrong with a mesh, in the words of modelling programs, and what that makes of it as a
// caster. Nothing here is needed to cast: a volume is closed whatever the mesh is
// (docs/conventions.md, "Two kinds of casting"). It is what tools tell people.
#pragma once

#include <cstdint>
#include <span>

#include <gnomon/shadows/shadow_mesh.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// What is wrong with an edge, if anything.
enum class EdgeKind : std::uint8_t {
    Regular,       ///< two faces that run along it in opposite directions
    Boundary,      ///< one face
    Inconsistent,  ///< two faces that run along it the same way
    NonManifold,   ///< three faces or more
};

/// By all the uses of one edge. An edge that only faces without area have, has no uses and is not
/// an edge of the mesh.
[[nodiscard]] EdgeKind edge_kind(std::span<const FaceUse> uses);

/// The signed sum of an edge's uses: 0 where its faces cancel, which is all that one-sided casting
/// asks of it. Never 0 for a boundary or an inconsistent edge; either for a non-manifold one.
[[nodiscard]] std::int32_t edge_balance(std::span<const FaceUse> uses);

/// How a component casts.
enum class CasterKind : std::uint8_t {
    Nothing,    ///< all its faces are degenerate
    OneSided,   ///< closed: the faces towards the light, while the light is outside its bounds
    InsideOut,  ///< closed and wound inwards: the averted faces, while the light is outside
    TwoSided,   ///< not closed: every face, for any light
};

/// For a light outside the component's bounds and a pose that can be inverted; otherwise every
/// component casts two-sided.
[[nodiscard]] CasterKind caster_kind(const Component& component);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
