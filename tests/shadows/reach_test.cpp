// SPDX-License-Identifier: MIT
//
// How far shadows have to go: held against single rays from the light.
#include "internal/reach.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows::internal {
namespace {

using test::Random;

OrientedBounds random_box(Random& random, double size, double spread) {
    const glm::dvec3 half(size * std::pow(10.0, random.uniform(-2.0, 0.0)),
                          size * std::pow(10.0, random.uniform(-2.0, 0.0)),
                          size * std::pow(10.0, random.uniform(-2.0, 0.0)));
    glm::dmat4 pose(glm::dmat3(random.rotation()));
    pose[3] = glm::dvec4(random.in_cube(spread), 1.0);
    return {pose, -half, half};
}

glm::dvec3 point_in(Random& random, const OrientedBounds& box) {
    const glm::dvec3 t(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0),
                       random.uniform(0.0, 1.0));
    return glm::dvec3(box.world_from_local * glm::dvec4(glm::mix(box.min, box.max, t), 1.0));
}

bool holds(const OrientedBounds& box, const glm::dvec3& p) {
    const glm::dvec3 local(glm::inverse(box.world_from_local) * glm::dvec4(p, 1.0));
    return glm::all(glm::greaterThanEqual(local, box.min)) &&
           glm::all(glm::lessThanEqual(local, box.max));
}

Light random_light(Random& random, double spread) {
    Light light;
    light.position_world = random.chance(0.4)
                               ? glm::dvec4(random.unit_vector() * random.uniform(0.1, 9.0), 0.0)
                               : glm::dvec4(random.in_cube(spread), 1.0);
    if (light.position_world.w != 0.0 && random.chance(0.3)) {
        light.range_m = random.uniform(1.0, 2.0 * spread);
    }
    return light;
}

// From a point of the caster on, away from the light.
glm::dvec3 behind(const Light& light, const glm::dvec3& p, double t) {
    const glm::dvec3 l(light.position_world);
    return light.position_world.w == 0.0 ? p - t * l : p + t * (p - l);
}

bool lights(const Light& light, const glm::dvec3& p) {
    return !light.range_m || glm::length(p - glm::dvec3(light.position_world)) <= *light.range_m;
}

View random_view(Random& random) {
    View view;
    glm::dvec3 eye = random.in_cube(15.0);
    view.view_from_world = look_at(eye, random.in_cube(6.0), random.unit_vector());
    switch (random.below(3)) {
        case 0:
            view.clip_from_view = infinite_perspective(random.uniform(0.3, 2.0), 1.6, 0.05);
            break;
        case 1:
            view.projection = ProjectionKind::FinitePerspective;
            view.clip_from_view = finite_perspective(random.uniform(0.3, 2.0), 1.6, 0.05, 60.0);
            break;
        default:
            view.projection = ProjectionKind::Orthographic;
            view.clip_from_view = orthographic(6.0, 4.0, -30.0, 30.0);
    }
    return view;
}

// What is in the picture, if it is.
std::optional<glm::dvec2> place_of(const View& view, const glm::dvec3& p) {
    const glm::dvec4 clip = view.clip_from_world() * glm::dvec4(p, 1.0);
    if (clip.w <= 0.0 || clip.z > clip.w) return std::nullopt;
    const glm::dvec2 place(clip.x / clip.w, clip.y / clip.w);
    if (std::abs(place.x) > 1.0 || std::abs(place.y) > 1.0) return std::nullopt;
    return place;
}

float depth_of(const View& view, const glm::dvec3& p) {
    const glm::dvec4 clip = view.clip_from_world() * glm::dvec4(p, 1.0);
    return std::clamp(static_cast<float>(clip.z / clip.w), 0.0F, 1.0F);
}

// Of a shadowed point of a receiver.
void expect_outside_of(const Gaps& gaps, double along, const glm::dvec3& p) {
    std::size_t part = 0;
    while (part < gaps.count && gaps.gaps[part].low + 1e-9 < along) {
        ASSERT_GE(along, gaps.gaps[part].high - 1e-9);
        ++part;
    }
    ASSERT_FALSE(gaps.first && part == 0);
    const Aabb& box = gaps.boxes[part];
    ASSERT_TRUE((Aabb{box.low - 1e-9, box.high + 1e-9}.holds({p, p})));
}

TEST(Reach, NoShadowedPointOfAReceiverIsBeyondThePlaneOrOutsideTheScissor) {
    GNOMON_RANDOM(random);
    std::uint64_t in_shadow = 0;
    std::uint64_t clamped = 0;
    std::uint64_t seen = 0;
    std::uint64_t cut = 0;
    std::uint64_t bounded = 0;
    std::uint64_t about_gaps = 0;
    for (int scene = 0; scene < 4'000; ++scene) {
        const OrientedBounds caster = random_box(random, 1.5, 4.0);
        const Light light = random_light(random, 8.0);
        std::vector<OrientedBounds> receivers;
        std::vector<Aabb> boxes;
        for (std::uint32_t i = random.below(12) + 1; i > 0; --i) {
            receivers.push_back(random_box(random, 4.0, 10.0));
            boxes.push_back(aabb_of(receivers.back()));
        }
        ReceiverTree tree;
        tree.build(boxes);
        const View view = random_view(random);
        const Screen screen(view);
        const FillTerms terms{{.slabs = true}, &tree, &screen};
        const ShadowHull hull(caster, light);
        const Reach reach = terms.reach(hull);
        const double plane = plane_distance(reach, screen.eye());
        const ScreenBounds bounds = screen.of(hull, reach, plane);
        const DepthBounds depth = screen.depth_of(hull, reach, plane);
        bounded += depth.everything() ? 0 : 1;
        const bool hidden = shown_of(terms, hull, reach).hidden != Hidden::No;
        clamped += reach.clamped ? 1 : 0;
        cut += bounds.everything() || bounds.empty() ? 0 : 1;
        for (int ray = 0; ray < 1'000; ++ray) {
            // Through a point of a receiver, or of the caster.
            const glm::dvec3 c = point_in(random, caster);
            const glm::dvec3 p = behind(light, c, std::pow(10.0, random.uniform(-2.0, 1.5)));
            bool received = false;
            for (const OrientedBounds& box : receivers) received = received || holds(box, p);
            if (!received || !lights(light, p)) continue;
            ++in_shadow;
            ASSERT_TRUE(reach.any) << scene;
            if (reach.clamped) {
                ASSERT_LT(glm::dot(reach.normal, p), plane) << scene;
            }
            if (reach.gaps != nullptr) {
                ++about_gaps;
                expect_outside_of(*reach.gaps, glm::dot(reach.normal, p), p);
                if (HasFatalFailure()) FAIL() << scene;
            }
            const auto place = place_of(view, p);
            if (!place) continue;
            ++seen;
            ASSERT_FALSE(hidden) << scene;
            ASSERT_GE(place->x, bounds.min.x) << scene;
            ASSERT_LE(place->x, bounds.max.x) << scene;
            ASSERT_GE(place->y, bounds.min.y) << scene;
            ASSERT_LE(place->y, bounds.max.y) << scene;
            const float stored = depth_of(view, p);
            ASSERT_GE(stored, depth.min) << scene;
            ASSERT_LE(stored, depth.max) << scene;
        }
    }
    // All of it was put to the test.
    EXPECT_GT(in_shadow, 5'000U);
    EXPECT_GT(seen, 1'000U);
    EXPECT_GT(clamped, 2'000U);
    EXPECT_GT(cut, 500U);
    EXPECT_GT(bounded, 500U);
    EXPECT_GT(about_gaps, 500U);
}

TEST(Reach, AVolumeThatEndsOnThePlaneIsWithinTheScissorWhole) {
    GNOMON_RANDOM(random);
    std::uint64_t seen = 0;
    for (int scene = 0; scene < 4'000; ++scene) {
        const OrientedBounds caster = random_box(random, 1.5, 4.0);
        const Light light = random_light(random, 8.0);
        ReceiverTree everywhere;
        everywhere.build(std::array{Aabb{glm::dvec3(-30.0), glm::dvec3(30.0)}});
        const View view = random_view(random);
        const Screen screen(view);
        const ShadowHull hull(caster, light);
        const Reach reach = reach_of(hull, &everywhere, {});
        if (!reach.clamped) continue;
        const double plane = plane_distance(reach, screen.eye());
        const ScreenBounds bounds = screen.of(hull, reach, plane);
        for (int ray = 0; ray < 60; ++ray) {
            const glm::dvec3 p =
                behind(light, point_in(random, caster), std::pow(10.0, random.uniform(-2.0, 1.5)));
            const bool received = glm::all(glm::lessThan(glm::abs(p), glm::dvec3(30.0)));
            if (glm::dot(reach.normal, p) > plane || !received || !lights(light, p)) continue;
            const auto place = place_of(view, p);
            if (!place) continue;
            ++seen;
            ASSERT_GE(place->x, bounds.min.x) << scene;
            ASSERT_LE(place->x, bounds.max.x) << scene;
            ASSERT_GE(place->y, bounds.min.y) << scene;
            ASSERT_LE(place->y, bounds.max.y) << scene;
        }
    }
    EXPECT_GT(seen, 5'000U);
}

TEST(Reach, TheProjectionTakesPointsAlongTheirRaysToThePlane) {
    GNOMON_RANDOM(random);
    std::uint64_t points = 0;
    for (int scene = 0; scene < 2'000; ++scene) {
        const OrientedBounds caster = random_box(random, 1.5, 4.0);
        Light light = random_light(random, 8.0);
        light.range_m.reset();
        ReceiverTree somewhere;
        somewhere.build(std::array{aabb_of(random_box(random, 4.0, 9.0))});
        const ShadowHull hull(caster, light);
        const Reach reach = reach_of(hull, &somewhere, {});
        if (!reach.clamped) continue;
        const double distance = plane_distance(reach, {0.0, 3.0, 9.0});
        // In the caster's own space, as it is drawn.
        const glm::dmat4 local_from_world = glm::inverse(caster.world_from_local);
        const glm::dmat4 project =
            projection_onto(plane_in(caster.world_from_local, reach.normal, distance),
                            local_from_world * light.position_world);
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 p = point_in(random, caster);
            const glm::dvec4 projected =
                caster.world_from_local * project * local_from_world * glm::dvec4(p, 1.0);
            ASSERT_GT(projected.w, 0.0) << "in front of the light";
            const glm::dvec3 far = glm::dvec3(projected) / projected.w;
            const double size = glm::length(far) + std::abs(distance) + 10.0;
            ASSERT_NEAR(glm::dot(reach.normal, far), distance, 1e-9 * size);
            const glm::dvec3 way = behind(light, p, 1.0) - p;
            const glm::dvec3 went = far - p;
            ASSERT_GT(glm::dot(way, went), 0.0) << "away from the light";
            ASSERT_LT(glm::length(glm::cross(glm::normalize(way), went)), 1e-8 * size);
            ++points;
        }
    }
    EXPECT_GT(points, 10'000U);
}

TEST(Reach, AGroundEndsTheShadowsOfWhatStandsOnIt) {
    const OrientedBounds pillar{glm::dmat4(1.0), {-0.5, 0.0, -0.5}, {0.5, 4.0, 0.5}};
    ReceiverTree tree;
    tree.build(
        std::array{Aabb{{-100, -0.1, -100}, {100, 0, 100}}, Aabb{{-0.5, 0, -0.5}, {0.5, 4, 0.5}}});
    for (const glm::dvec4& light : {glm::dvec4(1, 2, 1, 0), glm::dvec4(8, 6, 3, 1)}) {
        const Reach reach = reach_of({pillar, {.position_world = light}}, &tree, {});
        ASSERT_TRUE(reach.clamped);
        EXPECT_EQ(reach.normal, glm::dvec3(0, -1, 0));
        EXPECT_NEAR(reach.distance, 0.1, 1e-6);
        EXPECT_LT(plane_distance(reach, {0, 2, 0}) - reach.distance, 0.02);
    }
    // A lamp within the caster, or beside it and all but touching.
    EXPECT_FALSE(reach_of({pillar, {.position_world = {0, 1, 0, 1}}}, &tree, {}).clamped);
    EXPECT_FALSE(reach_of({pillar, {.position_world = {0, 1, 0.5001, 1}}}, &tree, {}).clamped);
    // A lamp below shines up, where nothing is.
    const Reach up = reach_of({pillar, {.position_world = {0, -9, 0, 1}}}, &tree, {});
    EXPECT_TRUE(up.any) << "the pillar itself";
    EXPECT_LT(up.distance, 4.1);
}

TEST(Reach, DepthsOfAShadowOnTheGroundAreThoseThatItLiesAt) {
    // 4 m high, seen from 10 m; the light comes from over the eye's shoulder, and the shadow ends
    // 4 m behind, on the ground.
    const OrientedBounds pillar{glm::dmat4(1.0), {-0.5, 0.0, -0.5}, {0.5, 4.0, 0.5}};
    ReceiverTree tree;
    tree.build(
        std::array{Aabb{{-100, -0.1, -100}, {100, 0, 100}}, Aabb{{-0.5, 0, -0.5}, {0.5, 4, 0.5}}});
    const ShadowHull hull(pillar, {.position_world = {0, 1, 1, 0}});
    const Reach reach = reach_of(hull, &tree, {});
    const auto bounds_in = [&](const glm::dmat4& clip_from_view, ProjectionKind kind) {
        const View view{.view_from_world = look_at({0, 2, 10}, {0, 2, 0}, {0, 1, 0}),
                        .clip_from_view = clip_from_view,
                        .projection = kind};
        const Screen screen(view);
        return screen.depth_of(hull, reach, plane_distance(reach, screen.eye()));
    };
    // Rounded outward to the next eighth of an octave.
    const DepthBounds infinite =
        bounds_in(infinite_perspective(0.8, 1.5, 0.1), ProjectionKind::InfinitePerspective);
    EXPECT_LE(infinite.max, 0.1 / 9.5 * 1.13);
    EXPECT_GE(infinite.max, 0.1 / 9.5);
    EXPECT_LE(infinite.min, 0.1 / 14.6);
    EXPECT_GE(infinite.min, 0.1 / 14.6 * 0.86);
    const DepthBounds flat = bounds_in(orthographic(9, 6, 0.0, 20.0), ProjectionKind::Orthographic);
    EXPECT_NEAR(flat.max, 10.5 / 20.0, 0.08);
    EXPECT_NEAR(flat.min, 5.4 / 20.0, 0.05);
    const DepthBounds finite =
        bounds_in(finite_perspective(0.8, 1.5, 0.1, 12.0), ProjectionKind::FinitePerspective);
    EXPECT_EQ(finite.min, 0.0F) << "it ends before the shadow does";
    // An oblique near plane: depth is no matter of distance.
    glm::dmat4 oblique = infinite_perspective(0.8, 1.5, 0.1);
    oblique[0][2] = 0.1;
    EXPECT_TRUE(bounds_in(oblique, ProjectionKind::InfinitePerspective).everything());
}

TEST(ScreenBounds, ArePixelsOfATarget) {
    EXPECT_EQ(pixels_of({}, 640, 480), (PixelRect{0, 0, 640, 480}));
    EXPECT_EQ(pixels_of(ScreenBounds::nothing(), 640, 480), PixelRect{});
    // The upper right quarter, and two pixels more; row 0 is on top.
    EXPECT_EQ(pixels_of({{0.0F, 0.0F}, {1.0F, 1.0F}}, 640, 480), (PixelRect{318, 0, 322, 242}));
    EXPECT_EQ(pixels_of({{0.0F, 0.0F}, {1.0F, 1.0F}}, 0, 0), PixelRect{});
    EXPECT_TRUE(intersection({{-1, -1}, {0, 0}}, {{0, -1}, {1, 1}}).empty());
    EXPECT_EQ(united(ScreenBounds::nothing(), {{-1, -1}, {0, 0}}),
              (ScreenBounds{{-1, -1}, {0, 0}}));
}

}  // namespace
}  // namespace gnomon::shadows::internal
