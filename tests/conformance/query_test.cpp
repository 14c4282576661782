// SPDX-License-Identifier: MIT
//
// Queries: exact occlusion counts, timestamps that run forwards.
#include "tests/conformance/painting.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::conformance {
namespace {

using test::drawing_devices;
using test::must;

class Query : public test::DeviceTest {};

TEST_P(Query, OcclusionCountsSamplesThatPass) {
    if (!features().occlusion_query) GTEST_SKIP() << "no occlusion_query";
    const auto queries = must(device().create_query_set(
        {.label = "occlusion", .type = gpu::QueryType::Occlusion, .count = 5}));
    const gpu::DepthStencilState greater{.depth_compare = gpu::Compare::Greater};
    Painting painting(device(), {.clear_depth = 0.5F});
    painting.paint(
        {{.vertices = triangles_of({.z = 0.75F}), .depth_stencil = greater, .occlusion_query = 0},
         {.vertices = triangles_of({.z = 0.75F})},  // counted by nobody
         {.vertices = triangles_of({.right = 0, .z = 0.75F}),
          .depth_stencil = greater,
          .occlusion_query = 1},
         {.vertices = triangles_of({.z = 0.25F}), .depth_stencil = greater, .occlusion_query = 2},
         {.depth_stencil = {.depth_compare = gpu::Compare::Always,
                            .stencil_front = {.compare = gpu::Compare::Never},
                            .stencil_back = {.compare = gpu::Compare::Never}},
          .occlusion_query = 3}},
        queries);
    EXPECT_EQ(must(device().read_query_set(queries)), (std::vector<std::uint64_t>{16, 8, 0, 0, 0}));
}

TEST_P(Query, OcclusionCountsBothFacesOfAVolumeOnce) {
    if (!features().occlusion_query) GTEST_SKIP() << "no occlusion_query";
    const auto queries = must(device().create_query_set(
        {.label = "occlusion", .type = gpu::QueryType::Occlusion, .count = 1}));
    std::vector<Vertex> volume = triangles_of({.z = 0.75F});
    for (const auto& vertex : triangles_of({.right = 0, .z = 0.6F, .counter_clockwise = false})) {
        volume.push_back(vertex);
    }
    Painting painting(device(), {.clear_depth = 0.5F});
    painting.paint({{.vertices = volume,
                     .depth_stencil = {.depth_compare = gpu::Compare::Greater,
                                       .stencil_front = {.pass_op = gpu::StencilOp::IncrementWrap},
                                       .stencil_back = {.pass_op = gpu::StencilOp::DecrementWrap}},
                     .write_mask = gpu::ColorWrite::None,
                     .occlusion_query = 0}},
                   queries);
    EXPECT_EQ(must(device().read_query_set(queries)), (std::vector<std::uint64_t>{24}));
}

TEST_P(Query, OcclusionCountsEverySample) {
    if (!features().occlusion_query || !features().multisample_4) {
        GTEST_SKIP() << "no occlusion_query or no multisample_4";
    }
    const auto queries = must(device().create_query_set(
        {.label = "occlusion", .type = gpu::QueryType::Occlusion, .count = 1}));
    Painting painting(device(), {.sample_count = 4});
    painting.paint({{.occlusion_query = 0}}, queries);
    EXPECT_EQ(must(device().read_query_set(queries)), (std::vector<std::uint64_t>{64}));
}

TEST_P(Query, AQuerySetIsUsedAgain) {
    if (!features().occlusion_query) GTEST_SKIP() << "no occlusion_query";
    const auto queries = must(device().create_query_set(
        {.label = "occlusion", .type = gpu::QueryType::Occlusion, .count = 1}));
    Painting painting(device(), {});
    painting.paint({{.occlusion_query = 0}}, queries);
    painting.paint({{.vertices = triangles_of({.right = 0}), .occlusion_query = 0}}, queries);
    EXPECT_EQ(must(device().read_query_set(queries)), (std::vector<std::uint64_t>{8}));
}

TEST_P(Query, TimestampsRunForwards) {
    if (!features().timestamp_query) GTEST_SKIP() << "no timestamp_query";
    const auto queries = must(device().create_query_set(
        {.label = "time", .type = gpu::QueryType::Timestamp, .count = 4}));
    const auto target =
        must(device().create_texture({.label = "timed",
                                      .width = 64,
                                      .height = 64,
                                      .format = gpu::Format::Rgba8Unorm,
                                      .usage = gpu::TextureUsage::RenderAttachment}));
    for (std::uint32_t pass = 0; pass < 2; ++pass) {
        gpu::CommandEncoder encoder = device().create_command_encoder("timed");
        encoder
            .begin_render_pass(
                {.label = "timed",
                 .color_attachments = {{.texture = target, .load_op = gpu::LoadOp::Clear}},
                 .timestamp_writes = gpu::TimestampWrites{.query_set = queries,
                                                          .beginning_index = pass * 2,
                                                          .end_index = pass * 2 + 1}})
            .end();
        must(device().submit(must(encoder.finish())));
    }
    const auto times = must(device().read_query_set(queries));
    ASSERT_EQ(times.size(), 4U);
    EXPECT_GT(times[0], 0U);
    EXPECT_LE(times[0], times[1]);
    EXPECT_LE(times[1], times[2]);
    EXPECT_LE(times[2], times[3]);
    EXPECT_LT(times[3] - times[0], 60'000'000'000U) << "the unit is not the nanosecond";
}

INSTANTIATE_TEST_SUITE_P(Devices, Query, testing::ValuesIn(drawing_devices()),
                         test::device_case_name);

}  // namespace
}  // namespace gnomon::conformance
