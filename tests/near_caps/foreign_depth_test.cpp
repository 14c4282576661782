// SPDX-License-Identifier: MIT
//
// Shadow volumes in a depth buffer that came from other shaders: caps on lit faces leave acne, caps
// on averted faces do not, and a bias is there for casters that have no averted faces to offer.
// The table that it prints is the one of docs/numerics.md, "Near caps".
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "tests/near_caps/host.hpp"
#include "tests/near_caps/scenes.hpp"
#include "tests/support/devices.hpp"
#include "tests/truth/traced.hpp"

namespace gnomon::test {
namespace {

using shadow_pass::AvertedFaces;
using shadow_pass::CapBias;
using shadow_pass::usual_cap_bias;
using shadows::NearCaps;
using shadows::Technique;

// No volume of the list has a cap on a face that light may reach.
bool all_caps_are_averted(const shadows::DrawList& list) {
    return std::all_of(list.draws.begin(), list.draws.end(), [](const shadows::VolumeDraw& draw) {
        return draw.volume->near_cap.faces == 0 && draw.volume->near_cap_flipped.faces == 0;
    });
}

gpu::Device& drawing_device() { return must(shared_device(drawing_devices().front()))->device; }

class ForeignDepth : public testing::TestWithParam<Row> {
protected:
    struct Outcome {
        std::uint64_t wrong = 0;
        bool all_averted = false;
    };
    // Draws with both kinds of caps, and says so.
    static std::array<Outcome, 2> draw(const Setting& setting, const Traced& truth,
                                       const HostOptions& options, const char* what) {
        std::array<Outcome, 2> outcomes;
        for (const NearCaps caps : {NearCaps::Facing, NearCaps::Averted}) {
            HostOptions with_caps = options;
            with_caps.near_caps = caps;
            const HostPicture picture = host_picture(drawing_device(), setting, with_caps);
            const truth::Judgement judged = judge_lights(truth, picture.masks);
            EXPECT_EQ(judged.false_light, 0U) << what << ": what fights is acne, it never leaks";
            outcomes[static_cast<std::size_t>(caps)] = {judged.wrong(),
                                                        all_caps_are_averted(picture.list)};
        }
        std::printf("%-36s %-16s %-4s wrong: facing %6llu, averted %6llu\n",
                    GetParam().name.c_str(), what, options.technique ? "fail" : "auto",
                    static_cast<unsigned long long>(outcomes[0].wrong),
                    static_cast<unsigned long long>(outcomes[1].wrong));
        return outcomes;
    }
};

TEST_P(ForeignDepth, is_harmless_to_averted_caps_and_to_biased_ones) {
    const Setting all = GetParam().make();
    const Setting solids = only_solids_cast(GetParam().make());
    const auto truth = trace_lights(all);
    const auto truth_of_solids = trace_lights(solids);
    for (const auto technique : {std::optional<Technique>(), std::optional(Technique::DepthFail)}) {
        for (const Outcome& shared : draw(all, truth, {.technique = technique}, "shared")) {
            EXPECT_EQ(shared.wrong, 0U);
        }
        draw(all, truth, {.depth = Depth::Foreign, .technique = technique}, "foreign");
        const auto biased =
            draw(all, truth,
                 {.depth = Depth::Foreign, .cap_bias = usual_cap_bias, .technique = technique},
                 "foreign, biased");
        for (const Outcome& outcome : biased) EXPECT_EQ(outcome.wrong, 0U);

        const auto [facing, averted] =
            draw(solids, truth_of_solids, {.depth = Depth::Foreign, .technique = technique},
                 "foreign, solids");
        if (!averted.all_averted) continue;
        EXPECT_EQ(averted.wrong, 0U);
        // Else the test would prove nothing; by depth-pass there may be no caps to fight with.
        const bool any_caps = !facing.all_averted;
        if (technique && any_caps) {
            EXPECT_GT(facing.wrong, 0U);
        }
    }
}

std::vector<Row> unculled_rows() {
    std::vector<Row> unculled;
    for (const Row& row : rows()) {
        if (!row.cull_back_faces) unculled.push_back(row);  // the host draws both sides
    }
    return unculled;
}

INSTANTIATE_TEST_SUITE_P(Rows, ForeignDepth, testing::ValuesIn(unculled_rows()),
                         [](const auto& param) { return param.param.name; });

TEST(ForeignDepthShading, AvertedFacesAreLeftToShadingInAnyDepthBuffer) {
    const auto& all_rows = rows();
    const auto row = std::find_if(all_rows.begin(), all_rows.end(),
                                  [](const Row& r) { return r.name == "still_life_three_lights"; });
    const Setting setting = only_solids_cast(row->make());
    const auto truth = trace_lights(setting);
    const auto masks = [&](Depth depth, AvertedFaces averted_faces, const CapBias& bias) {
        return host_picture(drawing_device(), setting,
                            {.depth = depth,
                             .near_caps = NearCaps::Averted,
                             .averted_faces = averted_faces,
                             .cap_bias = bias})
            .masks;
    };
    const auto expected = masks(Depth::Shared, AvertedFaces::LeftToShading, {});
    // Pixels off the band that are shadowed in one and not in the other.
    const auto differing = [&](const std::vector<std::vector<std::uint8_t>>& actual) {
        std::size_t count = 0;
        for (std::size_t light = 0; light < truth.size(); ++light) {
            for (std::size_t i = 0; i < truth[light][0].verdicts.size(); ++i) {
                if (truth[light][0].verdicts[i] == truth::Verdict::Band) continue;
                count += (actual[light][i] == 0) != (expected[light][i] == 0) ? 1 : 0;
            }
        }
        return count;
    };
    const auto shadowed = differing(masks(Depth::Shared, AvertedFaces::Shadowed, {}));
    const auto unbiased = differing(masks(Depth::Foreign, AvertedFaces::LeftToShading, {}));
    const auto cured = masks(Depth::Foreign, AvertedFaces::LeftToShading, usual_cap_bias);
    const auto biased = differing(cured);
    std::printf("averted faces left to shading: of %zu pixels, acne on %zu; biased, on %zu\n",
                shadowed, unbiased, biased);
    EXPECT_GT(shadowed, 10'000U);
    EXPECT_GT(unbiased, shadowed / 10);
    // Averted faces have no band: at their edges the two depth buffers see different triangles.
    EXPECT_LE(biased, shadowed / 1'000);
    EXPECT_EQ(judge_lights(truth, cured).wrong(), 0U);
}

// The floor's depth is 0.01 / 5; one smallest step of it is 2^-32, and a millimetre there
// 0.01 / 5 * 0.001 / 5 = 4e-7, 1,718 steps.
TEST(CapBias, ErrsWithinItselfAndNowhereElse) {
    const Setting setting = undrawn_sheet_above_a_floor(0.001);
    const auto truth = trace_lights(setting);
    const auto judged = [&](std::int32_t constant) {
        const HostOptions options{.cap_bias = {constant, 0.0F}, .technique = Technique::DepthFail};
        return judge_lights(truth, host_picture(drawing_device(), setting, options).masks);
    };
    // The bias from which on the sheet casts nothing.
    std::int32_t kept = 1;
    std::int32_t lost = 1 << 22;
    while (lost - kept > kept / 64 + 1) {
        const std::int32_t middle = kept + (lost - kept) / 2;
        (judged(middle).false_light == 0 ? kept : lost) = middle;
    }
    std::printf("a sheet 1 mm above a floor casts its shadow up to a bias of %d steps\n", kept);
    const auto within = judged(kept - kept / 32);
    EXPECT_GT(within.shadowed, 1'000U);
    EXPECT_EQ(within.wrong(), 0U);
    const auto beyond = judged(lost + lost / 16);
    EXPECT_EQ(beyond.false_light, beyond.shadowed);
    EXPECT_EQ(beyond.false_shadow, 0U);
    // What a step is, is the driver's choice.
    if (rasteriser_of(drawing_device()) == "llvmpipe") {
        EXPECT_GE(kept, 1'650);
        EXPECT_LE(lost, 1'800);
    }
}

}  // namespace
}  // namespace gnomon::test
