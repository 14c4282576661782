// SPDX-License-Identifier: MIT
//
// What a mesh may be.
#include <cmath>

#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/rows/stage.hpp"

namespace gnomon::test {

namespace {

// `pages` squares on one spine, from the origin upwards.
scene::Mesh book_of(int pages) {
    scene::Mesh mesh;
    mesh.name = "book";
    for (int page = 0; page < pages; ++page) {
        const float angle = 0.2F + 5.6F * static_cast<float>(page) / static_cast<float>(pages);
        const glm::vec3 out(std::cos(angle), 0.0F, std::sin(angle));
        const glm::vec3 up(0.0F, 1.5F, 0.0F);
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& corner : {glm::vec3(0.0F), out, out + up, up}) {
            mesh.positions.push_back(corner);
            mesh.normals.emplace_back(-out.z, 0.0F, out.x);
        }
        for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(base + i);
    }
    mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    return mesh;
}

Setting book(int pages) {
    Stage s;
    s.ground();
    s.place(shared(book_of(pages)), moved({0.0, 0.3, 0.0}));
    s.lamp({1.7, 4.1, 1.3});
    s.look({0.0, 3.0, 5.0}, {0.0, 0.7, 0.0});
    return s.finish();
}

}  // namespace

std::vector<HardCase> topology_cases() {
    std::vector<HardCase> cases;
    for (const int pages : {3, 4, 5, 6, 7, 8, 9}) {
        cases.push_back({.name = "03_book_of_" + std::to_string(pages) + "_pages",
                         .story = "an edge of three faces and more breaks edge lists",
                         .make = [pages](int) { return book(pages); }});
    }
    return cases;
}

}  // namespace gnomon::test
