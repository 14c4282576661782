// SPDX-License-Identifier: MIT
//
// The order of draw calls and the scissors that are left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>
#include <vector>

#include "internal/prepared_light.hpp"
#include "internal/scissor_choice.hpp"

namespace gnomon::shadow_pass::internal {
namespace {

constexpr shadows::PixelRect everything{0, 0, 100, 80};
constexpr shadows::PixelRect corner{0, 0, 10, 10};

TEST(CallOrder, keeps_every_call_in_its_batch_and_changes_state_seldom) {
    constexpr unsigned seed = 20261126;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<Call> calls;
    for (std::uint32_t i = 0; i < 200; ++i) {
        Call call;
        call.scissor = random() % 4 == 0 ? corner : everything;
        call.count = 3 * i + 3;
        call.instance = i;
        call.batch = i / 100;
        call.pipeline = static_cast<std::uint8_t>(random() % 3);
        calls.push_back(call);
    }
    std::vector<Call> sorted = calls;
    std::shuffle(sorted.begin(), sorted.end(), random);
    sort_calls(sorted, everything);
    ASSERT_EQ(sorted.size(), calls.size());
    int changes = 0;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        EXPECT_GE(sorted[i].batch, sorted[i - 1].batch);
        changes += sorted[i].pipeline != sorted[i - 1].pipeline ? 1 : 0;
        changes += !(sorted[i].scissor == sorted[i - 1].scissor) ? 1 : 0;
    }
    EXPECT_LE(changes, 2 * (3 + 6)) << "three pipelines, with and without scissor, two batches";
    std::sort(sorted.begin(), sorted.end(),
              [](const Call& a, const Call& b) { return a.instance < b.instance; });
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        EXPECT_EQ(sorted[i].count, calls[i].count);
        EXPECT_EQ(sorted[i].pipeline, calls[i].pipeline);
        EXPECT_EQ(sorted[i].scissor, calls[i].scissor);
    }
}

TEST(ScissorChoice, leaves_out_what_saves_little) {
    const shadows::PixelRect wanted{100, 100, 50, 50};
    EXPECT_FALSE(scissor_pays({110, 110, 20, 20}, wanted)) << "within it already";
    EXPECT_FALSE(scissor_pays({100, 100, 60, 50}, wanted)) << "500 pixels";
    EXPECT_TRUE(scissor_pays({100, 100, 500, 50}, wanted));
    EXPECT_TRUE(scissor_pays({300, 300, 50, 50}, wanted)) << "all of it in vain";
}

}  // namespace
}  // namespace gnomon::shadow_pass::internal
