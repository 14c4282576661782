// SPDX-License-Identifier: MIT
//
// The trees that beams walk through, by Embree and by the builder that a browser has: what is true
// does not depend on them. And rows that are traced apart are the rows of the whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "internal/box_tree.hpp"
#include "tests/rows/rows.hpp"
#include "tests/support/devices.hpp"
#include "tests/truth/traced.hpp"

namespace gnomon::test {
namespace {

using truth::internal::BoxTree;
using truth::internal::NumberedBox;

class Builders : public testing::TestWithParam<Row> {};

TEST_P(Builders, verdicts_are_the_same) {
    constexpr truth::Options small{.width = 96, .height = 72};
    const Setting setting = GetParam().make();
    const Traced best = trace_lights(setting, small);
    const Traced plain = trace_lights(setting, small, 1, truth::TreeBuilder::Plain);
    ASSERT_EQ(best.size(), plain.size());
    for (std::size_t light = 0; light < best.size(); ++light) {
        EXPECT_EQ(best[light][0].verdicts, plain[light][0].verdicts) << "light " << light;
        EXPECT_EQ(best[light][0].centres, plain[light][0].centres) << "light " << light;
    }
}

INSTANTIATE_TEST_SUITE_P(Rows, Builders, testing::ValuesIn(rows()),
                         [](const auto& param) { return param.param.name; });

TEST(Bands, are_the_rows_of_the_whole) {
    const Setting setting = rows()[0].make();
    constexpr truth::Options all{.width = 64, .height = 50};
    const truth::Picture whole = trace_lights(setting, all)[0][0];
    std::vector<truth::Verdict> verdicts;
    std::vector<truth::Verdict> centres;
    for (std::uint32_t row = 0; row < all.height; row += 16) {
        truth::Options band = all;
        band.first_row = row;
        band.rows = 16;
        const truth::Picture picture = trace_lights(setting, band)[0][0];
        EXPECT_EQ(picture.width, all.width);
        EXPECT_EQ(picture.height, std::min(16U, all.height - row));
        verdicts.insert(verdicts.end(), picture.verdicts.begin(), picture.verdicts.end());
        centres.insert(centres.end(), picture.centres.begin(), picture.centres.end());
    }
    EXPECT_EQ(verdicts, whole.verdicts);
    EXPECT_EQ(centres, whole.centres);
    truth::Options beyond = all;
    beyond.first_row = all.height + 1;
    EXPECT_EQ(trace_lights(setting, beyond)[0][0].height, 0U);
}

// Every number once, children within their parents, and no deeper than a walk's stack.
void expect_whole(const BoxTree& tree, const std::vector<NumberedBox>& boxes) {
    std::vector<std::uint32_t> numbers = tree.order;
    std::ranges::sort(numbers);
    ASSERT_EQ(numbers.size(), boxes.size());
    for (std::uint32_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], i);
    if (boxes.empty()) return;
    struct Due {
        std::size_t node;
        std::size_t depth;
    };
    std::vector<Due> due{{0, 0}};
    std::size_t met = 0;
    while (!due.empty()) {
        const auto [place, depth] = due.back();
        due.pop_back();
        const BoxTree::Node& node = tree.nodes.at(place);
        ASSERT_LE(depth, BoxTree::max_depth);
        const auto holds = [&](const auto& inner) {
            return glm::all(glm::lessThanEqual(node.min, inner.min)) &&
                   glm::all(glm::lessThanEqual(inner.max, node.max));
        };
        ++met;
        if (node.count > 0) {
            ASSERT_LE(node.count, BoxTree::max_leaf);
            for (std::uint32_t i = 0; i < node.count; ++i) {
                ASSERT_TRUE(holds(boxes[tree.order.at(node.first + i)]));
            }
            continue;
        }
        for (std::size_t child = 0; child < 2; ++child) {
            ASSERT_TRUE(holds(tree.nodes.at(node.first + child)));
            due.push_back({node.first + child, depth + 1});
        }
    }
    EXPECT_EQ(met, tree.nodes.size());
}

TEST(PlainBuilder, holds_every_box_whatever_they_are_like) {
    std::mt19937 random(7);  // the same each time
    std::uniform_real_distribution<float> anywhere(-100.0F, 100.0F);
    const auto number = [](std::vector<NumberedBox> boxes) {
        for (std::uint32_t i = 0; i < boxes.size(); ++i) boxes[i].number = i;
        return boxes;
    };
    std::vector<std::vector<NumberedBox>> cases{{}, number({{}}), number({{}, {}})};
    std::vector<NumberedBox>& scattered = cases.emplace_back();
    std::vector<NumberedBox>& nested = cases.emplace_back();
    std::vector<NumberedBox>& halving = cases.emplace_back();
    for (std::uint32_t i = 0; i < 3000; ++i) {
        const glm::vec3 a(anywhere(random), anywhere(random), anywhere(random));
        const glm::vec3 b(anywhere(random), anywhere(random), anywhere(random));
        scattered.push_back({glm::min(a, b), glm::max(a, b)});
        // One within the other, about the same middle: no place tells them apart.
        nested.push_back({glm::vec3(-float(i)), glm::vec3(float(i))});
        // Each half as far as the last: a search by places cuts off few at a time.
        const glm::vec3 place(std::max(std::ldexp(1e18F, -int(i)), 0.0F), 0.0F, 0.0F);
        halving.push_back({place, place});
    }
    cases.push_back(std::vector<NumberedBox>(5000));  // all the same
    constexpr float far = 1e18F;                      // as far as soups go
    cases.push_back({{glm::vec3(-far), glm::vec3(-far)},
                     {glm::vec3(far), glm::vec3(far)},
                     {glm::vec3(0.0F), glm::vec3(0.0F)},
                     {glm::vec3(-far), glm::vec3(far)}});
    for (std::vector<NumberedBox>& boxes : cases) {
        boxes = number(std::move(boxes));
        expect_whole(truth::internal::build_plainly(boxes), boxes);
    }
}

}  // namespace
}  // namespace gnomon::test
