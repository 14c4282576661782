// SPDX-License-Identifier: MIT
//
// Plan grids against ray-traced truth, by volumes, by projection and by the scan: equal but for
// cells that a shadow's edge passes, for a site with a house, open sheets and holes, for a city,
// and far from the origin.
#include <gtest/gtest.h>

#include <numbers>

#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>
#include <gnomon/sun/position.hpp>
#include <gnomon/sun_study/plan_projection.hpp>
#include <gnomon/sun_study/plan_scan.hpp>
#include <gnomon/sun_study/plan_shadows.hpp>
#include <gnomon/truth/truth.hpp>

#include "tests/sun_study/site.hpp"
#include "tests/support/devices.hpp"
#include "tests/support/models.hpp"
#include "tests/support/share.hpp"

namespace gnomon::sun_study {
namespace {

using gnomon::test::must;

constexpr double degree = std::numbers::pi / 180.0;

// The same view onto the plane, and the plane as a mesh in it.
class TracedPlan {
public:
    TracedPlan(const std::vector<shadows::Caster>& casters, const PlanGrid& grid) : grid_(grid) {
        const glm::dvec2 half = grid.size_m() * 0.5;
        const glm::dvec3 middle = world_from_plan(glm::dvec3(grid.min_m + half, grid.height_m));
        std::vector<truth::Instance> instances;
        double top = middle.y + 1.0;
        for (const shadows::Caster& caster : casters) {
            const auto faces = caster.mesh->faces();
            instances.push_back({.positions = caster.mesh->positions(),
                                 .indices = {faces.data()->data(), faces.size() * 3},
                                 .world_from_local = caster.world_from_local,
                                 .receives = false});
            const shadows::OrientedBounds box{caster.world_from_local, caster.mesh->bounds_min(),
                                              caster.mesh->bounds_max()};
            for (const glm::dvec3& corner : corners_of(box)) top = std::max(top, corner.y);
        }
        const auto x = static_cast<float>(half.x * 1.1);
        const auto z = static_cast<float>(half.y * 1.1);
        const std::vector<glm::vec3> corners{{-x, 0, -z}, {-x, 0, z}, {x, 0, z}, {x, 0, -z}};
        const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
        truth::Instance plane{.positions = corners, .indices = indices, .casts = false};
        plane.world_from_local[3] = glm::dvec4(middle, 1.0);
        instances.push_back(plane);
        tracer_.emplace(must(truth::Tracer::build(instances, middle)));
        const double above = 2.0 * (top - middle.y);
        view_ = {shadows::look_at(middle + glm::dvec3(0.0, above, 0.0), middle, {0.0, 0.0, -1.0}),
                 shadows::orthographic(half.x, half.y, 0.0, 2.0 * above),
                 shadows::ProjectionKind::Orthographic};
    }

    truth::Picture trace(const glm::dvec3& sun) const {
        return tracer_->trace(view_,
                              {.key = 1, .position_world = glm::dvec4(world_from_plan(sun), 0.0)},
                              {.width = grid_.columns, .height = grid_.rows});
    }

private:
    PlanGrid grid_;
    shadows::View view_;
    std::optional<truth::Tracer> tracer_;
};

truth::Judgement judge(const truth::Picture& truth, const PlanMask& lit) {
    std::vector<std::uint8_t> dark(lit.size());
    std::ranges::transform(lit, dark.begin(),
                           [](std::uint8_t one) { return static_cast<std::uint8_t>(1 - one); });
    return truth::judge(truth, dark);
}

// The scan is held to what is true of the centres alone, within 1/1000 of a cell.
std::size_t scanned_wrong(const truth::Picture& truth, const PlanMask& lit) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < lit.size(); ++i) {
        const truth::Verdict verdict = truth.centres[i];
        if (verdict != truth::Verdict::Lit && verdict != truth::Verdict::Shadowed) continue;
        wrong += (verdict == truth::Verdict::Lit) != (lit[i] != 0) ? 1 : 0;
    }
    return wrong;
}

// From straight above, the side of a volume that begins at an upright edge is a line, and at what
// depth an eye ray on that line meets it is for rounding to say (plan_shadows.hpp).
bool is_on_a_side_seen_edge_on(const std::vector<shadows::Caster>& casters, const glm::dvec2& at,
                               const glm::dvec3& sun, double cell_m) {
    const glm::dvec2 away = -glm::normalize(glm::dvec2(sun));
    for (const shadows::Caster& caster : casters) {
        const auto place = [&](std::uint32_t vertex) {
            return plan_from_world(
                glm::dvec3(caster.world_from_local *
                           glm::dvec4(glm::dvec3(caster.mesh->positions()[vertex]), 1.0)));
        };
        for (const shadows::Edge& edge : caster.mesh->edges()) {
            const glm::dvec3 low = place(edge.low);
            if (glm::distance(glm::dvec2(low), glm::dvec2(place(edge.high))) > 1e-6) continue;
            const glm::dvec2 to = at - glm::dvec2(low);
            const double beside = std::abs(to.x * away.y - to.y * away.x);
            if (glm::dot(to, away) > 0.0 && beside < cell_m / 128.0) return true;
        }
    }
    return false;
}

// How many are wrong for no such reason.
std::size_t wrong_without_excuse(const truth::Judgement& judged,
                                 const std::vector<shadows::Caster>& casters, const PlanGrid& grid,
                                 const glm::dvec3& sun) {
    return static_cast<std::size_t>(
        std::ranges::count_if(judged.wrong_pixels, [&](std::uint32_t cell) {
            const glm::dvec2 at = grid.center_m(cell % grid.columns, cell / grid.columns);
            return !is_on_a_side_seen_edge_on(casters, at, sun, grid.cell_m);
        }));
}

const std::vector<glm::dvec3>& suns() {
    static const std::vector<glm::dvec3> directions{
        sun::towards_sun(121.3 * degree, 9.7 * degree),
        sun::towards_sun(158.0 * degree, 38.2 * degree),
        sun::towards_sun(244.9 * degree, 21.5 * degree)};
    return directions;
}

class PlanTruth : public gnomon::test::DeviceTest {};

INSTANTIATE_TEST_SUITE_P(Devices, PlanTruth, testing::ValuesIn(gnomon::test::drawing_devices()),
                         gnomon::test::device_case_name);

TEST_P(PlanTruth, HasTheSiteRightButForEdges) {
    const PlanGrid grid = test::site_grid();
    const TracedPlan traced(test::site(), grid);
    auto shadows = must(PlanShadows::create(device(), test::site(), grid));
    auto projection = must(PlanProjection::create(device(), test::site(), grid));
    const std::vector<PlanMask> projected = must(projection.lit(suns()));
    const std::vector<PlanMask> scanned = PlanScan(test::site(), grid).lit(suns());
    truth::Judgement all;
    for (std::size_t i = 0; i < suns().size(); ++i) {
        const glm::dvec3& sun = suns()[i];
        const truth::Picture truth = traced.trace(sun);
        EXPECT_EQ(judge(truth, projected[i]).wrong(), 0U);
        EXPECT_EQ(judge(truth, scanned[i]).wrong(), 0U);
        EXPECT_EQ(scanned_wrong(truth, scanned[i]), 0U);
        const truth::Judgement one = judge(truth, must(shadows.lit(sun)));
        EXPECT_EQ(wrong_without_excuse(one, test::site(), grid, sun), 0U);
        EXPECT_GT(one.shadowed, 300U);
        EXPECT_GT(one.lit, 300U);
        all += one;
    }
    EXPECT_LE(all.wrong(), 1U);
    EXPECT_EQ(all.judged() + all.band, suns().size() * grid.cell_count());
    RecordProperty("edge_share",
                   std::to_string(static_cast<double>(all.band) / static_cast<double>(all.pixels)));
}

// UTM: 34 km east of the zone's edge, 5,350 km north of the equator, 255 m above the sea.
TEST_P(PlanTruth, IsTheSameInGeoreferencedCoordinates) {
    const glm::dvec3 shift(533987.7, 5350123.3, 255.4);
    const PlanGrid grid = test::site_grid(shift);
    const TracedPlan traced(test::site(shift), grid);
    auto here = must(PlanShadows::create(device(), test::site(), test::site_grid()));
    auto there = must(PlanShadows::create(device(), test::site(shift), grid));
    const glm::dvec3 sun = suns().front();
    const PlanMask mask = must(there.lit(sun));
    const PlanMask mask_here = must(here.lit(sun));
    const truth::Picture truth = traced.trace(sun);
    EXPECT_EQ(judge(truth, mask).wrong(), 0U);
    auto projection = must(PlanProjection::create(device(), test::site(shift), grid));
    EXPECT_EQ(judge(truth, must(projection.lit(std::span(&sun, 1))).front()).wrong(), 0U);
    const PlanMask scanned = PlanScan(test::site(shift), grid).lit(std::span(&sun, 1)).front();
    EXPECT_EQ(scanned_wrong(truth, scanned), 0U);
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (truth.verdicts[i] == truth::Verdict::Band) continue;
        ASSERT_EQ(mask[i], mask_here[i]) << i;
    }
}

TEST_P(PlanTruth, HasAPieceOfACityRightButForEdges) {
    const auto file = gnomon::test::models_folder() / "scenes" / "linz-old-town.glb";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    if (!gnomon::test::falls_to(number(), 0, 2)) GTEST_SKIP() << "another device has its turn";
    scene::Scene city = must(scene::load_scene(file.string()));
    scene::update_world_transforms(city.registry);
    scene::ShadowAdapter adapter;
    const std::vector<shadows::Caster> casters = must(adapter.casters(city));
    const PlanGrid grid = must(make_grid({-100.0, -80.0}, {100.0, 80.0}, 1.0, 0.1, 4096));
    const TracedPlan traced(casters, grid);
    auto shadows = must(PlanShadows::create(device(), casters, grid));
    auto projection = must(PlanProjection::create(device(), casters, grid));
    PlanScan scan(casters, grid);
    for (const glm::dvec3& sun : {suns()[1], suns()[2]}) {
        const truth::Picture truth = traced.trace(sun);
        const truth::Judgement judged = judge(truth, must(shadows.lit(sun)));
        EXPECT_EQ(judged.wrong(), 0U);
        const std::span one(&sun, 1);
        EXPECT_EQ(judge(truth, must(projection.lit(one)).front()).wrong(), 0U);
        const PlanMask scanned = scan.lit(one).front();
        EXPECT_EQ(judge(truth, scanned).wrong(), 0U);
        EXPECT_EQ(scanned_wrong(truth, scanned), 0U);
        EXPECT_GT(judged.lit, 1000U);
        EXPECT_GT(judged.shadowed, 1000U);
    }
}

}  // namespace
}  // namespace gnomon::sun_study
