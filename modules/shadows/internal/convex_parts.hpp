// SPDX-License-Identifier: MIT
//
// ConvexPart: a component of a mesh that is the whole surface of a convex solid. What lies behind
// one is bounded by few planes, so that it is cheap to tell what is in its shadow (umbra.hpp).
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
        std::array<std::uint32_t, 2> faces;
    };
    std::vector<glm::vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;  ///< wound as in the mesh
    std::vector<Edge> edges;
    glm::dvec3 center{0.0};  ///< the vertices' mean: inside
    double area = 0.0;
};

/// Components of more faces are not looked at.
inline constexpr std::uint64_t most_convex_faces = 256;
/// The largest ones of a mesh are enough.
inline constexpr std::size_t most_convex_parts = 4;

/// The largest convex parts of the mesh by area, at most most_convex_parts: closed components whose
/// edges all have two opposite faces, whose faces all have area and look away from the inside (or
/// all into it, where the component is inside out), and none of whose corners lies before any of
/// its faces' planes, but for rounding. Nothing but gain hangs on the convexity: an umbra is right
/// for any faces. Found by whichever thread asks first, and kept with the mesh. Cost then: faces
/// times vertices of a few components. None for deformed meshes, which would be asked every frame.
[[nodiscard]] const std::vector<ConvexPart>& convex_parts(const ShadowMesh& mesh);

}  // namespace gnomon::shadows::internal
