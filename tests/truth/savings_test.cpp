// SPDX-License-Identifier: MIT
//
// What FillOptions leave out, no pixel can tell. Culls and scissors: the same bytes on every
// surface, slabs among what is drawn; of umbrae: zero stays zero, and all else is not. Clamping,
// slabs and depth bounds: no pixel is wrong outside the band either way; those within it that
// differ are counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <utility>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/support/devices.hpp"
#include "tests/support/share.hpp"
#include "tests/truth/traced.hpp"

namespace gnomon::test {
namespace {

using shadows::FillOptions;

// Pixels that hold a surface.
std::vector<bool> surfaces(const Picture& picture) {
    std::vector<bool> surface(picture.depth.size() / sizeof(float));
    for (std::size_t i = 0; i < surface.size(); ++i) {
        float depth = 0.0F;
        std::memcpy(&depth, picture.depth.data() + i * sizeof depth, sizeof depth);
        surface[i] = depth != 0.0F;
    }
    return surface;
}

struct Difference {
    std::uint64_t bytes = 0;
    std::uint64_t shadow = 0;  // of them: zero in one and not in the other
};

// On surfaces alone.
Difference compare(const Picture& a, const Picture& b) {
    const std::vector<bool> surface = surfaces(a);
    Difference found;
    EXPECT_EQ(a.masks.size(), b.masks.size());
    for (std::size_t light = 0; light < a.masks.size(); ++light) {
        for (std::size_t i = 0; i < surface.size(); ++i) {
            const std::uint8_t x = a.masks[light][0][i];
            const std::uint8_t y = b.masks[light][0][i];
            if (!surface[i] || x == y) continue;
            ++found.bytes;
            found.shadow += (x == 0) != (y == 0) ? 1 : 0;
        }
    }
    return found;
}

class Savings : public DeviceTest {
protected:
    Picture take(const Row& row, const Setting& setting, const FillOptions& fill) {
        return must(take_picture(device(), setting,
                                 {.fill = fill, .cull_back_faces = row.cull_back_faces}));
    }

    struct Counts {
        std::uint64_t clamped = 0;        // pairs
        std::uint64_t in_slabs = 0;       // pairs
        std::uint64_t depth_bounded = 0;  // pairs that may be
    };
    // SwiftShader snaps vertices to sixteenths of a pixel, as wide as the band: some pixels beside
    // it are wrong whatever is left out.
    bool rasterises_coarsely() { return device().caps().adapter.starts_with("SwiftShader"); }

    // Holds the masks with all savings and with `without` against the truth, and says how many
    // pixels differ.
    Counts judge_without(const FillOptions& without) { return judge({.slabs = true}, without); }

    Counts judge(const FillOptions& with, const FillOptions& without) {
        Counts counts;
        std::uint64_t differ = 0;
        std::uint64_t judged = 0;
        for (std::size_t i = 0; i < rows().size(); ++i) {
            if (!falls_to(number(), i, 2)) continue;
            SCOPED_TRACE(rows()[i].name);
            const Setting setting = rows()[i].make();
            const Traced traced = trace_lights(setting);
            const Picture with_all = take(rows()[i], setting, with);
            const Picture plain = take(rows()[i], setting, without);
            const truth::Judgement judgement = judge_lights(traced, with_all.masks);
            const truth::Judgement of_plain = judge_lights(traced, plain.masks);
            judged += judgement.judged();
            if (rasterises_coarsely()) {
                EXPECT_LE(judgement.wrong(), of_plain.wrong())
                    << wrong_places(judgement, row_width);
            } else {
                EXPECT_EQ(judgement.wrong(), 0U) << wrong_places(judgement, row_width);
                EXPECT_EQ(of_plain.wrong(), 0U) << wrong_places(of_plain, row_width);
            }
            counts.clamped += with_all.list.stats.pairs_clamped;
            if (!without.clamp) {
                EXPECT_EQ(plain.list.stats.pairs_clamped, 0U);
            }
            counts.in_slabs += with_all.list.stats.pairs_in_slabs;
            if (!without.slabs || !without.clamp) {
                EXPECT_EQ(plain.list.stats.pairs_in_slabs, 0U);
            }
            counts.depth_bounded += static_cast<std::uint64_t>(
                std::ranges::count_if(with_all.list.draws, [](const auto& draw) {
                    return draw.technique == shadows::Technique::DepthPass &&
                           !draw.depth.everything();
                }));
            differ += compare(with_all, plain).shadow;
        }
        std::printf("%s: %llu pairs clamped, %llu in slabs, %llu of %llu pixels differ\n",
                    GetParam().name.c_str(), static_cast<unsigned long long>(counts.clamped),
                    static_cast<unsigned long long>(counts.in_slabs),
                    static_cast<unsigned long long>(differ),
                    static_cast<unsigned long long>(judged));
        return counts;
    }
};

TEST_P(Savings, of_culls_and_scissors_change_no_byte_on_a_surface) {
    constexpr std::array without{
        std::pair{"view cull", FillOptions{.cull_by_view = false, .slabs = true}},
        std::pair{"receiver cull", FillOptions{.cull_by_receivers = false, .slabs = true}},
        std::pair{"scissor", FillOptions{.slabs = true, .scissor = false}},
        std::pair{"all three", FillOptions{.cull_by_view = false,
                                           .cull_by_receivers = false,
                                           .slabs = true,
                                           .scissor = false}},
    };
    std::uint64_t in_slabs = 0;
    for (std::size_t i = 0; i < rows().size(); ++i) {
        if (!falls_to(number(), i, 2)) continue;
        SCOPED_TRACE(rows()[i].name);
        const Setting setting = rows()[i].make();
        const Picture with_all = take(rows()[i], setting, {.slabs = true});
        in_slabs += with_all.list.stats.pairs_in_slabs;
        for (const auto& [name, fill] : without) {
            EXPECT_EQ(compare(with_all, take(rows()[i], setting, fill)).bytes, 0U) << name;
        }
    }
    EXPECT_GT(in_slabs, 0U);
}

// Not to the byte: where a rasteriser leaves a crack between two sides of a volume, as SwiftShader
// does between those that it clips, depth bounds may hide it.
TEST_P(Savings, of_depth_bounds_are_right_outside_the_band) {
    if (!device().caps().features.depth_bounds) GTEST_SKIP() << "the adapter has no depth bounds";
    const Counts counts = judge_without({.slabs = true, .depth_bounds = false});
    EXPECT_GT(counts.depth_bounded, 0U);
}

TEST_P(Savings, of_umbrae_leave_no_shadow_out) {
    std::uint64_t in_umbra = 0;
    for (std::size_t i = 0; i < rows().size(); ++i) {
        if (!falls_to(number(), i, 2) && rows()[i].name != "casters_behind_others") continue;
        SCOPED_TRACE(rows()[i].name);
        const Setting setting = rows()[i].make();
        const Picture with_all = take(rows()[i], setting, {.slabs = true});
        const Picture without = take(rows()[i], setting, {.slabs = true, .cull_by_umbra = false});
        EXPECT_EQ(compare(with_all, without).shadow, 0U);
        EXPECT_EQ(without.list.stats.pairs_in_umbra, 0U);
        in_umbra += with_all.list.stats.pairs_in_umbra;
    }
    EXPECT_GT(in_umbra, 3U);
}

TEST_P(Savings, of_clamping_are_right_outside_the_band) {
    const Counts counts = judge_without(FillOptions::none());
    EXPECT_GT(counts.clamped, 0U);
}

TEST_P(Savings, of_slabs_are_right_outside_the_band) {
    const Counts counts = judge_without({});
    EXPECT_GT(counts.in_slabs, 0U);
}

INSTANTIATE_TEST_SUITE_P(Devices, Savings, testing::ValuesIn(drawing_devices()), device_case_name);

}  // namespace
}  // namespace gnomon::test
