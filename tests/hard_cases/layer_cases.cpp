// SPDX-License-Identifier: MIT
//
// How many volumes may lie over one pixel.
#include <string>

#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/rows/stage.hpp"

namespace gnomon::test {

namespace {

// A box within a box within a box, `count` of them, as one mesh.
scene::Mesh nested_boxes(int count) {
    scene::Mesh mesh;
    mesh.name = "nested boxes";
    for (int i = 0; i < count; ++i) {
        const scene::Mesh box =
            scene::make_box(glm::vec3(1.4F * (1.0F - 0.0004F * static_cast<float>(i))));
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), box.positions.begin(), box.positions.end());
        mesh.normals.insert(mesh.normals.end(), box.normals.begin(), box.normals.end());
        for (const std::uint32_t index : box.indices) mesh.indices.push_back(base + index);
    }
    mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    return mesh;
}

Stage ground_and_lamp() {
    Stage s;
    s.ground();
    s.lamp({1.5, 4.5, 2.0});
    s.look({0.0, 2.6, 5.5}, {0.0, 0.6, 0.0});
    return s;
}

const glm::dmat4 floating = moved({-0.2, 1.3, 0.0}) * turned(25, {0.3, 1.0, 0.1});

Setting in_one_mesh(int count) {
    Stage s = ground_and_lamp();
    s.place(shared(nested_boxes(count)), floating);
    return s.finish();
}

Setting one_by_one(int count) {
    Stage s = ground_and_lamp();
    const MeshPointer box = shared(scene::make_box(glm::vec3(1.4F)));
    for (int i = 0; i < count; ++i) s.place(box, floating * scaled(glm::dvec3(1.0 - 0.0004 * i)));
    return s.finish();
}

}  // namespace

std::vector<HardCase> layer_cases() {
    const std::string story = "256 layers wrap to none in eight bits";
    std::vector<HardCase> cases;
    for (const int count : {127, 128, 255, 256, 257, 1000}) {
        add_by_both(cases, {.name = "15_nested_boxes_" + std::to_string(count),
                            .story = story,
                            .make = [count](int) { return in_one_mesh(count); },
                            .options = {.width = 160, .height = 120}});
    }
    for (const int count : {255, 256}) {
        cases.push_back({.name = "15_nested_casters_" + std::to_string(count),
                         .story = story,
                         .make = [count](int) { return one_by_one(count); },
                         .options = {.width = 160, .height = 120}});
    }
    return cases;
}

}  // namespace gnomon::test
