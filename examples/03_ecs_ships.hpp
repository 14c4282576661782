// SPDX-License-Identifier: MIT
//
// What the three programs 03_ecs_*.cpp share, so that each of them shows its loop and little else:
// the components, a hull, a camera, and a sentence about what a frame cost. No entity system.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/shadows/shadow_system.hpp>

namespace ships {

using namespace gnomon;

/// Where something is, in the world. What your physics, your animation and your editor write.
struct Pose {
    glm::dmat4 world_from_local{1.0};
};
/// What it looks like to a light. Made once for each mesh and shared by all that use it.
struct Shape {
    std::shared_ptr<const shadows::ShadowMesh> mesh;
};
struct Lamp {
    double range_m = 100.0;
};

inline Pose at(double x, double y, double z) {
    return {glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z))};
}

inline Shape make_hull() {
    const std::array<glm::vec3, 5> corners{
        {{0, 0, -2}, {1, 0, 1}, {-1, 0, 1}, {0, 0.6F, 0.8F}, {0, -0.4F, 0.8F}}};
    const std::array<std::uint32_t, 18> indices{0, 3, 1, 0, 2, 3, 0, 1, 4,
                                                0, 4, 2, 1, 3, 4, 2, 4, 3};
    auto mesh =
        shadows::ShadowMesh::build({.positions = reinterpret_cast<const std::byte*>(corners.data()),
                                    .vertex_count = corners.size(),
                                    .indices = indices});
    if (mesh) return {*mesh};
    std::fprintf(stderr, "%s\n", mesh.error().message.c_str());
    std::exit(1);
}

inline shadows::ShadowSystem make_system() {
    auto system = shadows::ShadowSystem::create();
    if (system) return std::move(*system);
    std::fprintf(stderr, "%s\n", system.error().message.c_str());
    std::exit(1);
}

inline shadows::View seen_from(double x) {
    return {shadows::look_at({x, 6.0, 14.0}, {4.0, 1.0, 0.0}, {0.0, 1.0, 0.0}),
            shadows::infinite_perspective(0.8, 16.0 / 9.0, 0.1)};
}

inline void say(const char* what, const shadows::DrawList& list) {
    std::printf("%s: %zu volumes, %llu of %llu silhouettes found anew\n", what, list.draws.size(),
                static_cast<unsigned long long>(list.stats.pairs_redetected),
                static_cast<unsigned long long>(list.stats.pairs));
}

}  // namespace ships
