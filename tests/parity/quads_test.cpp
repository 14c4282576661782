// SPDX-License-Identifier: MIT
//
// Volumes from quads on every edge: with uploaded facing the very bytes of the volumes that the CPU
// makes, on every device and stencil path, at one and at four samples, by depth-pass and by
// depth-fail; with facing decided in the shader the same on every device, and no leak.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/rows/stage.hpp"
#include "tests/shadows/random_meshes.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

using shadows::LayerBound;
using shadows::NearCaps;
using shadows::Technique;

std::vector<DeviceCase> devices() {
    std::vector<DeviceCase> usable;
    for (const DeviceCase& device_case : drawing_devices()) {
        auto device = shared_device(device_case);
        if (device) {
            usable.push_back(device_case);
        } else {
            EXPECT_FALSE(is_required(device_case.name)) << device.error().message;
        }
    }
    return usable;
}

Picture take(const DeviceCase& device_case, const Setting& setting, PictureOptions options) {
    TestDevice* device = must(shared_device(device_case));
    options.layer_bound = LayerBound::Promised;
    return must(take_picture(device->device, setting, options));
}

void expect_equal(const Picture& actual, const Picture& expected, const std::string& what) {
    ASSERT_EQ(actual.masks.size(), expected.masks.size()) << what;
    for (std::size_t light = 0; light < expected.masks.size(); ++light) {
        for (std::size_t sample = 0; sample < expected.masks[light].size(); ++sample) {
            const auto& a = actual.masks[light][sample];
            const auto& e = expected.masks[light][sample];
            const std::size_t wrong = differing_bytes(a, e);
            if (wrong == 0) continue;
            ADD_FAILURE() << what << ": " << wrong << " stencil bytes of light " << light
                          << ", sample " << sample << " differ; see "
                          << save_difference(
                                 fmt::format("quads.{}.light{}.s{}", what, light, sample),
                                 row_width, row_height, a, e);
        }
    }
    EXPECT_EQ(differing_bytes(actual.depth, expected.depth), 0U) << what << ": depth";
}

// The draws of a list of the CPU's that the GPU could have made: closed casters that cast
// one-sided.
std::size_t could_be_quads(const shadows::DrawList& list) {
    return static_cast<std::size_t>(std::ranges::count_if(list.draws, [](const auto& draw) {
        const bool two_sided =
            draw.volume->near_cap.faces > 0 && draw.volume->near_cap_flipped.faces > 0;
        return shadows::fits_edge_quads(*draw.mesh) && !two_sided &&
               glm::determinant(glm::dmat3(draw.world_from_local)) != 0.0;
    }));
}

struct Drawn {
    std::uint32_t samples = 1;
    std::optional<Technique> technique = std::nullopt;
};

// Each device against itself: two passes with culling may see slivers of random meshes otherwise
// than one pass does.
void expect_same_bytes(const Setting& setting, const std::string& name, PictureOptions options,
                       std::initializer_list<Drawn> ways) {
    const auto usable = devices();
    if (usable.empty()) GTEST_SKIP() << "no drawing device";
    for (const DeviceCase& device : usable) {
        for (const Drawn& way : ways) {
            options.samples = way.samples;
            options.technique = way.technique;
            options.silhouette = "brute_force";
            const Picture expected = take(device, setting, options);
            ASSERT_FALSE(expected.masks.empty());
            EXPECT_EQ(expected.list.stats.quad_pairs, 0U);
            options.silhouette = "gpu_quads";
            const Picture actual = take(device, setting, options);
            EXPECT_EQ(actual.list.stats.quad_pairs, could_be_quads(expected.list)) << name;
            expect_equal(actual, expected,
                         fmt::format("{}.{}.{}{}", name, device.name, way.samples,
                                     way.technique ? ".zfail" : ""));
        }
    }
}

class Quads : public testing::TestWithParam<Row> {};

TEST_P(Quads, give_the_same_bytes) {
    expect_same_bytes(GetParam().make(), GetParam().name,
                      {.cull_back_faces = GetParam().cull_back_faces},
                      {{1}, {4, Technique::DepthFail}});
}

TEST_P(Quads, give_the_same_bytes_with_averted_caps) {
    expect_same_bytes(GetParam().make(), GetParam().name + ".averted",
                      {.near_caps = NearCaps::Averted,
                       .averted_faces = shadow_pass::AvertedFaces::LeftToShading,
                       .cull_back_faces = GetParam().cull_back_faces},
                      {{1}});
}

// A leak would be a streak across the picture.
TEST_P(Quads, that_decide_in_the_shader_are_the_same_on_every_device) {
    const auto usable = devices();
    if (usable.empty()) GTEST_SKIP() << "no drawing device";
    const Setting setting = GetParam().make();
    PictureOptions options{.silhouette = "gpu_quads_float",
                           .cull_back_faces = GetParam().cull_back_faces};
    const Picture first = take(usable[0], setting, options);
    EXPECT_EQ(first.list.stats.detection.faces_tested > 0,
              first.list.stats.quad_pairs < first.list.draws.size())
        << "the CPU looks at no face of these";
    for (const DeviceCase& device : usable) {
        expect_equal(take(device, setting, options), first, GetParam().name + "." + device.name);
    }
    // What a host gets whose vertex stage is not its own: the same decisions, made by the CPU.
    options.extrusion = shadow_pass::ExtrusionPath::Cpu;
    expect_equal(take(usable[0], setting, options), first, GetParam().name + ".cpu");
}

// Some of each kind: several lights, the eye and the near plane in volumes, poses that turn
// triangles over, far vertices at finite places, casters that the GPU may not draw.
std::vector<Row> some_rows() {
    constexpr std::array<std::string_view, 5> names{
        "still_life_three_lights", "eye_inside_a_volume", "mirrored_and_sheared",
        "orthographic_near_plane_in_a_volume", "open_meshes"};
    std::vector<Row> some;
    for (const Row& row : rows()) {
        if (std::ranges::find(names, row.name) != names.end()) some.push_back(row);
    }
    EXPECT_EQ(some.size(), names.size());
    return some;
}

INSTANTIATE_TEST_SUITE_P(Rows, Quads, testing::ValuesIn(some_rows()),
                         [](const auto& param) { return param.param.name; });

MeshPointer mesh_of(const Triangles& triangles) {
    scene::Mesh mesh;
    mesh.name = "random";
    mesh.positions = triangles.positions;
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 1, 0));
    mesh.indices = triangles.indices;
    mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    return shared(std::move(mesh));
}

glm::dmat4 posed(Random& random) {
    glm::dmat4 pose = moved(random.in_cube(3.0) + glm::dvec3(0, 4, 0)) *
                      glm::dmat4(random.rotation()) *
                      scaled(glm::dvec3(0.3) + 0.5 * glm::abs(random.in_cube(1.0)));
    if (random.chance(0.3)) pose[1] = -pose[1];
    return pose;
}

// Any closed mesh and pose, a lamp and a sun from anywhere above, an eye anywhere.
TEST(RandomQuads, give_the_same_bytes) {
    GNOMON_RANDOM(random);
    std::size_t quads = 0;
    for (int i = 0; i < 1; ++i) {
        Stage stage;
        stage.ground();
        for (int placed = 0; placed < 6;) {
            const Triangles triangles = random.chance(0.5)
                                            ? random_mesh(random)
                                            : sphere(random.integer(3, 20), random.integer(3, 20));
            if (triangles.count() == 0 || !shadows::fits_edge_quads(*build(triangles))) continue;
            stage.place(mesh_of(triangles), posed(random));
            ++placed;
        }
        stage.lamp(random.in_cube(4.0) + glm::dvec3(0, 9, 0));
        stage.sun(glm::dvec3(random.integer(-1, 1), -1, random.integer(-1, 1)));
        stage.look(random.in_cube(6.0) + glm::dvec3(0, 8, 9), {0, 2, 0});
        const Setting setting = stage.finish();
        expect_same_bytes(setting, fmt::format("random{}", i), {},
                          {{1}, {1, Technique::DepthFail}, {4}});
        quads +=
            take(drawing_devices()[0], setting, {.silhouette = "gpu_quads"}).list.stats.quad_pairs;
    }
    EXPECT_GT(quads, 4U) << "these were to be drawn by the GPU";
}

// Where the layers are to be proved, pairs come back from the GPU, are split, and say so.
TEST(Quads, are_taken_back_where_layers_have_to_be_proved) {
    const auto usable = devices();
    if (usable.empty()) GTEST_SKIP() << "no drawing device";
    const Setting setting = rows()[0].make();
    for (const std::string_view name : {"gpu_quads", "gpu_quads_float"}) {
        for (const std::uint32_t most : {255U, 3U}) {
            TestDevice* device = must(shared_device(usable[0]));
            const Picture expected =
                must(take_picture(device->device, setting, {.max_layers = most}));
            const Picture actual = must(take_picture(
                device->device, setting, {.max_layers = most, .silhouette = std::string(name)}));
            expect_equal(actual, expected, fmt::format("{}.proved{}", name, most));
            EXPECT_LT(actual.list.stats.quad_pairs, could_be_quads(expected.list));
            EXPECT_EQ(actual.list.stats.stencil_batches, expected.list.stats.stencil_batches);
            EXPECT_EQ(actual.list.stats.silhouette_edges, expected.list.stats.silhouette_edges);
        }
    }
}

}  // namespace
}  // namespace gnomon::test
