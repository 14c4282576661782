// SPDX-License-Identifier: MIT
//
// Slabs: what is left out of a volume, no receiver lies in. Held against single rays; and what they
// are chosen by against brute force.
#include "internal/slabs.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "internal/coverage.hpp"
#include "internal/outline.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows::internal {
namespace {

using test::Random;

TEST(Coverage, IsTheUnionAndMoreOnlyWhereThereAreMany) {
    GNOMON_RANDOM(random);
    for (int run = 0; run < 2'000; ++run) {
        Coverage coverage;
        std::array<bool, 100> covered{};
        const std::uint32_t count = random.below(run % 2 == 0 ? 5 : 30) + 1;
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto low = random.below(90);
            const auto high = low + random.below(9);
            coverage.add({static_cast<double>(low), static_cast<double>(high)});
            for (auto x = low; x <= high; ++x) covered[x] = true;
        }
        const auto intervals = coverage.covered();
        ASSERT_LE(intervals.size(), 8U);
        for (std::size_t i = 1; i < intervals.size(); ++i) {
            ASSERT_LT(intervals[i - 1].high, intervals[i].low);
        }
        for (std::size_t x = 0; x < covered.size(); ++x) {
            const auto at = static_cast<double>(x);
            const bool held = coverage.holds({at, at});
            ASSERT_TRUE(held || !covered[x]);
            if (count <= 5) {
                ASSERT_EQ(held, covered[x]);
            }
        }
    }
}

TEST(Outline, CoversOfARectangleWhatPointsOfAGridSay) {
    GNOMON_RANDOM(random);
    double covered = 0.0;
    for (int run = 0; run < 300; ++run) {
        std::vector<glm::dvec2> points(random.below(14) + 1);
        for (glm::dvec2& p : points) p = glm::dvec2(random.in_cube(2.0));
        if (random.chance(0.2)) {
            for (glm::dvec2& p : points) p.y = 0.25 * p.x;
        }
        const glm::dvec2 low(random.uniform(-1.5, 0.0), random.uniform(-1.5, 0.0));
        const glm::dvec2 high =
            low + glm::dvec2(random.uniform(0.1, 2.0), random.uniform(0.1, 2.0));
        const auto original = points;
        const double area = hull_area_within(points, low, high);
        // A point is in a hull unless a line through two of its points leaves all on one side, and
        // it on the other.
        const auto is_in = [&](const glm::dvec2& q) {
            bool any = false;
            for (const glm::dvec2& a : original) {
                for (const glm::dvec2& b : original) {
                    if (a == b) continue;
                    any = true;
                    const auto side = [&](const glm::dvec2& p) {
                        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
                    };
                    const bool all_left = std::ranges::all_of(
                        original, [&](const glm::dvec2& p) { return side(p) >= -1e-12; });
                    if (all_left && side(q) < 0.0) return false;
                }
            }
            return any;
        };
        constexpr int steps = 50;
        int inside = 0;
        for (int y = 0; y < steps; ++y) {
            for (int x = 0; x < steps; ++x) {
                const glm::dvec2 t((x + 0.5) / steps, (y + 0.5) / steps);
                inside += is_in(glm::mix(low, high, t)) ? 1 : 0;
            }
        }
        const double whole = (high.x - low.x) * (high.y - low.y);
        ASSERT_NEAR(area / whole, inside / static_cast<double>(steps * steps), 0.06) << run;
        covered += area;
    }
    EXPECT_GT(covered, 50.0);
}

OrientedBounds box_at(const glm::dvec3& at, double half) {
    glm::dmat4 pose(1.0);
    pose[3] = glm::dvec4(at, 1.0);
    return {pose, glm::dvec3(-half), glm::dvec3(half)};
}

View looking(const glm::dvec3& eye, const glm::dvec3& target) {
    View view;
    view.view_from_world = look_at(eye, target, {0.01, 1.0, 0.02});
    view.clip_from_view = infinite_perspective(1.2, 1.6, 0.05);
    return view;
}

// A draw of a caster, as far as slabs go by it.
struct Cut {
    Reach reach;
    VolumeDraw draw;
    std::optional<Screen> screen;

    Cut(const OrientedBounds& caster, const Light& light, std::span<const Aabb> receivers,
        const View& view, Technique technique = Technique::DepthPass, bool near_caps = false) {
        ReceiverTree tree;
        tree.build(receivers);
        screen.emplace(view);
        const FillTerms terms{{.slabs = true}, &tree, &*screen};
        const ShadowHull hull(caster, light);
        reach = terms.reach(hull);
        draw.world_from_local = caster.world_from_local;
        draw.technique = technique;
        draw.near_caps = near_caps;
        draw.far_caps = technique == Technique::DepthFail || !reach.plane_is_last;
        draw.bounds = shown_of(terms, hull, reach).bounds;
        if (!reach.clamped || draw.bounds.empty()) return;
        const glm::dvec4 local = glm::inverse(caster.world_from_local) * light.position_world;
        const double plane = plane_distance(reach, screen->eye());
        draw.world_from_far =
            draw.world_from_local *
            projection_onto(plane_in(draw.world_from_local, reach.normal, plane), local);
        if (reach.gaps != nullptr) slabs_of(draw, hull, reach, *screen, local, true);
    }

    [[nodiscard]] double along(const glm::dmat4& world_from_vertex, const glm::dvec3& local) const {
        const glm::dvec4 p = world_from_vertex * glm::dvec4(local, 1.0);
        return glm::dot(reach.normal, glm::dvec3(p) / p.w);
    }
};

TEST(Slabs, HoldAllThatIsReceivedAndSeen) {
    GNOMON_RANDOM(random);
    std::uint64_t cut = 0;
    std::uint64_t parted = 0;
    std::uint64_t begun_late = 0;
    std::uint64_t judged = 0;
    for (int scene = 0; scene < 6'000; ++scene) {
        OrientedBounds caster = box_at(random.in_cube(3.0), random.uniform(0.3, 1.5));
        caster.max.y = caster.min.y + random.uniform(0.02, 1.0);
        caster.world_from_local =
            caster.world_from_local * glm::dmat4(glm::dmat3(random.rotation()));
        Light light;
        light.position_world = random.chance(0.5) ? glm::dvec4(random.unit_vector(), 0.0)
                                                  : glm::dvec4(random.in_cube(12.0), 1.0);
        const glm::dvec3 l(light.position_world);
        const auto behind = [&](const glm::dvec3& p, double t) {
            return light.position_world.w == 0.0 ? p - 10.0 * t * l : p + t * (p - l);
        };
        const auto place_in = [&](const OrientedBounds& box) {
            const glm::dvec3 t(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
            return glm::dvec3(glm::mix(box.min, box.max, t));
        };
        const auto to_world = [&](const glm::dvec3& p) {
            return glm::dvec3(caster.world_from_local * glm::dvec4(p, 1.0));
        };
        std::vector<Aabb> receivers;
        if (random.chance(0.5)) receivers.push_back(aabb_of(caster));
        for (std::uint32_t i = random.below(4) + 1; i > 0; --i) {
            const glm::dvec3 at = behind(to_world(place_in(caster)), random.uniform(0.2, 2.0));
            receivers.push_back(aabb_of(box_at(at, random.uniform(0.05, 0.8))));
        }
        const View view = looking(random.in_cube(15.0), random.in_cube(4.0));
        const bool fails = random.chance(0.3);
        const Cut made(caster, light, receivers, view,
                       fails ? Technique::DepthFail : Technique::DepthPass, random.chance(0.5));
        const auto& slabs = made.draw.slabs;
        if (slabs.empty()) continue;
        ++cut;
        parted += slabs.size() > 1 ? 1 : 0;
        begun_late += slabs.front().from_plane ? 1 : 0;
        for (const VolumeSlab& slab : slabs) {
            ASSERT_FALSE(slab.bounds.empty());
            ASSERT_EQ(slab.from_plane, slab.world_from_near != made.draw.world_from_local);
            ASSERT_TRUE(slab.near_caps || (!slab.from_plane && !made.draw.near_caps));
            const bool last = slab.world_from_far == made.draw.world_from_far;
            ASSERT_EQ(slab.far_caps, !last || made.draw.far_caps);
        }
        for (int ray = 0; ray < 300; ++ray) {
            const glm::dvec3 c = place_in(caster);
            const glm::dvec3 p = behind(to_world(c), random.uniform(0.0, 2.5));
            const bool received = std::ranges::any_of(receivers, [&](const Aabb& box) {
                return box.holds({p, p});
            });
            const glm::dvec4 clip = view.clip_from_world() * glm::dvec4(p, 1.0);
            const glm::dvec2 place(clip.x / clip.w, clip.y / clip.w);
            const bool seen = clip.w > 0.0 && clip.z <= clip.w && std::abs(place.x) < 1.0 &&
                              std::abs(place.y) < 1.0;
            if (!received || !seen) continue;
            ++judged;
            const double at = glm::dot(made.reach.normal, p);
            const auto holding = std::ranges::count_if(slabs, [&](const VolumeSlab& slab) {
                return made.along(slab.world_from_near, c) <= at + 1e-9 &&
                       made.along(slab.world_from_far, c) >= at && place.x >= slab.bounds.min.x &&
                       place.x <= slab.bounds.max.x && place.y >= slab.bounds.min.y &&
                       place.y <= slab.bounds.max.y;
            });
            ASSERT_EQ(holding, 1) << scene;
        }
    }
    EXPECT_GT(cut, 300U);
    EXPECT_GT(parted, 50U);
    EXPECT_GT(begun_late, 50U);
    EXPECT_GT(judged, 3'000U);
}

const Aabb ground{{-50.0, -0.1, -50.0}, {50.0, 0.0, 50.0}};

TEST(Slabs, LeaveOutTheWayToTheGround) {
    const OrientedBounds caster = box_at({0, 20, 0}, 0.5);
    const Light sun{.position_world = {0.1, 1.0, 0.05, 0.0}};
    const View view = looking({4, 8, 30}, {0, 9, 0});
    // It receives: a slab about it, and one about the ground.
    const Cut drawn(caster, sun, std::array{ground, aabb_of(caster)}, view);
    ASSERT_EQ(drawn.draw.slabs.size(), 2U);
    EXPECT_FALSE(drawn.draw.slabs[0].from_plane);
    EXPECT_FALSE(drawn.draw.slabs[0].near_caps);
    EXPECT_TRUE(drawn.draw.slabs[0].far_caps);
    EXPECT_TRUE(drawn.draw.slabs[1].from_plane);
    EXPECT_TRUE(drawn.draw.slabs[1].near_caps);
    EXPECT_EQ(drawn.draw.slabs[1].far_caps, drawn.draw.far_caps);
    // It does not: the volume begins on the ground. The scissor leaves out most of what is above
    // already, but for what is seen before the ground.
    const Cut hidden(box_at({0, 20, 0}, 3.0), sun, std::array{ground},
                     looking({14, 26, 14}, {0, 8, 0}), Technique::DepthPass, true);
    ASSERT_EQ(hidden.draw.slabs.size(), 1U);
    EXPECT_TRUE(hidden.draw.slabs[0].from_plane);
    EXPECT_TRUE(hidden.draw.slabs[0].near_caps);
    EXPECT_NEAR(hidden.along(hidden.draw.slabs[0].world_from_near, glm::dvec3(3.0)), 0.0, 0.05);
}

TEST(Slabs, AreNoneWhereCapsWouldCostMoreOrNothingIsFree) {
    const Light sun{.position_world = {0.1, 1.0, 0.05, 0.0}};
    const OrientedBounds low = box_at({0, 2, 0}, 0.5);
    const std::array receivers{ground, aabb_of(low)};
    const Cut above(low, sun, receivers, looking({0, 40, 1}, {0, 0, 0}));
    EXPECT_NE(above.reach.gaps, nullptr);
    EXPECT_TRUE(above.draw.slabs.empty()) << "caps are all that is seen from above";
    const OrientedBounds standing = box_at({0, 0.5, 0}, 0.5);
    EXPECT_EQ(
        Cut(standing, sun, std::array{ground, aabb_of(standing)}, looking({0, 2, 9}, {0, 1, 0}))
            .reach.gaps,
        nullptr);
}

}  // namespace
}  // namespace gnomon::shadows::internal
