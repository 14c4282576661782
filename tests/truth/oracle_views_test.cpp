// SPDX-License-Identifier: MIT
//
// The oracle's cameras: every projection there is, against rays computed without a matrix; and what
// it says of bad or empty input.
#include <gnomon/scene/scene.hpp>
#include <gnomon/scene/transforms.hpp>

#include "tests/truth/oracle_fixture.hpp"

namespace gnomon::truth {
namespace {

constexpr glm::dvec3 disc_centre(0.0, 1.0, 0.0);

/// A square sheet at height 1, half a metre each way, over the ground; the light comes straight
/// down but for a slant, so a place on the ground is dark where (x + slant, z) lies in the square.
constexpr double slant = 0.8;
std::vector<Shape> sheet_over_ground(bool sheet_is_drawn) {
    return {{scene::make_plane(60.0F, 60.0F)},
            {scene::make_plane(1.0F, 1.0F), at(0.0, 1.0, 0.0), true, sheet_is_drawn}};
}
shadows::Light slanted_sun() { return sun({slant, 1.0, 0.0}); }
bool is_dark(const glm::dvec3& ground) {
    return std::abs(ground.x + slant) < 0.5 && std::abs(ground.z) < 0.5;
}

template <class RayOf>
void expect_sheet_shadow(const Picture& picture, RayOf&& ray_of) {
    expect_telling(picture, 0.04);
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            const Verdict verdict = picture.verdicts[std::size_t{y} * picture.width + x];
            if (verdict != Verdict::Lit && verdict != Verdict::Shadowed) continue;
            const Ray ray = ray_of(glm::dvec2(x, y) + 0.5);
            const glm::dvec3 place = ray.from - ray.from.y / ray.along.y * ray.along;
            EXPECT_EQ(verdict, is_dark(place) ? Verdict::Shadowed : Verdict::Lit) << x << ' ' << y;
        }
    }
}

TEST(OracleViews, Orthographic) {
    // Straight from the side and above: right = +X, up = the bisector of +Y and -Z.
    const double half_width = 2.0;
    const double half_height = 1.5;
    const shadows::View view{
        .view_from_world = shadows::look_at({0.0, 5.0, 5.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}),
        .clip_from_view = shadows::orthographic(half_width, half_height, -1.0, 60.0),
        .projection = shadows::ProjectionKind::Orthographic};
    const Options options{.width = 160, .height = 120};
    const Picture picture =
        picture_of(sheet_over_ground(false), view, slanted_sun(), options, {0.0, 5.0, 5.0});
    const double s = std::sqrt(0.5);
    expect_sheet_shadow(picture, [&](const glm::dvec2& pixels) {
        const double x = (2.0 * pixels.x / options.width - 1.0) * half_width;
        const double y = (1.0 - 2.0 * pixels.y / options.height) * half_height;
        return Ray{glm::dvec3(x, 5.0 + s * y, 5.0 - s * y), {0.0, -s, -s}};
    });
}

TEST(OracleViews, OrthographicPlanesEndTheWorld) {
    // From five metres straight above the ground.
    const auto seen = [](double near_m, double far_m) {
        const shadows::View view{
            .view_from_world = shadows::look_at({0.0, 5.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}),
            .clip_from_view = shadows::orthographic(2.0, 1.5, near_m, far_m),
            .projection = shadows::ProjectionKind::Orthographic};
        return count(
            picture_of(sheet_over_ground(false), view, slanted_sun(), {.width = 80, .height = 60}));
    };
    constexpr std::size_t all = 80 * 60;
    EXPECT_GT(seen(0.0, 5.01).shadowed, 100U);
    EXPECT_EQ(seen(0.0, 4.99).unjudged, all);
    EXPECT_GT(seen(4.99, 9.0).shadowed, 100U);
    EXPECT_EQ(seen(5.01, 9.0).unjudged, all);
    // On either plane, and as near to it as makes no difference in single precision.
    for (const double rounding : {-1e-8, 0.0, 1e-8}) {
        EXPECT_EQ(seen(0.0, 5.0 + rounding).band, all) << rounding;
        EXPECT_EQ(seen(5.0 + rounding, 9.0).band, all) << rounding;
    }
}

TEST(OracleViews, OffAxis) {
    const glm::dvec3 eye(0.5, 3.0, 4.0);
    const glm::dvec3 target(0.0, 0.0, 0.0);
    const double near_m = 0.1;
    const glm::dvec4 window(-0.09, 0.03, -0.05, 0.04);  // left, right, bottom, top
    const shadows::View view{
        .view_from_world = shadows::look_at(eye, target, {0.0, 1.0, 0.0}),
        .clip_from_view = shadows::infinite_frustum(window.x, window.y, window.z, window.w, near_m),
        .projection = shadows::ProjectionKind::InfinitePerspective};
    const Options options{.width = 160, .height = 120};
    const Picture picture = picture_of(sheet_over_ground(false), view, slanted_sun(), options, eye);
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 up = glm::cross(right, forward);
    expect_sheet_shadow(picture, [&](const glm::dvec2& pixels) {
        const double x = window.x + (window.y - window.x) * pixels.x / options.width;
        const double y = window.w + (window.z - window.w) * pixels.y / options.height;
        return Ray{eye, near_m * forward + x * right + y * up};
    });
}

TEST(OracleViews, FinitePerspectiveIsTheInfiniteOneUpToItsFarPlane) {
    const Pinhole camera;
    shadows::View finite = camera.view();
    finite.projection = shadows::ProjectionKind::FinitePerspective;
    finite.clip_from_view =
        shadows::finite_perspective(camera.fovy_rad, camera.aspect(), camera.near_m, 7.0);
    const auto world = sheet_over_ground(true);
    const Picture near = picture_of(world, finite, slanted_sun(), camera.options());
    const Picture all = picture_of(world, camera.view(), slanted_sun(), camera.options());
    expect_telling(near, 0.04);
    std::size_t beyond = 0;
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    for (std::uint32_t y = 0; y < near.height; ++y) {
        for (std::uint32_t x = 0; x < near.width; ++x) {
            const std::size_t i = std::size_t{y} * near.width + x;
            const Ray ray = camera.ray(glm::dvec2(x, y) + 0.5);
            const glm::dvec3 way = -ray.from.y / ray.along.y * ray.along;
            const bool ground_is_near = ray.along.y < 0.0 && glm::dot(way, forward) < 6.95;
            if (ground_is_near) {
                EXPECT_EQ(near.verdicts[i], all.verdicts[i]);
            } else if (near.verdicts[i] == Verdict::Unjudged &&
                       all.verdicts[i] != Verdict::Unjudged) {
                ++beyond;
            }
        }
    }
    EXPECT_GT(beyond, 1000U);
}

TEST(OracleViews, ASurfaceInFrontOfTheNearPlaneIsNotSeenButShadows) {
    // A sheet right before the camera, wider than the view; the light comes from behind the camera.
    const auto seen = [](double sheet_distance) {
        Pinhole camera{.eye = {0.0, 3.0, 0.0}, .target = {0.0, 0.0, -0.3}, .near_m = 0.5};
        const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
        const glm::dvec3 place = camera.eye + sheet_distance * forward;
        const double tilt = std::atan2(-forward.z, -forward.y);
        const glm::dmat4 facing =
            glm::rotate(at(place.x, place.y, place.z), tilt, glm::dvec3(1.0, 0.0, 0.0));
        return count(
            picture_of({{scene::make_plane(20.0F, 20.0F)}, {scene::make_plane(1.0F, 1.0F), facing}},
                       camera.view(), sun({0.0, 1.0, 0.05}), camera.options(), camera.eye));
    };
    const Counts before = seen(0.49);
    EXPECT_GT(before.shadowed, 1000U);  // looking through it at its own shadow
    EXPECT_GT(before.lit, 100U);
    EXPECT_LT(before.band, 900U);
    const Counts beyond = seen(0.51);
    EXPECT_EQ(beyond.shadowed, 0U);
    EXPECT_GT(beyond.lit, 15000U);
    const Counts on = seen(0.5);  // exactly on it: whether it is seen is rounding
    EXPECT_EQ(on.shadowed, 0U);
    EXPECT_GT(on.band, 1000U);
    const Counts rounded = seen(0.5 - 1e-8);  // nor does less than a float's rounding tell
    EXPECT_EQ(rounded.shadowed, 0U);
    EXPECT_GT(rounded.band, 1000U);
}

TEST(OracleViews, InsideAClosedBox) {
    // The camera and the lamp in one room with a crate: everything in view faces the lamp or is a
    // face of the crate.
    const Pinhole camera{.eye = {1.5, 1.0, 1.5}, .target = {0.0, -0.6, 0.0}, .fovy_rad = 1.2};
    const std::vector<Shape> room{{scene::make_box({4.0F, 3.0F, 4.0F})},
                                  {scene::make_box({0.6F, 0.6F, 0.6F}), at(-0.2, -0.9, -0.3)}};
    const glm::dvec3 place(0.9, 1.2, -1.1);
    const Picture picture = picture_of(room, camera.view(), lamp(place), camera.options());
    expect_telling(picture, 0.03);
    const BruteForce brute(room);
    each_judged(camera, picture,
                [&](std::uint32_t x, std::uint32_t y, Verdict verdict, const Ray& ray) {
                    EXPECT_EQ(verdict, brute.verdict(ray, lamp(place))) << x << ' ' << y;
                });

    // With the lamp outside, nothing inside is lit.
    const Counts dark =
        count(picture_of(room, camera.view(), lamp({0.0, 9.0, 0.5}), camera.options()));
    EXPECT_EQ(dark.lit, 0U);
    EXPECT_GT(dark.shadowed, 3000U);
}

TEST(OracleViews, ASheetSeenFromBothSides) {
    // The light is above: seen from above the sheet is lit, from below it is averted.
    const shadows::Light light = slanted_sun();
    const Pinhole above;
    const Picture from_above =
        picture_of(sheet_over_ground(true), above.view(), light, above.options());
    const Pinhole below{.eye = {0.0, 0.3, 3.0}, .target = {0.0, 1.0, 0.0}};
    const Picture from_below =
        picture_of(sheet_over_ground(true), below.view(), light, below.options());
    expect_telling(from_above, 0.05);
    const auto centre = [](const Pinhole& camera, const Picture& picture) {
        // The pixel in which the sheet's middle appears.
        const glm::dvec4 clip = camera.view().clip_from_world() * glm::dvec4(disc_centre, 1.0);
        const auto x = static_cast<std::size_t>((clip.x / clip.w * 0.5 + 0.5) * camera.width);
        const auto y = static_cast<std::size_t>((0.5 - clip.y / clip.w * 0.5) * camera.height);
        return picture.verdicts[y * camera.width + x];
    };
    EXPECT_EQ(centre(above, from_above), Verdict::Lit);
    EXPECT_EQ(centre(below, from_below), Verdict::Unjudged);
}

TEST(OracleViews, NothingToSeeIsNothingToJudge) {
    const Pinhole camera;
    EXPECT_EQ(count(picture_of({}, camera.view(), slanted_sun(), camera.options())).unjudged,
              std::size_t{camera.width} * camera.height);
    EXPECT_TRUE(picture_of({}, camera.view(), slanted_sun(), {}).verdicts.empty());
    const Counts no_receiver =
        count(picture_of({{scene::make_plane(9.0F, 9.0F), at(0, 0, 0), true, false}}, camera.view(),
                         slanted_sun(), camera.options()));
    EXPECT_EQ(no_receiver.unjudged, std::size_t{camera.width} * camera.height);
    const Counts no_caster =
        count(picture_of({{scene::make_plane(9.0F, 9.0F), at(0, 0, 0), false, true}}, camera.view(),
                         slanted_sun(), camera.options()));
    EXPECT_EQ(no_caster.shadowed, 0U);
    EXPECT_GT(no_caster.lit, 1000U);
}

TEST(OracleViews, BadInputIsRefusedInOneSentence) {
    const auto message = [](const scene::Mesh& mesh, const glm::dmat4& pose = glm::dmat4(1.0)) {
        const auto tracer = Tracer::build(instances_of({{mesh, pose}}), glm::dvec3(0.0));
        return tracer ? std::string() : tracer.error().message;
    };
    const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(message(mesh_of(corners, {0, 1, 2})), "");
    EXPECT_EQ(message(mesh_of(corners, {0, 1, 3})),
              "Instance 0 has index 3 at place 2, but only 3 positions.");
    EXPECT_EQ(message(mesh_of(corners, {0, 1})),
              "Instance 0 has 2 indices, which is not a multiple of three.");
    glm::dmat4 broken(1.0);
    broken[3][1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(message(mesh_of(corners, {0, 1, 2}), broken),
              "Instance 0 has position 0 at (0, 0, 0), which its pose takes to (0, nan, 0), "
              "farther than 1e+18 m from the origin.");
}

TEST(OracleViews, ASceneGivesItsCastersAndReceivers) {
    scene::Scene scene;
    const auto add = [&](const scene::Mesh& mesh, double y, bool casts, bool receives) {
        const scene::Entity node =
            scene.create_node("node", {.translation = glm::dvec3(0.0, y, 0.0)});
        scene.registry.emplace<scene::MeshInstance>(node,
                                                    std::make_shared<const scene::Mesh>(mesh));
        if (casts) scene.registry.emplace<scene::Caster>(node);
        if (receives) scene.registry.emplace<scene::Receiver>(node);
    };
    scene::Mesh sheet = scene::make_plane(1.0F, 1.0F);
    sheet.origin = {0.0, 0.25, 0.0};
    add(scene::make_plane(60.0F, 60.0F), 0.0, false, true);
    add(sheet, 0.75, true, false);
    add(scene::make_box({1.0F, 1.0F, 1.0F}), 5.0, false, false);
    scene::update_world_transforms(scene.registry);

    const std::vector<Instance> instances = instances_of(scene);
    ASSERT_EQ(instances.size(), 2U);
    EXPECT_FALSE(instances[0].casts);
    EXPECT_TRUE(instances[0].receives);
    EXPECT_TRUE(instances[1].casts);
    EXPECT_FALSE(instances[1].receives);
    const Pinhole camera;
    const auto tracer = Tracer::build(instances, camera.eye);
    ASSERT_TRUE(tracer);
    expect_sheet_shadow(tracer->trace(camera.view(), slanted_sun(), camera.options()),
                        [&](const glm::dvec2& pixels) { return camera.ray(pixels); });
}

}  // namespace
}  // namespace gnomon::truth
