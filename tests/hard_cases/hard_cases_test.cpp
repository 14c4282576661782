// SPDX-License-Identifier: MIT
//
// Runs the hard cases: each on every device, all masks equal, each mask held against traced
// shadows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

#include <fmt/format.h>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/hard_cases/known_limits.hpp"
#include "tests/support/devices.hpp"
#include "tests/truth/traced.hpp"

namespace gnomon::test {
namespace {

// SwiftShader puts vertices on a grid of 1/16 pixel (Mesa: 1/256), so that an edge moves by up to
// sqrt(2)/32 pixel; the receiver's edge and the volume's may do so in opposite ways: 0.088 pixel.
constexpr double band_px_on_swiftshader = 1.0 / 8.0;

bool has(const TestDevice& device, gpu::Format depth_stencil) {
    const gpu::Features& features = device.device.caps().features;
    return depth_stencil == gpu::Format::Depth24UnormStencil8 ? features.depth24unorm_stencil8
                                                              : features.depth32float_stencil8;
}

class HardCases : public testing::TestWithParam<HardCase> {};

// A device, and what it made of the case.
struct Outcome {
    TestDevice* device = nullptr;
    std::string name;
    const KnownLimit* limit = nullptr;
    truth::Judgement judgement = {};
    std::uint64_t differing = 0;  // bytes, from the first device's
};

std::vector<Outcome> devices_for(const HardCase& hard_case) {
    std::vector<Outcome> outcomes;
    for (const DeviceCase& device_case : drawing_devices()) {
        auto device = shared_device(device_case);
        if (!device) {
            EXPECT_FALSE(is_required(device_case.name)) << device.error().message;
            continue;
        }
        if (!has(**device, hard_case.options.depth_stencil_format)) continue;
        outcomes.push_back(
            {*device, device_case.name,
             known_limit(hard_case.name, device_case.name, rasteriser_of((*device)->device))});
    }
    return outcomes;
}

// Adds one frame to what the device made of the case.
void judge(Outcome& outcome, const HardCase& hard_case, const Picture& picture,
           const Picture& reference, const Traced& traced) {
    ASSERT_EQ(picture.masks.size(), traced.size());
    for (std::size_t light = 0; light < traced.size(); ++light) {
        for (std::size_t sample = 0; sample < traced[light].size(); ++sample) {
            const auto& mask = picture.masks[light][sample];
            const auto& expected = reference.masks[light][sample];
            outcome.judgement += truth::judge(traced[light][sample], mask);
            const std::size_t differ = differing_bytes(mask, expected);
            outcome.differing += differ;
            if (differ == 0 || outcome.limit != nullptr) continue;
            ADD_FAILURE() << outcome.name << ": " << differ << " bytes of light " << light
                          << " differ from the first device's; see "
                          << save_difference(
                                 fmt::format("hard.{}.{}", hard_case.name, outcome.name),
                                 hard_case.options.width, hard_case.options.height, mask, expected);
        }
    }
    if (outcome.limit == nullptr) {
        EXPECT_EQ(outcome.judgement.wrong(), 0U)
            << outcome.name << ": " << outcome.judgement.false_shadow << " falsely dark, "
            << outcome.judgement.false_light
            << " falsely lit:" << wrong_places(outcome.judgement, hard_case.options.width);
    }
}

TEST_P(HardCases, no_pixel_is_wrong_outside_the_band) {
    const HardCase& hard_case = GetParam();
    const PictureOptions& options = hard_case.options;
    std::vector<Outcome> outcomes = devices_for(hard_case);
    if (outcomes.empty()) GTEST_SKIP() << "no device of this kind, or none with this format";
    const bool swiftshader = on_swiftshader(*outcomes[0].device);  // it is never among others

    for (int frame = 0; frame < hard_case.frames && !HasFailure(); ++frame) {
        SCOPED_TRACE(fmt::format("frame {}", frame));
        const Setting setting = hard_case.make(frame);
        const Picture reference = must(take_picture(outcomes[0].device->device, setting, options));
        const Traced traced = trace_lights(
            setting,
            {.width = options.width,
             .height = options.height,
             .band_px = swiftshader ? band_px_on_swiftshader : truth::Options{}.band_px},
            options.samples);
        judge(outcomes[0], hard_case, reference, reference, traced);
        for (std::size_t d = 1; d < outcomes.size(); ++d) {
            judge(outcomes[d], hard_case,
                  must(take_picture(outcomes[d].device->device, setting, options)), reference,
                  traced);
        }
    }

    for (const Outcome& outcome : outcomes) {
        if (outcome.limit == nullptr) continue;
        const std::uint64_t off = std::max(outcome.judgement.wrong(), outcome.differing);
        EXPECT_GT(off, 0U) << outcome.name << " is right here: it is no limit any more. "
                           << outcome.limit->because;
        EXPECT_LE(off, outcome.limit->most_pixels)
            << outcome.name << ": " << outcome.limit->because;
    }
    const truth::Judgement& total = outcomes[0].judgement;
    const auto judged = static_cast<double>(total.judged());
    const double band =
        static_cast<double>(total.band) / (judged + static_cast<double>(total.band));
    std::printf("| %s | %zu | %.0f | %.1f | %llu | %.2f |\n", hard_case.name.c_str(),
                outcomes.size(), judged, 100.0 * static_cast<double>(total.shadowed) / judged,
                static_cast<unsigned long long>(total.wrong()), 100.0 * band);
    if (hard_case.one_sided_because.empty()) {
        EXPECT_GE(static_cast<double>(total.lit), 0.05 * judged);
        EXPECT_GE(static_cast<double>(total.shadowed), 0.05 * judged);
    }
    EXPECT_GT(judged, 0.0);
    EXPECT_LE(band, hard_case.most_band);
}

// The table's head, once.
class TableHead : public testing::Environment {
public:
    void SetUp() override {
        std::printf(
            "| case | devices | pixels judged | %% in shadow | wrong outside the band | "
            "%% in the band |\n|---|--:|--:|--:|--:|--:|\n");
    }
};
[[maybe_unused]] const testing::Environment* const table_head =
    testing::AddGlobalTestEnvironment(new TableHead);

INSTANTIATE_TEST_SUITE_P(Rows, HardCases, testing::ValuesIn(hard_cases()),
                         [](const auto& param) { return param.param.name; });

}  // namespace

}  // namespace gnomon::test
