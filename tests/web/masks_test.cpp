// SPDX-License-Identifier: MIT
//
// What a browser drew (masks.cpp), held against backends/vk on the same rasteriser and against the
// truth. The file is named by GNOMON_WEB_MASKS; `make web-test` makes it.
//
// Masks and depth are equal to the last bit. For that, backends/vk draws as Chromium does:
// viewports of negative height turn y up (vk::YUp::Viewport), and there are no depth bounds, which
// WebGPU does not have and which may change pixels within the band along a shadow's edge.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

#include <gnomon/vk/backend.hpp>

#include "tests/rows/picture.hpp"
#include "tests/support/devices.hpp"
#include "tests/truth/traced.hpp"
#include "tests/web/row_masks.hpp"

namespace gnomon::test {
namespace {

/// SwiftShader's, as tests/hard_cases has it.
constexpr double band_px = 1.0 / 8.0;
/// Pixels outside of the band that SwiftShader draws wrong at one sample, in the browser as by
/// Vulkan. It snaps vertices to a sixteenth of a pixel; a band twice as wide leaves the first and
/// the last.
const std::map<std::string_view, std::uint64_t> known_wrong = {{"pillars_two_lights", 1},
                                                               {"still_life_three_lights", 1},
                                                               {"off_axis", 3},
                                                               {"gaps_under_a_sun_and_a_lamp", 1}};
/// At four samples it is less exact, by whichever way it is told to draw: of those judged.
constexpr double most_wrong_of_four = 0.0025;

/// Chromium draws on Vulkan with viewports of negative height.
DeviceCase as_browsers_draw() {
    return {.name = "vk", .draws = true, .create_backend = [](gpu::MessageSink sink) {
                return vk::create_backend({.adapter = "SwiftShader",
                                           .validation = true,
                                           .disabled_features = {"depthBounds"},
                                           .message_sink = std::move(sink),
                                           .y_up = vk::YUp::Viewport});
            }};
}

class WebMasks : public testing::TestWithParam<Row> {
protected:
    void SetUp() override {
        const char* path = std::getenv("GNOMON_WEB_MASKS");
        if (path == nullptr) {
            GTEST_SKIP() << "GNOMON_WEB_MASKS names no file: make web-test draws one in a browser";
        }
        static const std::vector<RowMasks> all = must(read_masks(path));
        for (const RowMasks& masks : all) {
            if (masks.row == GetParam().name) of_row_.push_back(&masks);
        }
        ASSERT_EQ(of_row_.size(), 2U) << "the browser drew it at one sample and at four";
        const auto device = shared_device(as_browsers_draw());
        if (!device) GTEST_SKIP() << "SwiftShader: " << device.error().message;
        device_ = &(*device)->device;
        if (rasteriser_of(*device_) != "SwiftShader") {
            GTEST_SKIP() << "Vulkan is drawn by " << rasteriser_of(*device_)
                         << " here, and the browser's pictures by SwiftShader";
        }
    }

    [[nodiscard]] RowMasks by_vulkan(const RowMasks& web) const {
        return must(
            draw_setting(*device_, GetParam(), setting_as_drawn(GetParam(), web), web.samples));
    }

    std::vector<const RowMasks*> of_row_;
    gpu::Device* device_ = nullptr;
};

TEST_P(WebMasks, are_those_of_vulkan_to_the_last_bit) {
    for (const RowMasks* web : of_row_) {
        const RowMasks native = by_vulkan(*web);
        EXPECT_EQ(differing_bytes(web->depth, native.depth), 0U) << "depth";
        ASSERT_EQ(web->masks.size(), native.masks.size());
        for (std::size_t light = 0; light < native.masks.size(); ++light) {
            ASSERT_EQ(web->masks[light].size(), web->samples);
            for (std::size_t sample = 0; sample < web->samples; ++sample) {
                const auto& actual = web->masks[light][sample];
                const auto& expected = native.masks[light][sample];
                ASSERT_EQ(actual.size(), std::size_t{row_width} * row_height);
                EXPECT_EQ(differing_bytes(actual, expected), 0U)
                    << "light " << light << ", sample " << sample << " of " << web->samples
                    << "; see "
                    << save_difference("web." + GetParam().name, row_width, row_height, actual,
                                       expected);
            }
        }
    }
}

TEST_P(WebMasks, are_right) {
    for (const RowMasks* web : of_row_) {
        const Traced traced = trace_lights(
            setting_as_drawn(GetParam(), *web),
            {.width = row_width, .height = row_height, .band_px = band_px}, web->samples);
        const truth::Judgement judgement = judge_lights(traced, web->masks);
        std::printf("%s at %u: of %llu judged %llu are wrong\n", GetParam().name.c_str(),
                    web->samples, static_cast<unsigned long long>(judgement.judged()),
                    static_cast<unsigned long long>(judgement.wrong()));
        EXPECT_GT(judgement.shadowed, 0U);
        EXPECT_GT(judgement.lit, 0U);
        if (web->samples == 1) {
            const auto known = known_wrong.find(GetParam().name);
            EXPECT_EQ(judgement.wrong(), known == known_wrong.end() ? 0U : known->second)
                << wrong_places(judgement, row_width);
        } else {
            EXPECT_LE(static_cast<double>(judgement.wrong()),
                      most_wrong_of_four * static_cast<double>(judgement.judged()))
                << wrong_places(judgement, row_width);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Rows, WebMasks, testing::ValuesIn(rows()),
                         [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace gnomon::test
