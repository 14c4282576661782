// SPDX-License-Identifier: MIT
//
// Caps as ranges of the mesh's own list, and far caps as near caps with another base vertex, give
// the same bytes as caps that are written out: on every device and stencil path, whoever extrudes,
// at one and at four samples, by depth-pass and by depth-fail, with far vertices at infinity and at
// finite places, and in batches.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include <fmt/format.h>

#include <gnomon/scene/primitives.hpp>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/rows/stage.hpp"
#include "tests/support/devices.hpp"
#include "tests/support/share.hpp"

namespace gnomon::test {
namespace {

using shadow_pass::ExtrusionPath;
using shadows::CapOptions;
using shadows::NearCaps;
using shadows::Technique;

// Next to all faces in ranges, and about half of them, of which the rest is drawn twice.
constexpr CapOptions all_in_ranges{.draw_worth_faces = 1, .max_ranges = 1'000'000};
constexpr CapOptions some_in_ranges{.draw_worth_faces = 3, .max_ranges = 4};

std::size_t ranges_in(const shadows::DrawList& list) {
    std::size_t ranges = 0;
    for (const shadows::VolumeDraw& draw : list.draws) ranges += draw.volume->ranges.size();
    return ranges;
}

class Caps : public DeviceTest {
protected:
    // Draws the setting plainly and with ranges. Returns how many ranges there were.
    std::size_t expect_same(const Setting& setting, PictureOptions options,
                            const std::string& what) {
        options.caps = CapOptions::plain();
        const Picture plain = must(take_picture(device(), setting, options));
        EXPECT_EQ(ranges_in(plain.list), 0U);
        std::size_t ranges = 0;
        for (const CapOptions& caps : {all_in_ranges, some_in_ranges}) {
            options.caps = caps;
            const Picture actual = must(take_picture(device(), setting, options));
            ranges += ranges_in(actual.list);
            for (std::size_t light = 0; light < plain.masks.size(); ++light) {
                for (std::size_t s = 0; s < plain.masks[light].size(); ++s) {
                    const auto& a = actual.masks[light][s];
                    const auto& e = plain.masks[light][s];
                    EXPECT_EQ(differing_bytes(a, e), 0U)
                        << what << ", light " << light << ", sample " << s << ": "
                        << save_difference("caps." + what, options.width, options.height, a, e);
                }
            }
        }
        return ranges;
    }
};

TEST_P(Caps, as_ranges_give_the_bytes_of_caps_written_out) {
    std::size_t ranges = 0;
    for (std::size_t i = 0; i < rows().size(); ++i) {
        if (!falls_to(number(), i, 2)) continue;
        const Row& row = rows()[i];
        const Setting setting = row.make();
        const PictureOptions options{.cull_back_faces = row.cull_back_faces};
        ranges += expect_same(setting, options, row.name);
    }
    EXPECT_GT(ranges, 100U);
}

TEST_P(Caps, as_ranges_give_them_at_four_samples_and_by_depth_fail) {
    for (std::size_t i = 0; i < rows().size(); ++i) {
        if (!falls_to(number(), i, 3)) continue;
        const Row& row = rows()[i];
        const PictureOptions options{.samples = 4,
                                     .technique = Technique::DepthFail,
                                     .cull_back_faces = row.cull_back_faces};
        expect_same(row.make(), options, row.name);
    }
}

// A ball whose triangles lie in any order, partly missing, partly turned over, some of them twice.
scene::Mesh shuffled_ball(std::mt19937& random) {
    const scene::Mesh ball = scene::make_sphere(0.7F, 24, 16);
    scene::Mesh mesh = ball;
    std::vector<std::array<std::uint32_t, 3>> faces;
    const bool closed = random() % 3 == 0;
    for (std::size_t i = 0; i < ball.indices.size(); i += 3) {
        std::array face{ball.indices[i], ball.indices[i + 1], ball.indices[i + 2]};
        if (!closed && random() % 16 == 0) continue;
        if (!closed && random() % 16 == 0) std::swap(face[1], face[2]);
        faces.push_back(face);
        if (!closed && random() % 16 == 0) faces.push_back(face);
    }
    // In pieces of sixteen, so that there are runs of all lengths.
    const std::size_t pieces = faces.size() / 16;
    for (std::size_t i = 1; i < pieces; ++i) {
        const std::size_t j = random() % i;
        std::swap_ranges(&faces[16 * i], &faces[16 * i] + 16, &faces[16 * j]);
    }
    mesh.indices.clear();
    for (const auto& face : faces)
        mesh.indices.insert(mesh.indices.end(), face.begin(), face.end());
    mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    return mesh;
}

Setting random_setting(std::mt19937& random, bool orthographic) {
    const auto coordinate = [&] { return static_cast<double>(random() % 2000) / 1000.0 - 1.0; };
    Stage s;
    s.ground();
    for (int i = 0; i < 3; ++i) {
        glm::dmat4 pose = moved({2.0 * coordinate(), 1.2 + 0.4 * coordinate(), coordinate()});
        if (i == 1) pose *= scaled({-1.0, 1.3, 0.7});
        s.place(shared(shuffled_ball(random)), pose);
    }
    s.lamp({3.0 * coordinate(), 4.0, 2.0 * coordinate()});
    s.lamp({0.1 * coordinate(), 1.2, 0.1});  // mostly within one
    s.sun({coordinate(), -1.0, 0.5});
    if (orthographic) {
        s.look_orthographic({0.5, 4.0, 6.0}, {0.0, 0.5, 0.0}, 3.0, 0.1, 20.0);
    } else {
        s.look({0.5, 2.5 + coordinate(), 5.0}, {0.0, 0.6, 0.0});
    }
    return s.finish();
}

TEST_P(Caps, of_random_meshes_give_the_same_bytes_every_way) {
    std::mt19937 random(20261125);
    std::size_t ranges = 0;
    for (int i = 0; i < 16; ++i) {
        const bool orthographic = i % 4 == 3 && features().unclipped_depth;
        const Setting setting = random_setting(random, orthographic);
        if (!falls_to(number(), static_cast<std::size_t>(i / 2), 2)) continue;
        PictureOptions options{
            .width = 160,
            .height = 120,
            .samples = i % 3 == 0 ? 4U : 1U,
            .extrusion = i % 5 == 0 ? ExtrusionPath::Cpu : ExtrusionPath::VertexShader,
            .near_caps = i % 2 == 0 ? NearCaps::Facing : NearCaps::Averted};
        if (i % 2 == 0) options.technique = Technique::DepthFail;
        if (i % 7 == 0) options.max_layers = 2;
        if (i % 3 == 1) options.averted_faces = shadow_pass::AvertedFaces::LeftToShading;
        ranges += expect_same(setting, options, fmt::format("random{}", i));
    }
    EXPECT_GT(ranges, 500U);
}

// Shells within each other in one mesh, more than a stencil counts.
TEST_P(Caps, of_split_volumes_give_the_same_bytes) {
    const scene::Mesh shell = scene::make_sphere(0.7F, 12, 8);
    scene::Mesh mesh = shell;
    for (int i = 1; i < 300; ++i) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& p : shell.positions) {
            mesh.positions.push_back(p * (1.0F - 0.0005F * static_cast<float>(i)));
        }
        for (const std::uint32_t index : shell.indices) mesh.indices.push_back(first + index);
        mesh.normals.insert(mesh.normals.end(), shell.normals.begin(), shell.normals.end());
    }
    mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    Stage s;
    s.ground();
    s.place(shared(std::move(mesh)), moved({0.1, 1.5, 0.05}));
    s.lamp({0.7, 5.0, 0.4});
    s.sun({-0.3, -1.0, -0.2});
    s.look({0.5, 3.5, 4.5}, {0.0, 0.2, 0.0});
    const Setting setting = s.finish();
    for (const std::uint32_t samples : {1U, 4U}) {
        if (!falls_to(number(), samples == 1 ? 0 : 1, 2)) continue;
        const PictureOptions options{
            .width = 160, .height = 120, .samples = samples, .technique = Technique::DepthFail};
        EXPECT_GT(expect_same(setting, options, fmt::format("shells.{}", samples)), 300U);
    }
}

INSTANTIATE_TEST_SUITE_P(Devices, Caps, testing::ValuesIn(drawing_devices()), device_case_name);

}  // namespace
}  // namespace gnomon::test
