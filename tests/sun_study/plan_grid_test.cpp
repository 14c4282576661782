// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include <gnomon/sun_study/plan_grid.hpp>

namespace gnomon::sun_study {
namespace {

TEST(PlanGrid, CoversItsAreaWithWholeCells) {
    const auto grid = make_grid({10.0, 20.0}, {14.0, 23.1}, 0.5, 1.5, 100);
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->columns, 8U);
    EXPECT_EQ(grid->rows, 7U);
    EXPECT_EQ(grid->max_m(), glm::dvec2(14.0, 23.5));
    // The uppermost row first.
    EXPECT_EQ(grid->center_m(0, 0), glm::dvec2(10.25, 23.25));
    EXPECT_EQ(grid->center_m(7, 6), glm::dvec2(13.75, 20.25));
    // A tenth is no binary fraction; ten of them are one metre all the same.
    EXPECT_EQ(make_grid({0.0, 0.0}, {1.0, 0.1 * 3}, 0.1, 0.0, 100)->rows, 3U);
}

TEST(PlanGrid, RefusesWhatIsNoGrid) {
    const auto message = [](const Result<PlanGrid>& grid) {
        return grid ? std::string("accepted") : grid.error().message;
    };
    using testing::HasSubstr;
    EXPECT_THAT(message(make_grid({0, 0}, {10, 10}, 0.0, 0.0, 100)), HasSubstr("no size"));
    EXPECT_THAT(message(make_grid({0, 0}, {10, 0}, 1.0, 0.0, 100)), HasSubstr("empty"));
    EXPECT_THAT(message(make_grid({0, 0}, {10, -1}, 1.0, 0.0, 100)), HasSubstr("empty"));
    EXPECT_THAT(message(make_grid({0, 0}, {101, 10}, 1.0, 0.0, 100)), HasSubstr("101 x 10 cells"));
    EXPECT_THAT(message(make_grid({0, 0}, {30, 10}, 1.0, 0.0, 100, 299)),
                HasSubstr("30 x 10 cells has more than 299"));
    EXPECT_THAT(message(make_grid({0, 0}, {30, 10}, 1.0, 0.0, 100, 300)), HasSubstr("accepted"));
    EXPECT_THAT(message(make_grid({1e15, 0}, {1e15 + 10, 10}, 1.0, 0.0, 100)),
                HasSubstr("double precision"));
    EXPECT_THAT(
        message(make_grid({0, 0}, {std::numeric_limits<double>::infinity(), 10}, 1.0, 0.0, 100)),
        HasSubstr("not finite"));
}

TEST(PlanCoordinates, GoThereAndBack) {
    const glm::dvec3 plan(1.0, 2.0, 3.0);
    EXPECT_EQ(world_from_plan(plan), glm::dvec3(1.0, 3.0, -2.0));
    EXPECT_EQ(plan_from_world(world_from_plan(plan)), plan);
}

}  // namespace
}  // namespace gnomon::sun_study
