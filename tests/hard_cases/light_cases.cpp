// SPDX-License-Identifier: MIT
//
// Where a light may be: near, far, on the mesh, within it, infinitely far away.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/hard_cases/hard_meshes.hpp"
#include "tests/rows/stage.hpp"

namespace gnomon::test {

namespace {

template <std::size_t N>
const glm::dvec3& nth(const std::array<glm::dvec3, N>& places, int frame) {
    return places[static_cast<std::size_t>(frame)];
}

// A flat box below a lamp: the corner nearest to the camera shadows the origin, whatever the
// distances. `view_m`: how large what is seen is, roughly.
struct Plate {
    double lamp_m = 0.0;
    double plate_m = 0.0;
    double size_m = 0.0;
    double view_m = 1.0;
};
Setting plate_below_a_lamp(const Plate& plate) {
    const glm::dvec3 way(0.25, 1.0, 0.125);
    const double size = plate.size_m;
    Stage s;
    s.ground(20.0F, scaled(glm::dvec3(plate.view_m)));
    s.place(shared(grid_cube(2)), moved(plate.plate_m * way) * scaled({size, 0.125 * size, size}) *
                                      moved({-1.0, 1.0, -1.0}));
    s.lamp(plate.lamp_m * way);
    s.look(plate.view_m * glm::dvec3(1.5, 3.0, 5.0), glm::dvec3(0.0), 50.0, 0.01 * plate.view_m);
    return s.finish();
}

// A millimetre to a thousand kilometres in steps of ten.
double decade(int frame) { return std::pow(10.0, frame - 3); }

// A caster about as small as its distance from the lamp, which hangs two metres up.
Setting caster_close_to_the_lamp(int frame) {
    const double size = decade(frame);
    return plate_below_a_lamp({2.0, 2.0 - 1.5 * size, size});
}
// A caster up there that is as large as it is far, and the lamp as far behind it.
Plate far_away(double height) { return {2.0 * height, height, height}; }
Setting caster_far_away(int frame) { return plate_below_a_lamp(far_away(decade(frame + 3))); }
// Farther: single precision places a volume within a few millionths of its caster's distance, so
// what is seen is larger, too.
Setting caster_far_from_a_large_view(int frame) {
    Plate plate = far_away(decade(frame + 8));
    plate.view_m = decade(frame + 5);
    return plate_below_a_lamp(plate);
}
Setting caster_far_from_a_small_view(int) { return plate_below_a_lamp(far_away(1e6)); }
// A caster close to the ground, and only the lamp far away.
Setting lamp_far_away(int frame) { return plate_below_a_lamp({2.0 * decade(frame + 3), 1.0, 1.5}); }

// All of it large or small, the camera as well.
Setting everything_scaled(int frame) {
    const double size = decade(frame);
    const glm::dmat4 scale = scaled(glm::dvec3(size));
    Stage s;
    s.ground(20.0F, scale);
    s.place(shared(scene::make_torus_knot(1.0F, 0.32F, 2, 3, 96, 16)),
            scale * moved({0.0, 1.75, 0.0}));
    s.lamp(size * glm::dvec3(1.5, 4.5, 2.0));
    s.look(size * glm::dvec3(0.0, 3.0, 5.0), size * glm::dvec3(0.0, 0.8, 0.0), 50.0, 0.05 * size);
    return s.finish();
}

// Straight down, along two axes of a cube, flat, and slanted: half of a cube's faces are parallel
// to the first of these.
Setting sun_along_axes(int frame) {
    constexpr std::array<glm::dvec3, 5> ways{{{0.0, -1.0, 0.0},
                                              {-1.0, -1.0, 0.0},
                                              {0.0, -1.0, -2.0},
                                              {-8.0, -1.0, 1.0},
                                              {0.3, -1.0, -0.7}}};
    Stage s;
    s.ground();
    s.place(shared(grid_cube(4)), moved({-1.5, 1.75, 0.0}));
    s.place(shared(scene::make_torus_knot(0.75F, 0.25F, 2, 3, 96, 16)), moved({1.5, 1.5, 0.0}));
    s.sun(nth(ways, frame));
    s.look({0.0, 4.0, 6.5}, {0.0, 0.6, 0.0});
    return s.finish();
}

Setting lamp_within_a_knots_bounds(int frame) {
    constexpr std::array<glm::dvec3, 3> places{
        {{0.0, 2.25, 0.0}, {0.0, 2.5, 0.0}, {0.5, 1.8, -0.75}}};
    Stage s;
    s.ground();
    s.place(shared(scene::make_torus_knot(1.0F, 0.25F, 2, 3, 96, 16)), moved({0.0, 2.25, 0.0}));
    s.lamp(nth(places, frame));
    s.look({0.5, 4.0, 6.5}, {0.0, 0.9, 0.0});
    return s.finish();
}

// A corner, an edge's middle, inside an edge's face pair, a side's middle, amid a triangle.
Setting lamp_on_a_cube(int frame) {
    constexpr std::array<glm::dvec3, 5> places{{{1.0, 2.25, 1.0},
                                                {1.0, 2.25, 0.0},
                                                {1.0, 1.75, 1.0},
                                                {1.0, 1.25, 0.0},
                                                {1.0, 1.5, 0.125}}};
    Stage s;
    s.ground();
    s.place(shared(grid_cube(2)), moved({0.0, 1.25, 0.0}));
    s.lamp(nth(places, frame));
    s.look({4.0, 5.0, 4.0}, {0.6, 0.0, 0.6});
    return s.finish();
}

// The lamp in a closed sphere lights nothing outside of it; the other one lights the rest.
Setting lamp_inside_a_closed_mesh(int) {
    Stage s;
    s.ground();
    s.place(shared(scene::make_sphere(1.0F, 32, 16)), moved({0.0, 1.5, 0.0}));
    s.lamp({0.125, 1.75, -0.25});
    s.lamp({2.5, 4.0, 1.5});
    s.look({0.0, 3.2, 5.2}, {0.0, 0.8, 0.0});
    return s.finish();
}

// A closed room round lamp, camera and all.
Setting lamp_inside_a_room(int frame) {
    Stage s;
    s.place(shared(grid_cube(2)), moved({0.0, 3.0, 0.0}) * scaled({5.0, 3.0, 5.0}));
    s.place(shared(scene::make_torus_knot(1.0F, 0.32F, 2, 3, 96, 16)), moved({0.0, 2.0, 0.0}));
    s.lamp(frame == 0 ? glm::dvec3(1.5, 5.0, 2.0) : glm::dvec3(-3.0, 1.0, 1.0));
    s.look({0.5, 4.0, 4.75}, {0.0, 1.6, 0.0}, 70.0);
    return s.finish();
}

}  // namespace

std::vector<HardCase> light_cases() {
    std::vector<HardCase> cases;
    struct Depth {
        gpu::Format format;
        const char* name;
    };
    for (const Depth& depth : {Depth{gpu::Format::Depth32FloatStencil8, "d32f_s8"},
                               Depth{gpu::Format::Depth24UnormStencil8, "d24_s8"}}) {
        const auto add = [&](const char* name, const char* story, Setting (*make)(int),
                             int frames) {
            cases.push_back({.name = fmt::format("09_{}_{}", name, depth.name),
                             .story = story,
                             .make = make,
                             .frames = frames,
                             .options = {.depth_stencil_format = depth.format}});
        };
        add("caster_close_to_the_lamp", "a short volume, stretched by epsilons",
            caster_close_to_the_lamp, 4);
        add("caster_far_away", "a volume that ends before or beyond the far plane", caster_far_away,
            5);
        add("caster_far_from_a_large_view", "a volume that ends before or beyond the far plane",
            caster_far_from_a_large_view, 2);
        add("caster_far_from_a_small_view", "vertices are placed in single precision",
            caster_far_from_a_small_view, 1);
        add("lamp_far_away", "a lamp's rays are nearly parallel, and its distance all that is left",
            lamp_far_away, 7);
        add("everything_scaled", "an epsilon has a size", everything_scaled, 10);
    }
    add_by_both(cases, {.name = "11_sun_along_axes",
                        .story = "all far vertices are one point, and many faces edge-on",
                        .make = sun_along_axes,
                        .frames = 5});
    cases.push_back({.name = "14_lamp_within_a_knots_bounds",
                     .story = "a far cap of fans covers the wrong half of all directions",
                     .make = lamp_within_a_knots_bounds,
                     .frames = 3});
    add_by_both(cases, {.name = "16_lamp_on_a_cube",
                        .story = "faces and edges that the light touches have no side",
                        .make = lamp_on_a_cube,
                        .frames = 5});
    cases.push_back({.name = "16_lamp_inside_a_closed_mesh",
                     .story = "front and back have changed places",
                     .make = lamp_inside_a_closed_mesh});
    cases.push_back({.name = "16_lamp_inside_a_room",
                     .story = "front and back have changed places, and the eye is in the volume",
                     .make = lamp_inside_a_room,
                     .frames = 2});
    return cases;
}

}  // namespace gnomon::test
