// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/sun/position.hpp>
#include <gnomon/sun_study/plan_projection.hpp>
#include <gnomon/sun_study/plan_scan.hpp>

#include "tests/sun_study/site.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::sun_study {
namespace {

using gnomon::test::must;

constexpr double degree = std::numbers::pi / 180.0;

class PlanProjectionTest : public gnomon::test::DeviceTest {};

INSTANTIATE_TEST_SUITE_P(Devices, PlanProjectionTest,
                         testing::ValuesIn(gnomon::test::drawing_devices()),
                         gnomon::test::device_case_name);

std::vector<glm::dvec3> suns_of_a_day(std::size_t count) {
    std::vector<glm::dvec3> suns;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(count);
        suns.push_back(sun::towards_sun((95.0 + 170.0 * t) * degree,
                                        (4.0 + 50.0 * std::sin(std::numbers::pi * t)) * degree));
    }
    return suns;
}

void expect_equal_off_edges(const PlanMask& a, const PlanMask& b,
                            const std::vector<bool>& is_off_edges) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!is_off_edges[i]) continue;
        ASSERT_EQ(a[i], b[i]) << "cell " << i;
    }
}

// More suns than two buffers have bits.
TEST_P(PlanProjectionTest, AgreesWithTheScanButForEdges) {
    const PlanGrid grid = test::site_grid();
    const std::vector<shadows::Caster> site = test::site();
    const std::vector<glm::dvec3> suns = suns_of_a_day(19);
    auto projection = must(PlanProjection::create(device(), site, grid));
    const std::vector<PlanMask> drawn = must(projection.lit(suns));
    const std::vector<PlanMask> scanned = PlanScan(site, grid).lit(suns);
    ASSERT_EQ(drawn.size(), suns.size());
    for (std::size_t i = 0; i < suns.size(); i += 3) {
        const std::vector<bool> off = test::cells_off_edges(site, grid, suns[i]);
        EXPECT_GT(std::ranges::count(off, true), static_cast<std::ptrdiff_t>(off.size() * 3 / 4));
        EXPECT_GT(std::ranges::count(drawn[i], 0), 300);
        expect_equal_off_edges(drawn[i], scanned[i], off);
    }
    // What was drawn before changes nothing.
    EXPECT_EQ(must(projection.lit(std::span(suns).last(1))).front(), drawn.back());
    EXPECT_TRUE(must(projection.lit({})).empty());
}

TEST_P(PlanProjectionTest, DrawsLargeGridsInTiles) {
    const PlanGrid grid = test::site_grid();
    const std::vector<shadows::Caster> site = test::site();
    const std::vector<glm::dvec3> suns = suns_of_a_day(3);
    auto tiled = must(PlanProjection::create(device(), site, grid, {.most_cells_a_side = 48}));
    const std::vector<PlanMask> masks = must(tiled.lit(suns));
    const std::vector<PlanMask> scanned = PlanScan(site, grid).lit(suns);
    for (std::size_t i = 0; i < suns.size(); ++i) {
        expect_equal_off_edges(masks[i], scanned[i], test::cells_off_edges(site, grid, suns[i]));
    }
}

TEST_P(PlanProjectionTest, LightsAllWhereNothingIsAboveThePlane) {
    const PlanGrid grid = must(make_grid({-4.0, -4.0}, {4.0, 4.0}, 0.5, 10.0, 4096));
    auto plan = must(PlanProjection::create(device(), test::site(), grid));
    const glm::dvec3 sun = sun::towards_sun(150.0 * degree, 20.0 * degree);
    const PlanMask mask = must(plan.lit(std::span(&sun, 1))).front();
    EXPECT_EQ(std::ranges::count(mask, 1), static_cast<std::ptrdiff_t>(grid.cell_count()));
}

}  // namespace
}  // namespace gnomon::sun_study
