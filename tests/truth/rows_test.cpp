// SPDX-License-Identifier: MIT
//
// The rows of the parity suite against ray-traced shadows: outside the band of 1/16 pixel round
// true shadow edges no pixel is wrong. And the judge can tell: volumes spoiled on purpose are
// found.
#include <gtest/gtest.h>

#include <cstdio>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/silhouette.hpp>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/support/devices.hpp"
#include "tests/truth/traced.hpp"

namespace gnomon::test {
namespace {

DeviceCase drawing_device() { return drawing_devices().front(); }

class Truth : public testing::TestWithParam<Row> {};

TEST_P(Truth, no_pixel_is_wrong_outside_the_band) {
    TestDevice* device = must(shared_device(drawing_device()));
    const Setting setting = GetParam().make();
    const Picture picture = must(
        take_picture(device->device, setting, {.cull_back_faces = GetParam().cull_back_faces}));
    const truth::Judgement judgement = judge_lights(trace_lights(setting), picture.masks);
    const double judged = static_cast<double>(judgement.judged());
    std::printf(
        "%-40s judged %8.0f, shadowed %5.1f %%, band %5.2f %%, false shadow %llu, false light "
        "%llu; at all %llu, edges within %.2f px\n",
        GetParam().name.c_str(), judged, 100.0 * static_cast<double>(judgement.shadowed) / judged,
        100.0 * static_cast<double>(judgement.band) /
            (judged + static_cast<double>(judgement.band)),
        static_cast<unsigned long long>(judgement.false_shadow),
        static_cast<unsigned long long>(judgement.false_light),
        static_cast<unsigned long long>(judgement.wrong_at_all()), judgement.edge_displacement_px);
    EXPECT_EQ(judgement.false_shadow, 0U) << wrong_places(judgement, row_width);
    EXPECT_EQ(judgement.false_light, 0U) << wrong_places(judgement, row_width);
    // A row that is all light or all shadow proves nothing, and neither does one that is all band.
    EXPECT_GE(static_cast<double>(judgement.lit), 0.05 * judged);
    EXPECT_GE(static_cast<double>(judgement.shadowed), 0.05 * judged);
    EXPECT_LE(static_cast<double>(judgement.band), 0.10 * judged);
}

// Faces that are all but edge-on may come out either way there. Only the band may show it.
TEST_P(Truth, no_pixel_is_wrong_where_the_vertex_shader_decides) {
    TestDevice* device = must(shared_device(drawing_device()));
    const Setting setting = GetParam().make();
    const Picture picture = must(take_picture(device->device, setting,
                                              {.layer_bound = shadows::LayerBound::Promised,
                                               .silhouette = "gpu_quads_float",
                                               .cull_back_faces = GetParam().cull_back_faces}));
    if (picture.list.stats.quad_pairs == 0) GTEST_SKIP() << "no caster is closed";
    const truth::Judgement judgement = judge_lights(trace_lights(setting), picture.masks);
    EXPECT_EQ(judgement.wrong(), 0U) << wrong_places(judgement, row_width);
}

INSTANTIATE_TEST_SUITE_P(Rows, Truth, testing::ValuesIn(rows()),
                         [](const auto& param) { return param.param.name; });

TEST(Truth, no_sample_is_wrong_outside_the_band) {
    TestDevice* device = must(shared_device(drawing_device()));
    const Setting setting = rows()[0].make();
    const Picture picture = must(take_picture(device->device, setting, {.samples = 4}));
    const truth::Options options{.width = row_width, .height = row_height};
    const truth::Judgement judgement =
        judge_lights(trace_lights(setting, options, 4), picture.masks);
    EXPECT_GT(judgement.shadowed, 0U);
    EXPECT_EQ(judgement.wrong(), 0U) << wrong_places(judgement, row_width);
}

// Deliberate mistakes, each of which has been made by somebody. The row must be one that depth-fail
// draws.
class Mutation : public testing::Test {
protected:
    static truth::Judgement judge_with(const PictureOptions& options) {
        TestDevice* device = must(shared_device(drawing_device()));
        const Row& row = *std::find_if(rows().begin(), rows().end(), [](const Row& r) {
            return r.name == "eye_inside_a_volume";
        });
        const Setting setting = row.make();
        PictureOptions all_depth_fail = options;
        all_depth_fail.technique = shadows::Technique::DepthFail;
        all_depth_fail.caps = shadows::CapOptions::plain();  // so that they can be spoilt
        return judge_lights(trace_lights(setting),
                            must(take_picture(device->device, setting, all_depth_fail)).masks);
    }

    // Replaces every volume by a changed copy.
    static PictureOptions changing(void (*change)(const shadows::VolumeDraw&, shadows::Volume&)) {
        return {.mutate = [change](shadows::DrawList& list) {
            std::uint64_t revision = std::uint64_t{1} << 40U;
            for (shadows::VolumeDraw& draw : list.draws) {
                auto volume = std::make_shared<shadows::Volume>(*draw.volume);
                change(draw, *volume);
                draw.volume = volume;
                draw.revision = revision++;
            }
        }};
    }
};

TEST_F(Mutation, none_is_right) { EXPECT_EQ(judge_with({}).wrong(), 0U); }

TEST_F(Mutation, an_unchanged_copy_is_right) {
    EXPECT_EQ(judge_with(changing([](const shadows::VolumeDraw&, shadows::Volume&) {})).wrong(),
              0U);
}

// The depth of a triangle depends, in its last bit, on the corner from which llvmpipe begins. Where
// it does not (NVIDIA's cards), there is nothing to find.
TEST_F(Mutation, rotated_near_caps_are_found) {
    const std::string rasteriser = rasteriser_of(must(shared_device(drawing_device()))->device);
    if (rasteriser != "llvmpipe") GTEST_SKIP() << "not of " << rasteriser;
    const auto rotate = [](const shadows::VolumeDraw&, shadows::Volume& volume) {
        for (const shadows::CapList& list : volume.near_caps()) {
            const shadows::IndexRange& cap = list.triples;
            for (std::uint32_t i = cap.first; i < cap.first + cap.count; i += 3) {
                std::rotate(&volume.indices[i], &volume.indices[i + 1], &volume.indices[i] + 3);
            }
        }
    };
    EXPECT_GT(judge_with(changing(rotate)).wrong(), 0U);
}

TEST_F(Mutation, a_facing_bit_that_only_the_sides_see_is_found) {
    const auto flip = [](const shadows::VolumeDraw& draw, shadows::Volume& volume) {
        // The sides of a silhouette in which one casting face was forgotten; caps as they were.
        std::vector<std::int8_t> weights(draw.mesh->faces().size(), 0);
        std::size_t f = 0;
        shadows::for_each_cap_face(*draw.mesh, volume, volume.near_cap, [&](const auto& face) {
            while (draw.mesh->faces()[f] != face) ++f;
            weights[f] = 1;
        });
        std::vector<std::int8_t> forgetful = weights;
        *std::find(forgetful.begin(), forgetful.end(), 1) = 0;
        std::vector<shadows::SilhouetteEdge> silhouette;
        shadows::find_silhouette(*draw.mesh, forgetful, silhouette);
        shadows::build_volume(*draw.mesh, weights, silhouette, false,
                              shadows::FarVertices::AtInfinity, volume);
    };
    EXPECT_GT(judge_with(changing(flip)).wrong(), 0U);
}

TEST_F(Mutation, greater_equal_for_greater_is_found) {
    EXPECT_GT(judge_with({.volume_depth_compare = gpu::Compare::GreaterEqual}).wrong(), 0U);
}

}  // namespace
}  // namespace gnomon::test
