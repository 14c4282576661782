// SPDX-License-Identifier: MIT
//
// ConvexPart: some faces of a mesh that together are convex: the whole surface of a convex solid,
// or a piece of one, down to a flat one. What lies behind it is bounded by few planes, so that it is
// cheap to tell what is in its shadow (umbra.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/shadow_mesh.hpp>

namespace gnomon::shadows::internal {

/// In the mesh's space.
struct ConvexPart {
    struct Edge {
        std::array<std::uint32_t, 2> ends;
        std::array<std::uint32_t, 2> faces;  ///< the second one is no_face where the part ends
    };
    static constexpr std::uint32_t no_face = 0xFFFFFFFF;
    std::vector<glm::vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;  ///< wound as in the mesh
    std::vector<Edge> edges;
    glm::dvec3 center{0.0};  ///< the vertices' mean
    double area = 0.0;
    bool whole = false;       ///< all of a component, which is closed
    bool inside_out = false;  ///< its faces are wound clockwise as seen from outside
    bool two_sided = false;   ///< its faces cast whichever side the light is on
};

/// Parts of more faces are not looked for.
inline constexpr std::uint64_t most_convex_faces = 256;
/// The largest ones of a mesh are enough.
inline constexpr std::size_t most_convex_parts = 4;

/// The largest convex parts of the mesh by area, at most most_convex_parts: closed components whose
/// edges all have two opposite faces, whose faces all have area and look away from the inside (or
/// all into it, where the component is inside out), and none of whose corners lies before any of
/// its faces' planes, but for rounding; and, of other components, what grows from large faces over
/// such edges while no corner lies before any plane, and what lies in one plane is convex in it.
/// Nothing but gain hangs on the convexity: an umbra is right for any faces. Found by whichever
/// thread asks first, and kept with the mesh. Cost then: faces times vertices of a few parts. None
/// for deformed meshes, which would be asked every frame.
[[nodiscard]] const std::vector<ConvexPart>& convex_parts(const ShadowMesh& mesh);

}  // namespace gnomon::shadows::internal
