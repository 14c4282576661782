// SPDX-License-Identifier: MIT
//
// What the fill meter counts, held against a rasteriser of three lines: for every pixel centre and
// triangle, whether the centre lies in it and at which depth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/shadow_adapter.hpp>

#include "internal/volume_draws.hpp"
#include "tests/rows/rows.hpp"
#include "tests/rows/stage.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

using shadows::Technique;

struct ClipTriangle {
    std::array<glm::dvec4, 3> corners;
    bool near_cap = false;
};

std::vector<ClipTriangle> clip_triangles(const shadows::VolumeDraw& draw,
                                         const shadows::View& view) {
    std::vector<glm::vec4> far_vertices;
    shadows::extrude(draw.mesh->positions(), draw.extrusion, far_vertices);
    const auto vertex = [&](std::uint32_t index) {
        if (index % 2 == 1) {
            return view.clip_from_world() * draw.world_from_far *
                   glm::dvec4(far_vertices[index / 2]);
        }
        return view.clip_from_world() * draw.world_from_local *
               glm::dvec4(glm::dvec3(draw.mesh->positions()[index / 2]), 1.0);
    };
    std::vector<ClipTriangle> triangles;
    std::vector<shadow_pass::internal::Run> runs;
    const auto ends = shadow_pass::internal::ends_of(draw, nullptr, {});
    shadow_pass::internal::append_runs(*draw.volume, ends, runs);
    for (const shadow_pass::internal::Run& run : runs) {
        for (std::uint32_t i = run.first; i < run.first + run.count; i += 3) {
            std::array<std::uint32_t, 3> corners{};
            for (std::uint32_t k = 0; k < 3; ++k) {
                corners[k] =
                    run.of_mesh ? 2 * draw.mesh->faces()[i / 3][k] : draw.volume->indices[i + k];
                corners[k] += static_cast<std::uint32_t>(run.base_vertex);
            }
            const bool near_cap = std::ranges::none_of(corners, [](auto c) { return c % 2 == 1; });
            triangles.push_back(
                {{vertex(corners[0]), vertex(corners[1]), vertex(corners[2])}, near_cap});
        }
    }
    return triangles;
}

// Olano and Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates" (1997): the weights
// with which the corners give (x, y, 1); none negative where the pixel is covered. Reversed depth.
std::optional<double> depth_at(const std::array<glm::dvec4, 3>& t, const glm::dvec2& ndc) {
    const glm::dmat3 corners(glm::dvec3(t[0].x, t[0].y, t[0].w), glm::dvec3(t[1].x, t[1].y, t[1].w),
                             glm::dvec3(t[2].x, t[2].y, t[2].w));
    if (glm::determinant(corners) == 0.0) return std::nullopt;
    const glm::dvec3 weights = glm::inverse(corners) * glm::dvec3(ndc, 1.0);
    if (weights.x < 0.0 || weights.y < 0.0 || weights.z < 0.0) return std::nullopt;
    const double depth = glm::dot(weights, glm::dvec3(t[0].z, t[1].z, t[2].z));
    if (depth < 0.0 || depth > 1.0) return std::nullopt;
    return depth;
}

class FillMeter : public DeviceTest {
protected:
    void expect_as_on_paper(Technique technique) {
        if (!features().occlusion_query) GTEST_SKIP() << "no occlusion_query";
        Stage stage;
        stage.ground();
        stage.place(shared(scene::make_box(glm::vec3(1.5F))), moved({0.3, 1.9, 0.0}));
        stage.sun({0.5, -1.0, -0.35});
        stage.look({4.0, 5.0, 7.0}, {0.0, 0.8, 0.0});
        const Setting setting = stage.finish();

        auto renderer = must(render::Renderer::create(
            device(), {.width = row_width, .height = row_height, .meter_fill = true}));
        must(renderer.upload(setting.scene));
        auto system = must(shadows::ShadowSystem::create(
            {.force_technique = technique, .fill = {.depth_bounds = false}}));
        scene::ShadowAdapter adapter;
        auto frame = system.begin_frame();
        must(adapter.submit(setting.scene, frame));
        const shadows::DrawList list = std::move(frame).finish(setting.view);
        must(renderer.render({setting.scene, setting.view, list, {}}));
        const auto bytes =
            must(device().read_texture(renderer.depth_stencil(), gpu::Aspect::DepthOnly));
        std::vector<float> scene_depth(bytes.size() / sizeof(float));
        std::memcpy(scene_depth.data(), bytes.data(), bytes.size());

        double rasterised = 0.0;
        double counted = 0.0;
        for (const shadows::VolumeDraw& draw : list.draws) {
            for (const auto& [triangle, near_cap] : clip_triangles(draw, setting.view)) {
                for (std::uint32_t y = 0; y < row_height; ++y) {
                    for (std::uint32_t x = 0; x < row_width; ++x) {
                        const auto depth = depth_at(triangle, {2.0 * (x + 0.5) / row_width - 1.0,
                                                               1.0 - 2.0 * (y + 0.5) / row_height});
                        if (!depth) continue;
                        rasterised += 1.0;
                        // A near cap lies in the scene's surface, and that is not before it,
                        // however the device rounds depth.
                        const bool before = !near_cap && *depth > scene_depth[y * row_width + x];
                        counted += before == (technique == Technique::DepthPass) ? 1.0 : 0.0;
                    }
                }
            }
        }
        ASSERT_GT(rasterised, 10000.0);
        ASSERT_GT(counted, 1000.0);
        const auto fill = must(renderer.measure_fill());
        ASSERT_EQ(fill.size(), 1U);
        // A rasteriser snaps corners to a grid of 1/256 pixel.
        EXPECT_NEAR(static_cast<double>(fill[0].rasterised), rasterised, 0.002 * rasterised);
        EXPECT_NEAR(static_cast<double>(fill[0].counted), counted, 0.002 * counted);
    }
};

TEST_P(FillMeter, counts_what_depth_pass_rasterises) { expect_as_on_paper(Technique::DepthPass); }
TEST_P(FillMeter, counts_what_depth_fail_rasterises) { expect_as_on_paper(Technique::DepthFail); }

INSTANTIATE_TEST_SUITE_P(Devices, FillMeter, testing::ValuesIn(drawing_devices()),
                         device_case_name);

}  // namespace
}  // namespace gnomon::test
