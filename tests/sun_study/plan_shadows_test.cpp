// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/shadows/shadow_query.hpp>
#include <gnomon/sun/position.hpp>
#include <gnomon/sun_study/plan_shadows.hpp>

#include "tests/sun_study/site.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::sun_study {
namespace {

using gnomon::test::must;

constexpr double degree = std::numbers::pi / 180.0;

class PlanShadowsTest : public gnomon::test::DeviceTest {};

INSTANTIATE_TEST_SUITE_P(Devices, PlanShadowsTest,
                         testing::ValuesIn(gnomon::test::drawing_devices()),
                         gnomon::test::device_case_name);

// Where a ray from a point of the plane towards the sun enters a box on that plane, by slabs.
bool box_is_before(const glm::dvec3& from, const glm::dvec3& towards, const glm::dvec3& box_min,
                   const glm::dvec3& box_max) {
    double begin = 0.0;
    double end = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const double a = (box_min[i] - from[i]) / towards[i];
        const double b = (box_max[i] - from[i]) / towards[i];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return begin < end;
}

// A box 4 x 6 m wide and 5 m high, off the origin, whatever the sun.
TEST_P(PlanShadowsTest, CastABoxAsGeometryDoes) {
    const glm::dvec3 at(1.3, -0.7, 2.5);
    const glm::dvec3 half(2.0, 3.0, 2.5);
    const PlanGrid grid = must(make_grid({-20.0, -15.0}, {20.0, 15.0}, 0.5, 0.0625, 4096));
    auto shadows = must(PlanShadows::create(
        device(), {test::caster_of(1, scene::make_box({4.0F, 5.0F, 6.0F}), at)}, grid));
    for (const double azimuth : {100.0, 135.5, 181.0, 263.0}) {
        for (const double altitude : {12.0, 33.0, 71.0}) {
            const glm::dvec3 sun = sun::towards_sun(azimuth * degree, altitude * degree);
            const PlanMask mask = must(shadows.lit(sun));
            ASSERT_EQ(mask.size(), grid.cell_count());
            std::size_t dark = 0;
            std::size_t edge = 0;
            for (std::uint32_t row = 0; row < grid.rows; ++row) {
                for (std::uint32_t column = 0; column < grid.columns; ++column) {
                    const glm::dvec2 center = grid.center_m(column, row);
                    int before = 0;
                    for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {-1, 1}, {1, -1}, {1, 1}}) {
                        const glm::dvec3 from(center + corner * (grid.cell_m / 16.0),
                                              grid.height_m);
                        before += box_is_before(from, sun, at - half, at + half) ? 1 : 0;
                    }
                    if (before % 4 != 0) {
                        ++edge;
                        continue;
                    }
                    dark += before == 4 ? 1 : 0;
                    ASSERT_EQ(mask[std::size_t{row} * grid.columns + column], before == 0 ? 1 : 0)
                        << column << ", " << row << " at azimuth " << azimuth << ", altitude "
                        << altitude;
                }
            }
            EXPECT_GT(dark, 90U);
            EXPECT_LT(edge, grid.cell_count() / 20);
        }
    }
}

// The other way of asking: a house, open sheets and holes, on the same casters.
TEST_P(PlanShadowsTest, AgreeWithShadowQueriesButForEdges) {
    const PlanGrid grid = test::site_grid();
    const std::vector<shadows::Caster> casters = test::site();
    auto plan = must(PlanShadows::create(device(), casters, grid));
    shadows::ShadowQueries queries;
    queries.update(casters);
    for (const double azimuth : {121.0, 187.0}) {
        const glm::dvec3 sun = sun::towards_sun(azimuth * degree, 24.0 * degree);
        const shadows::Light light{.key = 1,
                                   .position_world = glm::dvec4(world_from_plan(sun), 0.0)};
        const PlanMask mask = must(plan.lit(sun));
        std::size_t edge = 0;
        std::size_t dark = 0;
        for (std::uint32_t row = 0; row < grid.rows; ++row) {
            for (std::uint32_t column = 0; column < grid.columns; ++column) {
                int lit = 0;
                for (const glm::dvec2 corner :
                     {glm::dvec2(0, 0), {-1, -1}, {-1, 1}, {1, -1}, {1, 1}}) {
                    const glm::dvec2 at =
                        grid.center_m(column, row) + corner * (grid.cell_m / 16.0);
                    const glm::dvec3 world = world_from_plan(glm::dvec3(at, grid.height_m));
                    lit += queries.at(light, world) == shadows::Exposure::Lit ? 1 : 0;
                }
                dark += lit == 0 ? 1 : 0;
                edge += lit % 5 != 0 ? 1 : 0;
                if (lit % 5 != 0) continue;
                ASSERT_EQ(mask[std::size_t{row} * grid.columns + column], lit == 0 ? 0 : 1)
                    << column << ", " << row << " at azimuth " << azimuth;
            }
        }
        EXPECT_GT(dark, 500U);
        EXPECT_LT(edge, grid.cell_count() / 10);
    }
}

TEST_P(PlanShadowsTest, OfTheZenithAreTheCellsUnderSomething) {
    const PlanGrid grid = must(make_grid({-10.0, -10.0}, {10.0, 10.0}, 1.0, 0.125, 4096));
    auto shadows = must(PlanShadows::create(
        device(), {test::caster_of(1, scene::make_box({4.0F, 5.0F, 6.0F}), {0.0, 0.0, 2.5})},
        grid));
    const PlanMask open = must(shadows.lit({0.0, 0.0, 1.0}));
    EXPECT_EQ(std::count(open.begin(), open.end(), 0), 4 * 6);
    // Row 0 is the uppermost: the box lies about the middle.
    EXPECT_EQ(open[std::size_t{7} * 20 + 8], 0);
    EXPECT_EQ(open[std::size_t{6} * 20 + 8], 1);
}

// What they remember of the sun before changes nothing.
TEST_P(PlanShadowsTest, DoNotDependOnTheSunBefore) {
    const PlanGrid grid = test::site_grid();
    auto creeping = must(PlanShadows::create(device(), test::site(), grid));
    std::uint64_t reused = 0;
    for (int step = 0; step < 12; ++step) {
        const glm::dvec3 sun = sun::towards_sun((120.0 + step * 0.5) * degree, 25.0 * degree);
        const PlanMask mask = must(creeping.lit(sun));
        reused += creeping.stats().pairs_reused;
        if (step % 4 != 3) continue;
        auto fresh =
            must(PlanShadows::create(device(), test::site(), grid, {.silhouette = "brute_force"}));
        EXPECT_EQ(must(fresh.lit(sun)), mask) << step;
    }
    EXPECT_GT(reused, 0U);
}

TEST_P(PlanShadowsTest, DrawLargeGridsInTiles) {
    const PlanGrid grid = test::site_grid();
    const std::vector<shadows::Caster> casters = test::site();
    const glm::dvec3 sun = sun::towards_sun(121.0 * degree, 24.0 * degree);
    auto tiled = must(PlanShadows::create(device(), casters, grid, {.most_cells_a_side = 48}));
    const PlanMask mask = must(tiled.lit(sun));
    const PlanMask whole = must(must(PlanShadows::create(device(), casters, grid)).lit(sun));
    const std::vector<bool> off = test::cells_off_edges(casters, grid, sun);
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (!off[i]) continue;
        ASSERT_EQ(mask[i], whole[i]) << "cell " << i;
    }
}

}  // namespace
}  // namespace gnomon::sun_study
