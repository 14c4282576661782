// SPDX-License-Identifier: MIT
//
// What FillOptions leave out, no pixel can tell. Culls and scissors: the same bytes on every
// surface, whatever else is left out. Clamping: no pixel is wrong outside the band either way;
// those within it that differ are counted.
#include <gtest/gtest.h>

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
};

TEST_P(Savings, of_culls_and_scissors_change_no_byte_on_a_surface) {
    constexpr std::array without{
        std::pair{"view cull", FillOptions{.cull_by_view = false}},
        std::pair{"receiver cull", FillOptions{.cull_by_receivers = false}},
        std::pair{"scissor", FillOptions{.scissor = false}},
        std::pair{"all three", FillOptions{false, false, true, false}},
    };
    for (std::size_t i = 0; i < rows().size(); ++i) {
        if (!falls_to(number(), i, 2)) continue;
        SCOPED_TRACE(rows()[i].name);
        const Setting setting = rows()[i].make();
        const Picture with_all = take(rows()[i], setting, {});
        for (const auto& [name, fill] : without) {
            EXPECT_EQ(compare(with_all, take(rows()[i], setting, fill)).bytes, 0U) << name;
        }
    }
}

TEST_P(Savings, of_clamping_are_right_outside_the_band) {
    std::uint64_t clamped = 0;
    std::uint64_t differ = 0;
    std::uint64_t judged = 0;
    for (std::size_t i = 0; i < rows().size(); ++i) {
        if (!falls_to(number(), i, 2)) continue;
        SCOPED_TRACE(rows()[i].name);
        const Setting setting = rows()[i].make();
        const Traced traced = trace_lights(setting);
        const Picture with_all = take(rows()[i], setting, {});
        const Picture endless = take(rows()[i], setting, FillOptions::none());
        for (const Picture* picture : {&with_all, &endless}) {
            const truth::Judgement judgement = judge_lights(traced, picture->masks);
            EXPECT_EQ(judgement.wrong(), 0U) << wrong_places(judgement, row_width);
            judged += judgement.judged();
        }
        clamped += with_all.list.stats.pairs_clamped;
        EXPECT_EQ(endless.list.stats.pairs_clamped, 0U);
        differ += compare(with_all, endless).shadow;
    }
    std::printf("%s: %llu pairs clamped, %llu of %llu pixels differ, all in the band\n",
                GetParam().name.c_str(), static_cast<unsigned long long>(clamped),
                static_cast<unsigned long long>(differ),
                static_cast<unsigned long long>(judged / 2));
    EXPECT_GT(clamped, 0U);
}

INSTANTIATE_TEST_SUITE_P(Devices, Savings, testing::ValuesIn(drawing_devices()), device_case_name);

}  // namespace
}  // namespace gnomon::test
