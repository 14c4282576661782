// SPDX-License-Identifier: MIT
//
// A program outside gnomon that uses the CPU core: the shadow volume of a tetrahedron is closed.
#include <cstdio>
#include <vector>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/silhouette.hpp>
#include <gnomon/shadows/volume.hpp>

int main() {
    using namespace gnomon::shadows;
    const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<std::uint32_t> indices{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    const auto mesh =
        ShadowMesh::build({.positions = reinterpret_cast<const std::byte*>(corners.data()),
                           .vertex_count = corners.size(),
                           .indices = indices});
    if (!mesh) {
        std::fprintf(stderr, "%s\n", mesh.error().message.c_str());
        return 1;
    }
    const LightLocal light{{3.0F, 4.0F, 5.0F, 1.0F}};
    Facing facing;
    classify_faces(**mesh, light, facing);
    std::vector<SilhouetteEdge> silhouette;
    find_silhouette(**mesh, facing.weights, silhouette);
    Volume volume;
    build_volume(**mesh, facing.weights, silhouette, light.is_directional(),
                 FarVertices::AtInfinity, volume);

    // The light sees the slanted face alone: its three edges are the silhouette.
    std::printf("%zu silhouette edges, %zu indices\n", silhouette.size(), volume.indices.size());
    return silhouette.size() == 3 && is_closed(**mesh, volume) ? 0 : 1;
}
