// SPDX-License-Identifier: MIT
//
// What a browser drew (masks.cpp), held against backends/vk on the same rasteriser and against the
// truth. The file is named by GNOMON_WEB_MASKS; `make web-test` makes it.
//
// The two are not equal to the last byte, for two reasons. Chromium draws on Vulkan with viewports
// of negative height, and backends/vk negates y in its vertex stages instead
// (docs/architecture.md): triangles that are clipped above and below meet the planes in the other
// order, and their new vertices differ in last bits. With backends/vk changed to draw as Chromium
// does, depth was equal to the last bit in all rows. And what remains in masks then, 20 bytes of
// all, is no matter of how they are drawn; the suspicion is the order of a mesh's faces, which the
// C++ libraries' std::nth_element leave differently, and with it the diagonals of side quads. The
// limits below are what was seen, and are not to grow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/rows/picture.hpp"
#include "tests/support/devices.hpp"
#include "tests/truth/traced.hpp"
#include "tests/web/row_masks.hpp"

namespace gnomon::test {
namespace {

/// SwiftShader's, as tests/hard_cases has it.
constexpr double band_px = 1.0 / 8.0;
/// Of the 76,800 bytes of a mask.
constexpr std::size_t most_bytes = 4;
constexpr double most_depth = 1e-4;  ///< of a depth, relative to it
/// Samples outside of the band that are wrong in the browser and not by Vulkan, of all lights: at
/// one sample a pixel, and at four, where SwiftShader itself is less exact.
constexpr std::uint64_t most_wrong = 1;
constexpr std::uint64_t most_wrong_of_four = 8;

double largest_difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    double largest = a.size() == b.size() ? 0.0 : 1.0;
    for (std::size_t i = 0; i + 4 <= std::min(a.size(), b.size()); i += 4) {
        float x = 0.0F;
        float y = 0.0F;
        std::memcpy(&x, &a[i], 4);
        std::memcpy(&y, &b[i], 4);
        if (x == y) continue;
        const double scale = std::max(std::abs(double{x}), std::abs(double{y}));
        largest = std::max(largest, std::abs(double{x} - double{y}) / scale);
    }
    return largest;
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
        const auto device = shared_device(drawing_devices().front());
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

TEST_P(WebMasks, are_those_of_vulkan_but_for_single_bytes) {
    for (const RowMasks* web : of_row_) {
        const RowMasks native = by_vulkan(*web);
        EXPECT_LE(largest_difference(web->depth, native.depth), most_depth);
        ASSERT_EQ(web->masks.size(), native.masks.size());
        for (std::size_t light = 0; light < native.masks.size(); ++light) {
            ASSERT_EQ(web->masks[light].size(), web->samples);
            for (std::size_t sample = 0; sample < web->samples; ++sample) {
                const auto& actual = web->masks[light][sample];
                const auto& expected = native.masks[light][sample];
                ASSERT_EQ(actual.size(), std::size_t{row_width} * row_height);
                const std::size_t wrong = differing_bytes(actual, expected);
                if (wrong > 0) {
                    std::printf("%s, light %zu, sample %zu of %u: %zu bytes differ\n",
                                GetParam().name.c_str(), light, sample, web->samples, wrong);
                }
                EXPECT_LE(wrong, most_bytes) << "light " << light << ", sample " << sample << " of "
                                             << web->samples << "; see "
                                             << save_difference("web." + GetParam().name, row_width,
                                                                row_height, actual, expected);
            }
        }
    }
}

TEST_P(WebMasks, are_as_right_as_those_of_vulkan) {
    for (const RowMasks* web : of_row_) {
        const Traced traced = trace_lights(
            setting_as_drawn(GetParam(), *web),
            {.width = row_width, .height = row_height, .band_px = band_px}, web->samples);
        const truth::Judgement judgement = judge_lights(traced, web->masks);
        const truth::Judgement native = judge_lights(traced, by_vulkan(*web).masks);
        std::printf("%s at %u: of %llu judged wrong in the browser %llu, by Vulkan %llu\n",
                    GetParam().name.c_str(), web->samples,
                    static_cast<unsigned long long>(judgement.judged()),
                    static_cast<unsigned long long>(judgement.wrong()),
                    static_cast<unsigned long long>(native.wrong()));
        EXPECT_GT(judgement.shadowed, 0U);
        EXPECT_GT(judgement.lit, 0U);
        EXPECT_LE(judgement.wrong(),
                  native.wrong() + (web->samples == 1 ? most_wrong : most_wrong_of_four))
            << wrong_places(judgement, row_width);
    }
}

INSTANTIATE_TEST_SUITE_P(Rows, WebMasks, testing::ValuesIn(rows()),
                         [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace gnomon::test
