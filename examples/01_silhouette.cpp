// SPDX-License-Identifier: MIT
//
// The CPU core on its own: a mesh, a light, the faces that cast, their silhouette, the shadow
// volume. No GPU, no scene; links gnomon::shadows alone. The mesh is an open box without a lid,
// which most shadow volume code refuses.
#include <array>
#include <cstdio>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/silhouette.hpp>
#include <gnomon/shadows/volume.hpp>

using namespace gnomon::shadows;

int main() {
    const std::array<glm::vec3, 8> corners{{{-1, 0, -1},
                                            {1, 0, -1},
                                            {1, 0, 1},
                                            {-1, 0, 1},  //
                                            {-1, 1, -1},
                                            {1, 1, -1},
                                            {1, 1, 1},
                                            {-1, 1, 1}}};
    const std::array<std::uint32_t, 30> indices{0, 1, 2, 0, 2, 3,   // bottom
                                                0, 4, 5, 0, 5, 1,   // back
                                                1, 5, 6, 1, 6, 2,   // right
                                                2, 6, 7, 2, 7, 3,   // front
                                                3, 7, 4, 3, 4, 0};  // left; there is no top
    const auto mesh =
        ShadowMesh::build({.positions = reinterpret_cast<const std::byte*>(corners.data()),
                           .vertex_count = corners.size(),
                           .indices = indices});
    if (!mesh) {
        std::fprintf(stderr, "%s\n", mesh.error().message.c_str());
        return 1;
    }
    const MeshReport& report = (*mesh)->report();
    std::printf("mesh: %llu triangles, %llu edges, %llu of them open\n",
                static_cast<unsigned long long>(report.triangles),
                static_cast<unsigned long long>(report.edges),
                static_cast<unsigned long long>(report.boundary_edges));

    // A lamp up to the right, in the mesh's own space. Every face gets its weight once: +1 towards
    // the lamp, -1 averted, 0 no caster.
    const LightLocal lamp{{4.0F, 5.0F, 3.0F, 1.0F}};
    Facing facing;
    classify_faces(**mesh, lamp, facing);
    std::printf("weights:");
    for (const std::int8_t weight : facing.weights) std::printf(" %+d", weight);
    std::printf("\nthe lamp may move %.3f m before any of them can change\n", facing.margin);

    // The silhouette is the boundary of the weighted faces; an edge may count twice.
    std::vector<SilhouetteEdge> silhouette;
    find_silhouette(**mesh, facing.weights, silhouette);
    for (const SilhouetteEdge& edge : silhouette)
        std::printf("silhouette: %u -> %u, %d times\n", edge.from, edge.to, edge.count);

    // The volume is made of indices alone: vertex 2v is the mesh's own, 2v + 1 is pushed away from
    // the lamp to infinity.
    Volume volume;
    build_volume(**mesh, facing.weights, silhouette, lamp.is_directional(), FarVertices::AtInfinity,
                 volume);
    const bool closed = is_closed(**mesh, volume);
    std::printf("volume: %u triangles of sides, %u of caps, %s\n", volume.sides.count / 3,
                volume.cap_faces() + volume.far_cap.count / 3, closed ? "closed" : "not closed");
    return closed ? 0 : 1;
}
