// SPDX-License-Identifier: MIT
//
// The fill meter: the same numbers on every device and stencil path, whoever makes the volumes, and
// what two ways of counting give: occlusion queries for the whole frame, the stencil for each
// sample.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/scene/shadow_adapter.hpp>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

struct Filled {
    std::vector<std::uint64_t> rasterised;  // by light
    std::vector<std::uint64_t> counted;
    std::uint64_t in_stencil = 0;  // of all lights and samples
    bool saturated = false;
};

Filled fill_of(gpu::Device& device, const Setting& setting, std::uint32_t samples,
               std::string_view silhouette, std::optional<shadows::Technique> technique) {
    auto renderer = must(render::Renderer::create(device, {.width = row_width,
                                                           .height = row_height,
                                                           .sample_count = samples,
                                                           .overlays = {.fill = true},
                                                           .meter_fill = true}));
    must(renderer.upload(setting.scene));
    auto system = must(
        shadows::ShadowSystem::create({.force_technique = technique, .silhouette = silhouette}));
    scene::ShadowAdapter adapter;
    auto frame = system.begin_frame();
    must(adapter.submit(setting.scene, frame));
    const shadows::DrawList list = std::move(frame).finish(setting.view);
    must(renderer.render({setting.scene, setting.view, list, {}}));
    Filled filled;
    const auto stencil = [&] {
        std::vector<std::byte> values;
        for (std::uint32_t sample = 0; sample < samples; ++sample) {
            const auto of_sample = must(render::read_stencil(device, renderer, sample));
            values.insert(values.end(), of_sample.begin(), of_sample.end());
        }
        return values;
    };
    const auto before = stencil();
    for (const shadow_pass::LightFill& light : must(renderer.measure_fill())) {
        filled.rasterised.push_back(light.rasterised);
        filled.counted.push_back(light.counted);
    }
    EXPECT_EQ(stencil(), before) << "counting leaves everything as it is";
    for (const std::byte value : before) {
        filled.in_stencil += std::to_integer<std::uint64_t>(value);
        filled.saturated = filled.saturated || value == std::byte{255};
    }
    return filled;
}

class Fill : public testing::TestWithParam<Row> {};

TEST_P(Fill, is_the_same_on_every_device) {
    const Setting setting = GetParam().make();
    bool any = false;
    for (const std::uint32_t samples : {1U, 4U}) {
        for (const auto technique :
             {std::optional<shadows::Technique>(), std::optional(shadows::Technique::DepthFail)}) {
            // Depths of two surfaces in one place need not compare alike on two drivers.
            std::map<std::string, Filled> firsts;  // by rasteriser
            for (const DeviceCase& device_case : drawing_devices()) {
                auto device = shared_device(device_case);
                if (!device || !(*device)->device.caps().features.occlusion_query) {
                    EXPECT_FALSE(is_required(device_case.name)) << device_case.name;
                    continue;
                }
                SCOPED_TRACE(device_case.name + ", samples " + std::to_string(samples) +
                             (technique ? ", zfail" : ""));
                any = true;
                const Filled filled =
                    fill_of((*device)->device, setting, samples, "brute_force", technique);
                const std::uint64_t sum = std::accumulate(
                    filled.rasterised.begin(), filled.rasterised.end(), std::uint64_t{0});
                EXPECT_GT(sum, 0U);
                EXPECT_FALSE(filled.saturated);
                EXPECT_EQ(filled.in_stencil, sum);
                for (std::size_t i = 0; i < filled.counted.size(); ++i) {
                    EXPECT_LE(filled.counted[i], filled.rasterised[i]) << "light " << i;
                }
                const Filled& first =
                    firsts.try_emplace(rasteriser_of((*device)->device), filled).first->second;
                EXPECT_EQ(filled.rasterised, first.rasterised);
                EXPECT_EQ(filled.counted, first.counted);
                if (samples != 1 || technique) continue;
                const Filled by_quads =
                    fill_of((*device)->device, setting, samples, "gpu_quads", technique);
                EXPECT_EQ(by_quads.rasterised, first.rasterised) << "quads on every edge";
                EXPECT_EQ(by_quads.counted, first.counted) << "quads on every edge";
            }
        }
    }
    if (!any) GTEST_SKIP() << "no device that draws and counts";
}

std::vector<Row> rows_to_fill() {
    constexpr std::array<std::string_view, 4> names{
        "still_life_three_lights", "eye_inside_a_volume", "mirrored_and_sheared", "open_meshes"};
    std::vector<Row> some;
    for (const Row& row : rows()) {
        if (std::ranges::find(names, row.name) != names.end()) some.push_back(row);
    }
    EXPECT_EQ(some.size(), names.size());
    return some;
}

INSTANTIATE_TEST_SUITE_P(Rows, Fill, testing::ValuesIn(rows_to_fill()),
                         [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace gnomon::test
