// SPDX-License-Identifier: MIT
//
// Any bytes as triangles and a light: the mesh is refused with a sentence, or every volume of it is
// closed, and every strategy finds the same silhouette.
#include <cmath>
#include <vector>

#include <gnomon/shadows/detector.hpp>
#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/volume.hpp>

#include "fuzz_input.hpp"

namespace gnomon::test {
namespace {

using namespace shadows;

/// Half of all inputs lie on a small lattice, where faces meet, are coplanar and contain the light.
float coordinate(FuzzInput& input, bool on_lattice) {
    return on_lattice ? static_cast<float>(input.value<std::int8_t>() / 16) : input.value<float>();
}

glm::vec3 point(FuzzInput& input, bool on_lattice) {
    const float x = coordinate(input, on_lattice);
    const float y = coordinate(input, on_lattice);
    return {x, y, coordinate(input, on_lattice)};
}

void require_closed_volumes(const ShadowMesh& mesh, const Facing& facing, bool directional) {
    require(facing.weights.size() == mesh.faces().size(), "every face has a weight");
    require(facing.margin >= 0.0, "the margin is a length");
    std::vector<SilhouetteEdge> silhouette;
    find_silhouette(mesh, facing.weights, silhouette);
    for (const FarVertices far_vertices : {FarVertices::AtInfinity, FarVertices::Finite}) {
        Volume volume;
        build_volume(mesh, facing.weights, silhouette, directional, far_vertices, volume);
        require(is_closed(mesh, volume), "the volume is closed");
        for (const std::uint32_t index : volume.indices) {
            require(index < 2 * mesh.positions().size(), "indices name vertices of the volume");
        }
        // The same with ranges, a fan where nobody asks whether it counts right, and a limit.
        std::vector<FaceRun> casting;
        runs_of(facing.weights, casting);
        for (const FarCap far_cap : {FarCap::Faces, FarCap::Fan}) {
            for (const std::uint32_t few : {0U, 2U, 5U}) {
                const std::uint32_t faces = volume.cap_faces();
                build_volume(mesh, casting, silhouette,
                             {directional, far_vertices, {far_cap, few, few}}, volume,
                             facing.solid_averted);
                require(is_closed(mesh, volume), "the volume with ranges is closed");
                require(volume.ranges.size() <= few, "there are not too many ranges");
                require(volume.cap_faces() == faces, "caps are the casting faces");
            }
        }
    }
}

void require_equal_strategies(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) {
    Facing facing;
    classify_faces(mesh, light, facing, near_caps);
    CastingFaces casting;
    pack_weights(facing.weights, casting);
    std::vector<SilhouetteEdge> silhouette;
    find_silhouette(mesh, facing.weights, silhouette);
    std::ranges::sort(silhouette);
    for (const SilhouetteStrategy& strategy : silhouette_strategies()) {
        const auto detector = strategy.create();
        const Detection& found = detector->detect(mesh, light, near_caps);
        std::vector<SilhouetteEdge> edges = found.silhouette;
        std::ranges::sort(edges);
        require(edges == silhouette, "all strategies find the same silhouette");
        require(found.casting == casting, "all strategies find the same faces");
    }
}

void cast(FuzzInput& input) {
    const bool on_lattice = input.flag();
    const bool directional = input.flag();
    const LightLocal light{glm::vec4(point(input, on_lattice), directional ? 0.0F : 1.0F)};
    const glm::dmat4 flattened = {glm::dvec4(point(input, on_lattice), 0.0),
                                  glm::dvec4(point(input, on_lattice), 0.0), glm::dvec4(0.0),
                                  glm::dvec4(point(input, on_lattice), 1.0)};
    std::vector<glm::vec3> positions(1 + input.below(64));
    for (glm::vec3& position : positions) position = point(input, on_lattice);
    std::vector<std::uint32_t> indices;
    // One more than there are vertices: an index out of range is refused as well.
    while (!input.empty()) indices.push_back(input.below(positions.size() + 1));

    const auto mesh = ShadowMesh::build({.positions = std::as_bytes(std::span(positions)).data(),
                                         .vertex_count = positions.size(),
                                         .indices = indices});
    if (!mesh) return require_sentence(mesh.error(), ErrorCode::InvalidInput);
    // What a light has to be is its owner's business (LightLocal is not read from files).
    if (!std::isfinite(glm::dot(glm::dvec4(light.position), glm::dvec4(1.0)))) return;
    Facing facing;
    classify_faces(**mesh, light, facing);
    require_closed_volumes(**mesh, facing, directional);
    require_equal_strategies(**mesh, light, NearCaps::Facing);
    require_equal_strategies(**mesh, light, NearCaps::Averted);
    classify_faces_flattened(**mesh, flattened, glm::dvec4(light.position), facing);
    require_closed_volumes(**mesh, facing, directional);
}

}  // namespace
}  // namespace gnomon::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    gnomon::test::FuzzInput input(data, size);
    gnomon::test::cast(input);
    return 0;
}
