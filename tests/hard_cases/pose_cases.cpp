// SPDX-License-Identifier: MIT
//
// Where things may stand, and how askew.
#include <cmath>

#include <fmt/format.h>

#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/rows/stage.hpp"

namespace gnomon::test {

namespace {

MeshPointer torus(float ring, float tube) { return shared(scene::make_torus(ring, tube, 40, 20)); }
MeshPointer knot(float size) {
    return shared(scene::make_torus_knot(size, 0.32F * size, 2, 3, 96, 16));
}

// --- 23: far from the world's origin ---

Setting moved_away(double metres) {
    const glm::dvec3 away = metres * glm::dvec3(1.0, -0.3, 0.7);
    Stage s;
    s.ground(20.0F, moved(away));
    s.place(knot(1.0F), moved(away + glm::dvec3(-0.8, 1.7, 0.0)) * turned(20, {1, 1, 0}));
    s.place(torus(0.7F, 0.3F), moved(away + glm::dvec3(1.7, 0.9, 0.4)) * turned(65, {1, 0, 0.3}));
    s.lamp(away + glm::dvec3(1.5, 4.5, 2.0));
    s.sun({-0.5, -1.0, -0.4});
    s.look(away + glm::dvec3(0.0, 2.6, 5.5), away + glm::dvec3(0.0, 0.8, 0.0));
    return s.finish();
}

// --- 25: mirrors, shears, uneven scales ---

// Each side of each mirror, and two of them at once, which is none.
Setting mirrors() {
    Stage s;
    s.ground();
    const MeshPointer mesh = knot(0.75F);
    s.place(mesh, moved({-2.4, 1.3, 0.0}) * scaled({-1, 1, 1}));
    s.place(mesh, moved({-0.8, 1.3, 0.4}) * scaled({1, -1, 1}) * turned(40, {0, 1, 0}));
    s.place(mesh, moved({0.8, 1.3, 0.0}) * scaled({1, -1, -1}));
    s.place(mesh, moved({2.4, 1.3, 0.4}) * scaled({-1, -1, -1}) * turned(70, {1, 0, 0}));
    s.lamp({0.5, 4.5, 3.0});
    s.sun({0.5, -1.0, -0.6});
    s.look({0.0, 3.0, 6.5}, {0.0, 0.9, 0.0});
    return s.finish();
}

// A lamp inside of a mirrored shell: casting is two-sided, and front and back exchanged as well.
Setting mirror_round_the_lamp() {
    Stage s;
    s.ground();
    s.place(torus(1.0F, 0.35F),
            moved({0.0, 1.5, 0.0}) * scaled({1, 1, -1}) * turned(60, {1, 0, 0.2}));
    s.lamp({0.05, 1.55, 0.02});
    s.look({2.0, 2.6, 4.5}, {0.0, 0.9, 0.0});
    return s.finish();
}

Setting shears() {
    const auto sheared = [](int column, int row, double by) {
        glm::dmat4 m(1.0);
        m[column][row] = by;
        return m;
    };
    Stage s;
    s.ground();
    s.place(knot(0.75F), moved({-2.0, 1.5, 0.0}) * sheared(1, 0, 1.5));
    s.place(torus(0.7F, 0.3F),
            moved({0.0, 1.2, 0.8}) * sheared(0, 1, -1.0) * turned(50, {1, 0, 0}));
    s.place(knot(0.75F), moved({2.2, 1.5, 0.0}) * sheared(2, 1, 2.0) * sheared(1, 0, 0.5) *
                             scaled({0.8, 0.7, -0.8}));
    s.lamp({0.5, 5.0, 3.0});
    s.sun({0.5, -1.0, -0.6});
    s.look({0.0, 3.2, 6.5}, {0.0, 0.9, 0.0});
    return s.finish();
}

// One axis scaled by `by`, of a mesh that is so much too small or too large along it: in the
// caster's own space the light is far away along that axis, or very near.
Setting uneven(double by) {
    const auto stretched = [&](scene::Mesh mesh, int axis) {
        for (glm::vec3& p : mesh.positions) {
            p[axis] = static_cast<float>(p[axis] / by);
        }
        glm::dvec3 scale(1.0);
        scale[axis] = by;
        return std::pair(shared(std::move(mesh)), scaled(scale));
    };
    Stage s;
    s.ground();
    const auto [high, high_scale] =
        stretched(scene::make_torus_knot(0.75F, 0.24F, 2, 3, 96, 16), 1);
    const auto [wide, wide_scale] = stretched(scene::make_torus(0.7F, 0.3F, 40, 20), 0);
    s.place(high, moved({-1.2, 1.5, 0.0}) * turned(15, {1, 0, 1}) * high_scale);
    s.place(wide, moved({1.4, 1.2, 0.4}) * turned(60, {1, 0, 0.4}) * wide_scale);
    s.lamp({0.5, 4.5, 3.0});
    s.sun({0.5, -1.0, -0.6});
    s.look({0.0, 2.8, 5.5}, {0.0, 0.9, 0.0});
    return s.finish();
}

// Meshes as they are, pressed flat to a thousandth, or drawn out a thousand times: a sheet that is
// closed all the same, and a needle's eye.
Setting pressed_and_drawn_out() {
    Stage s;
    s.ground();
    s.place(knot(0.9F), moved({-1.6, 1.6, 0.0}) * turned(30, {0, 0, 1}) * scaled({1.0, 1e-3, 1.0}));
    s.place(torus(0.9F, 0.35F),
            moved({1.4, 1.3, 0.0}) * turned(65, {1, 0, 0.2}) * scaled({1.0, 1e-3, 1.0}));
    s.place(torus(1.0F, 0.4F), moved({0.0, 2.6, -1.5}) * scaled({1e3, 0.2, 0.2}));
    s.lamp({0.4, 4.5, 2.0});
    s.sun({0.3, -1.0, -0.5});
    s.look({0.0, 2.8, 6.0}, {0.0, 0.8, 0.0});
    return s.finish();
}

std::function<Setting(int)> always(Setting (*make)()) {
    return [make](int) { return make(); };
}

}  // namespace

std::vector<HardCase> pose_cases() {
    std::vector<HardCase> cases;
    for (const int power : {3, 4, 5, 6, 7, 8}) {
        cases.push_back({.name = fmt::format("23_moved_by_1e{}_m", power),
                         .story = "single-precision world coordinates",
                         .make = [=](int) { return moved_away(std::pow(10.0, power)); }});
    }
    cases.push_back({.name = "25_mirrors",
                     .story = "a negative determinant turns every face over",
                     .make = always(mirrors)});
    cases.push_back({.name = "25_mirror_round_the_lamp",
                     .story = "a negative determinant, and casting from both sides",
                     .make = always(mirror_round_the_lamp)});
    cases.push_back({.name = "25_shears",
                     .story = "normals are not vectors; facing must not need them",
                     .make = always(shears)});
    for (const char* by : {"1e-3", "1e-2", "1e2", "1e3"}) {
        std::string name = std::string("25_one_axis_scaled_by_") + by;
        for (char& c : name) c = c == '-' ? 'm' : c;
        cases.push_back({.name = name,
                         .story = "the light's place in the caster's space leaves single precision",
                         .make = [by = std::stod(by)](int) { return uneven(by); }});
    }
    cases.push_back({.name = "25_pressed_and_drawn_out",
                     .story = "solids a thousandth as thick, or a thousand times as long",
                     .make = always(pressed_and_drawn_out)});
    return cases;
}

}  // namespace gnomon::test
