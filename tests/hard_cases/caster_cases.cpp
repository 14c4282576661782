// SPDX-License-Identifier: MIT
//
// Which casters are drawn, how large they are, and how far their light reaches.
#include <array>
#include <cmath>

#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/hard_cases/hard_meshes.hpp"
#include "tests/rows/stage.hpp"

namespace gnomon::test {

namespace {

MeshPointer knot() { return shared(scene::make_torus_knot(1.0F, 0.32F, 2, 3, 96, 16)); }

// Between the eye and the ground, and touching a box that is drawn.
Setting hidden_caster(int) {
    Stage s;
    s.ground();
    s.place(knot(), moved({0.3, 1.75, 0.8}), true, false);
    s.place(shared(scene::make_box(glm::vec3(1.0F))), moved({-0.6, 0.5, -0.4}));
    s.lamp({1.5, 4.5, 2.0});
    s.look({0.5, 2.6, 4.5}, {0.0, 0.6, 0.0});
    return s.finish();
}

// The eye is within the hidden mesh itself, and within its shadow.
Setting eye_within_a_hidden_caster(int) {
    Stage s;
    s.ground();
    s.place(shared(scene::make_sphere(1.0F, 32, 16)), moved({0.0, 1.75, 2.0}), true, false);
    s.place(shared(scene::make_box(glm::vec3(1.0F))), moved({-0.6, 0.5, -0.4}));
    s.lamp({1.0, 4.5, 3.0});
    s.look({0.125, 1.75, 2.25}, {0.0, 0.6, 0.0}, 70.0);
    return s.finish();
}

// Three boxes at 2, 4 and 8 m from the lamp, which reaches from just the first one to all.
Setting lamp_of_finite_range(int frame) {
    Stage s;
    s.ground();
    const MeshPointer box = shared(scene::make_box(glm::vec3(0.75F, 1.5F, 0.75F)));
    s.place(box, moved({-1.5, 0.75, 0.0}));
    s.place(box, moved({0.5, 0.75, 0.5}));
    s.place(box, moved({4.5, 0.75, -0.5}));
    constexpr std::array<double, 4> ranges{3.0, 4.5, 7.0, 12.0};
    s.lamp({-3.0, 1.75, 0.25}, ranges[static_cast<std::size_t>(frame)]);
    s.look({0.5, 5.0, 6.5}, {0.5, 0.0, 0.0}, 60.0);
    return s.finish();
}

// The same under a camera that ends somewhere, and so do the volumes: with a far cap.
Setting lamp_of_finite_range_before_a_far_plane(int frame) {
    Setting setting = lamp_of_finite_range(frame);
    setting.view.clip_from_view = shadows::orthographic(4.8, 3.6, 0.5, 12.0);
    setting.view.projection = shadows::ProjectionKind::Orthographic;
    return setting;
}

// A bar of a kilometre leads through the view and past the eye: its ends are far outside, and most
// of it is beyond the lamp's range.
Setting caster_far_larger_than_view_and_range(int frame) {
    Stage s;
    s.ground(2000.0F);
    s.place(shared(scene::make_box(glm::vec3(0.5F, 0.5F, 1000.0F))), moved({0.0, 1.25, 0.0}));
    s.place(shared(scene::make_box(glm::vec3(1000.0F, 0.25F, 0.5F))), moved({0.0, 2.25, -3.0}));
    s.lamp({1.5, 4.0, -1.0}, frame == 0 ? 12.0 : 5000.0);
    s.look({2.5, 3.0, 3.5}, {-0.5, 0.3, 0.0}, 60.0);
    return s.finish();
}

// From below, from behind, from above, from the shadow: near and far caps now in view, now not.
Setting caps_in_and_out_of_view(int frame) {
    constexpr std::array<glm::dvec3, 6> eyes{{{0.0, 0.2, 4.0},
                                              {-2.0, 5.5, -2.0},
                                              {0.5, 6.5, 0.5},
                                              {-0.9, 0.4, -0.6},
                                              {3.5, 1.75, 0.0},
                                              {1.2, 3.6, 1.6}}};
    constexpr std::array<glm::dvec3, 6> targets{{{0.0, 0.9, 0.0},
                                                 {0.0, 0.5, 0.0},
                                                 {0.0, 0.0, 0.0},
                                                 {-3.0, 0.0, 1.0},
                                                 {0.0, 0.6, 0.0},
                                                 {-1.0, 0.0, -1.0}}};
    Stage s;
    s.ground();
    s.place(knot(), moved({0.0, 1.75, 0.0}));
    s.lamp({1.5, 4.5, 2.0});
    s.look(eyes[static_cast<std::size_t>(frame)], targets[static_cast<std::size_t>(frame)], 60.0);
    return s.finish();
}

}  // namespace

std::vector<HardCase> caster_cases() {
    std::vector<HardCase> cases;
    add_by_both(cases,
                {.name = "13_hidden_caster",
                 .story = "caps left out or put at infinity need a caster in the depth buffer",
                 .make = hidden_caster});
    cases.push_back({.name = "13_eye_within_a_hidden_caster",
                     .story = "nothing that is drawn says that the eye is in a volume",
                     .make = eye_within_a_hidden_caster});
    add_by_both(cases, {.name = "17_lamp_of_finite_range",
                        .story = "volumes that end early lose shadows or pierce floors",
                        .make = lamp_of_finite_range,
                        .frames = 4});
    cases.push_back({.name = "17_lamp_of_finite_range_before_a_far_plane",
                     .story = "a far cap beyond the far plane loses the whole shadow",
                     .make = lamp_of_finite_range_before_a_far_plane,
                     .frames = 4});
    cases.push_back({.name = "27_caster_far_larger_than_view_and_range",
                     .story = "casters that are clipped to the light grow edges of their own",
                     .make = caster_far_larger_than_view_and_range,
                     .frames = 2});
    add_by_both(cases, {.name = "30_caps_in_and_out_of_view",
                        .story = "caps skipped because the view cannot see them",
                        .make = caps_in_and_out_of_view,
                        .frames = 6});
    return cases;
}

}  // namespace gnomon::test
