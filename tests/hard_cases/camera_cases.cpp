// SPDX-License-Identifier: MIT
//
// From where a scene may be seen.
#include <array>
#include <cmath>
#include <random>

#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/rows/stage.hpp"

namespace gnomon::test {

namespace {

using shadows::ProjectionKind;

MeshPointer box(const glm::vec3& size) { return shared(scene::make_box(size)); }
MeshPointer knot() { return shared(scene::make_torus_knot(1.0F, 0.32F, 2, 3, 96, 16)); }

const PictureOptions small_picture{.width = 128, .height = 96};

// --- 07: a camera that crosses a volume's side ---

// A long bar over the ground. The right side of its volume lies in one plane for both lights, and
// the points (1.5, 1, z) and (2, 0, z) in that plane: exact in binary. The small box stands across
// the shadow's edge.
Stage bar_over_the_ground() {
    Stage s;
    s.ground();
    s.place(box({1.0F, 1.0F, 8.0F}), moved({0.0, 2.5, -3.0}));
    s.place(box(glm::vec3(0.5F)), moved({1.875, 0.25, -3.5}) * turned(30, {0, 1, 0}));
    s.lamp({-0.5, 5.0, 0.0});
    s.sun({1.0, -2.0, 0.0});
    return s;
}

constexpr int sweep_frames = 9;

// 1e-4 m a frame across the side; in the middle frame the eye lies in it, exactly, and so does the
// line of sight.
glm::dvec3 eye_of_sweep(int frame) { return {1.5 + 1e-4 * (frame - sweep_frames / 2), 1.0, 0.0}; }
constexpr glm::dvec3 along_the_side(0.5, -1.0, -3.0);

// The near rectangle is 3e-4 m high whatever the field of view: the sweep begins before it touches
// the side and ends behind.
constexpr double near_half_height = 1.5e-4;

HardCase sweep(const std::string& name, std::function<void(Stage&, const glm::dvec3& eye)> aim) {
    return {.name = "07_sweep_through_a_side_" + name,
            .story = "a near plane that cuts a volume's side spoils depth-pass",
            .make =
                [aim = std::move(aim)](int frame) {
                    Stage s = bar_over_the_ground();
                    aim(s, eye_of_sweep(frame));
                    return s.finish();
                },
            .frames = sweep_frames,
            .options = small_picture};
}

std::vector<HardCase> sweeps() {
    std::vector<HardCase> cases;
    for (const int degrees : {5, 50, 120, 170}) {
        cases.push_back(sweep("fov_" + std::to_string(degrees), [=](Stage& s, glm::dvec3 eye) {
            const double near_m = near_half_height / std::tan(glm::radians(degrees * 0.5));
            s.look(eye, eye + along_the_side, degrees, near_m);
        }));
    }
    cases.push_back(sweep("off_axis", [](Stage& s, const glm::dvec3& eye) {
        s.look(eye, eye + along_the_side);
        const double h = near_half_height;
        s.view().clip_from_view =
            shadows::infinite_frustum(-0.4 * h, 2.0 * h, -1.5 * h, 0.3 * h, 2.0 * h);
    }));
    cases.push_back(sweep("far_plane", [](Stage& s, const glm::dvec3& eye) {
        s.look(eye, eye + along_the_side);
        s.view().clip_from_view = shadows::finite_perspective(
            glm::radians(50.0), static_cast<double>(row_width) / row_height,
            near_half_height / std::tan(glm::radians(25.0)), 6.0);
        s.view().projection = ProjectionKind::FinitePerspective;
    }));
    cases.push_back(sweep("orthographic", [](Stage& s, const glm::dvec3& eye) {
        s.look_orthographic(eye, eye + along_the_side, 1.5, 0.25, 12.0);
    }));
    // Lines of sight at a slant to the near plane, as in a cabinet projection.
    cases.push_back(sweep("oblique", [](Stage& s, const glm::dvec3& eye) {
        s.look_orthographic(eye, eye + along_the_side, 1.5, 0.25, 12.0);
        glm::dmat4 slant(1.0);
        slant[2][0] = 0.25;
        slant[2][1] = -0.125;
        s.view().clip_from_view = s.view().clip_from_view * slant;
    }));
    return cases;
}

// An orthographic near plane that takes the bar's upper front edge away, 1e-4 m a frame: in the
// middle frame the edge lies in it, exactly but for the rounding of the view.
Setting near_plane_over_an_edge(int frame) {
    Stage s = bar_over_the_ground();
    const glm::dvec3 eye(0.5, 6.0, 5.0);  // the edge is 5 m ahead of it
    s.look_orthographic(eye, eye + glm::dvec3(0.0, -3.0, -4.0), 2.5,
                        5.0 + 1e-4 * (frame - sweep_frames / 2), 20.0);
    return s.finish();
}

// --- 08, 32: an eye in the plane of a volume's side ---

// The eye is the mirror image of the lamp in a point of a silhouette edge: in the side that hangs
// from that edge, without any rounding. Then a little beside it.
Setting eye_on_a_side(int frame) {
    constexpr glm::dvec3 lamp(-1.25, 3.75, 1.5);
    // The six edges between the box's lit and averted faces.
    constexpr std::array<std::array<glm::dvec3, 2>, 6> silhouette{{
        {{{0.5, 3.0, -0.5}, {0.5, 3.0, 0.5}}},
        {{{-0.5, 3.0, -0.5}, {0.5, 3.0, -0.5}}},
        {{{0.5, 2.0, 0.5}, {0.5, 3.0, 0.5}}},
        {{{-0.5, 2.0, 0.5}, {0.5, 2.0, 0.5}}},
        {{{-0.5, 2.0, -0.5}, {-0.5, 2.0, 0.5}}},
        {{{-0.5, 2.0, -0.5}, {-0.5, 3.0, -0.5}}},
    }};
    constexpr std::array<double, 4> beside{0.0, 1e-12, -1e-9, 1e-6};
    std::minstd_rand random(static_cast<unsigned>(frame) + 1);
    random.discard(10);
    const double t = static_cast<double>(random() % 65) / 64.0;
    const auto& edge = silhouette[static_cast<std::size_t>(frame) % silhouette.size()];
    const glm::dvec3 p = edge[0] + t * (edge[1] - edge[0]);
    const double off = beside[static_cast<std::size_t>(frame) / silhouette.size() % beside.size()];
    Stage s;
    s.ground();
    s.place(box(glm::vec3(1.0F)), moved({0.0, 2.5, 0.0}));
    s.place(box(glm::vec3(0.75F)), moved({2.5, 0.375, -3.0}));
    s.lamp(lamp);
    s.look(2.0 * p - lamp + off * glm::dvec3(1.0, 0.5, -0.25), {2.5, 0.0, -3.0}, 70.0);
    return s.finish();
}

// --- 09: far planes, depth formats, far-away eyes ---

void see_until(Stage& s, double fovy_deg, double near_m, double far_m) {
    s.view().clip_from_view = shadows::finite_perspective(
        glm::radians(fovy_deg), static_cast<double>(row_width) / row_height, near_m, far_m);
    s.view().projection = ProjectionKind::FinitePerspective;
}

Stage still_life() {
    Stage s;
    s.ground();
    s.place(knot(), moved({-0.6, 1.6, 0.0}) * turned(20, {1, 0, 1}));
    s.place(box(glm::vec3(0.8F)), moved({1.6, 0.6, 1.0}) * turned(35, {0.2, 1, 0}));
    s.lamp({1.7, 4.1, 1.3});
    s.sun({-0.6, -1.0, -0.5});
    return s;
}

// The far plane goes through the knot, and every volume through the far plane.
Setting far_plane_in_the_scene() {
    Stage s = still_life();
    s.look({0.0, 2.6, 5.5}, {0.0, 0.7, 0.0});
    see_until(s, 50.0, 0.1, 6.0);
    return s.finish();
}

// A far plane within a hair of the near one: depth runs from 1 to 0 in 2 m.
Setting thin_slab_of_depth() {
    Stage s = still_life();
    s.look({0.0, 2.6, 5.5}, {0.0, 0.7, 0.0});
    see_until(s, 50.0, 4.9, 6.9);
    return s.finish();
}

Setting infinite_view_of_still_life() {
    Stage s = still_life();
    s.look({0.0, 2.6, 5.5}, {0.0, 0.7, 0.0}, 50.0, 0.1);
    return s.finish();
}

// The same picture from ten times as far each frame, 10 m to 1e5 m, through a longer lens. From
// 1e6 m a float's depth has steps of a tenth of a metre: there is nothing left to judge.
Setting eye_far_away(int frame) {
    const double distance = std::pow(10.0, frame + 1);
    Stage s = still_life();
    s.look(distance * glm::normalize(glm::dvec3(0.0, 2.2, 5.5)), {0.0, 0.7, 0.0},
           glm::degrees(2.0 * std::atan(2.6 / distance)), 0.25 * distance);
    return s.finish();
}

// A doll's house a millimetre before the eye, and a mountain's shadow behind it.
Setting eye_close_up(int frame) {
    const double size = std::pow(10.0, -frame - 1);
    Stage s;
    s.ground(20.0F, scaled(glm::dvec3(size)));
    s.place(knot(), moved({-0.6 * size, 1.6 * size, 0.0}) * scaled(glm::dvec3(size)));
    s.lamp(size * glm::dvec3(1.7, 4.1, 1.3));
    s.sun({-0.6, -1.0, -0.5});
    s.look(size * glm::dvec3(0.0, 2.6, 5.5), size * glm::dvec3(0.0, 0.7, 0.0), 50.0, 1e-5);
    return s.finish();
}

// --- 10: volumes that come towards the camera ---

Stage against_the_light(const glm::dvec3& eye, const glm::dvec3& target, double fovy_deg) {
    Stage s;
    s.ground();
    s.place(knot(), moved({0.0, 1.7, -1.0}));
    s.place(box(glm::vec3(0.8F)), moved({1.6, 0.6, 0.8}) * turned(35, {0.2, 1, 0}));
    s.look(eye, target, fovy_deg);
    return s;
}

Setting lamp_behind_the_scene() {
    Stage s = against_the_light({0.0, 2.2, 5.0}, {0.0, 1.0, 0.0}, 60.0);
    s.lamp({0.3, 3.2, -5.0});
    s.sun({0.1, -0.35, 1.0});
    return s.finish();
}

// Wide, from within the knot's shadow: the volumes close far behind the eye.
Setting eye_in_the_shadow_of_a_knot() {
    Stage s = against_the_light({0.1, 0.9, 2.0}, {0.0, 0.8, 0.0}, 120.0);
    s.lamp({0.0, 2.4, -3.0});
    s.sun({0.0, -0.3, 1.0});
    return s.finish();
}

// The lamp exactly on the line of sight, behind the box that hides it.
Setting lamp_on_the_line_of_sight() {
    Stage s;
    s.ground();
    s.place(box(glm::vec3(1.0F)), moved({0.0, 1.5, -1.0}));
    s.place(knot(), moved({0.0, 0.3, 0.5}) * scaled(glm::dvec3(0.75)) * turned(90, {1, 0, 0}));
    s.lamp({0.0, 1.5, -4.0});
    s.look({0.0, 1.5, 4.0}, {0.0, 1.5, 0.0}, 70.0);
    return s.finish();
}

// Light that travels square to the line of sight: far vertices have clip w = 0 and z = 0, exactly.
Setting far_vertices_in_the_eye_plane() {
    Stage s = against_the_light({0.0, 1.5, 5.0}, {0.0, 1.5, 0.0}, 60.0);
    s.sun({1.0, -1.0, 0.0});
    s.sun({-1.0, -0.5, 0.0});
    return s.finish();
}

// --- 12: near caps on the surfaces that they copy ---

// Casters under random matrices, light that grazes them; every pair by depth-fail, so that each
// lit face has its own cap upon it.
Setting caps_under_random_matrices(int frame) {
    std::minstd_rand random(static_cast<unsigned>(frame) + 77);
    random.discard(10);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() % 1'000'003) / 1'000'002.0;
    };
    Stage s;
    s.ground();
    for (const double x : {-2.0, 0.0, 2.0}) {
        glm::dmat4 any(1.0);
        for (int column = 0; column < 3; ++column) {
            for (int row = 0; row < 3; ++row) any[column][row] += uniform(-0.7, 0.7);
        }
        s.place(x == 0.0 ? knot() : shared(scene::make_torus(0.8F, 0.35F, 40, 20)),
                moved({x, 1.2, uniform(-1.0, 1.0)}) * any * scaled(glm::dvec3(0.7)));
    }
    s.lamp({uniform(-4.0, 4.0), 2.6, uniform(2.0, 3.0)});
    s.sun({uniform(-1.0, 1.0), -0.4, -1.0});
    s.look({uniform(-2.0, 2.0), 3.4, 5.0}, {0.0, 0.8, -0.5});
    return s.finish();
}

std::function<Setting(int)> always(Setting (*make)()) {
    return [make](int) { return make(); };
}

}  // namespace

std::vector<HardCase> camera_cases() {
    const PictureOptions d24{.depth_stencil_format = gpu::Format::Depth24UnormStencil8};
    const std::string near_clips = "a near plane that cuts a volume's side spoils depth-pass";
    const std::string far_clips = "a far plane opens volumes behind the surface";
    const std::string behind = "far vertices behind the eye: w < 0, never to be divided by";
    std::vector<HardCase> cases = sweeps();
    cases.push_back({.name = "07_orthographic_near_plane_over_an_edge",
                     .story = near_clips,
                     .make = near_plane_over_an_edge,
                     .frames = sweep_frames,
                     .options = small_picture});
    cases.push_back({.name = "08_eyes_on_a_side",
                     .story = "whether the eye is in shadow cannot be told, and must not matter",
                     .make = eye_on_a_side,
                     .frames = 24,
                     .options = small_picture});
    cases.push_back({.name = "09_far_plane_in_the_scene",
                     .story = far_clips,
                     .make = always(far_plane_in_the_scene)});
    cases.push_back({.name = "09_far_plane_in_the_scene_d24",
                     .story = far_clips,
                     .make = always(far_plane_in_the_scene),
                     .options = d24});
    cases.push_back(
        {.name = "09_thin_slab_of_depth", .story = far_clips, .make = always(thin_slab_of_depth)});
    cases.push_back({.name = "09_infinite_view_d24",
                     .story = "24 bits of depth, far vertices at depth 0",
                     .make = always(infinite_view_of_still_life),
                     .options = d24});
    cases.push_back({.name = "09_eye_far_away",
                     .story = "from 1e5 m, depths that differ become equal",
                     .make = eye_far_away,
                     .frames = 5,
                     .options = {.width = 160, .height = 120}});
    cases.push_back({.name = "09_eye_close_up",
                     .story = "scenes of 1 m down to 1e-3 m, with a near plane at 1e-5 m",
                     .make = eye_close_up,
                     .frames = 4,
                     .options = {.width = 160, .height = 120}});
    cases.push_back({.name = "10_lamp_behind_the_scene",
                     .story = behind,
                     .make = always(lamp_behind_the_scene)});
    cases.push_back({.name = "10_eye_in_the_shadow_of_a_knot",
                     .story = behind,
                     .make = always(eye_in_the_shadow_of_a_knot)});
    cases.push_back({.name = "10_lamp_on_the_line_of_sight",
                     .story = behind,
                     .make = always(lamp_on_the_line_of_sight)});
    cases.push_back({.name = "10_far_vertices_in_the_eye_plane",
                     .story = "far vertices with clip w = 0 and z = 0",
                     .make = always(far_vertices_in_the_eye_plane)});
    cases.push_back(
        {.name = "12_caps_under_random_matrices",
         .story = "a near cap computed in another way fights with its surface",
         .make = caps_under_random_matrices,
         .frames = 6,
         .options = {.width = 160, .height = 120, .technique = shadows::Technique::DepthFail}});
    for (const char* name :
         {"eye_inside_a_volume", "near_plane_cuts_a_volume", "mirrored_and_sheared", "open_meshes",
          "orthographic", "wall_of_bricks"}) {
        for (const Row& row : rows()) {
            if (row.name != name) continue;
            cases.push_back({.name = "29_four_samples_" + row.name,
                             .story = "each sample has a count of its own",
                             .make = [row](int) { return row.make(); },
                             .options = {.width = 160, .height = 120, .samples = 4}});
        }
    }
    return cases;
}

}  // namespace gnomon::test
