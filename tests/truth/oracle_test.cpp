// SPDX-License-Identifier: MIT
//
// The oracle against answers that are known without it: closed forms, and a brute-force ray caster.
#include "tests/truth/oracle_fixture.hpp"

namespace gnomon::truth {
namespace {

/// Where a ray enters a box; nothing if it misses. Slabs.
std::optional<std::pair<double, double>> through_box(const Ray& ray, const glm::dvec3& min,
                                                     const glm::dvec3& max) {
    const glm::dvec3 a = (min - ray.from) / ray.along;
    const glm::dvec3 b = (max - ray.from) / ray.along;
    const glm::dvec3 in = glm::min(a, b);
    const glm::dvec3 out = glm::max(a, b);
    const double enter = std::max({in.x, in.y, in.z});
    const double leave = std::min({out.x, out.y, out.z});
    if (enter > leave) return std::nullopt;
    return std::pair{enter, leave};
}

/// Where a ray meets a sphere round `centre`.
std::optional<double> to_sphere(const Ray& ray, const glm::dvec3& centre, double radius) {
    const glm::dvec3 from = ray.from - centre;
    const double a = glm::dot(ray.along, ray.along);
    const double b = glm::dot(ray.along, from);
    const double c = glm::dot(from, from) - radius * radius;
    const double root = b * b - a * c;
    if (root < 0.0) return std::nullopt;
    return (-b - std::sqrt(root)) / a;
}

std::vector<Shape> box_over_ground() {
    return {{scene::make_plane(40.0F, 40.0F)}, {scene::make_box({1.0F, 0.5F, 0.75F}), at(0, 1, 0)}};
}

void expect_box_shadow(const Pinhole& camera, const Picture& picture, const shadows::Light& light) {
    const glm::dvec3 min(-0.5, 0.75, -0.375);
    const glm::dvec3 max(0.5, 1.25, 0.375);
    expect_telling(picture, 0.03);
    each_judged(
        camera, picture, [&](std::uint32_t x, std::uint32_t y, Verdict verdict, const Ray& ray) {
            if (through_box(ray, min, max)) {
                EXPECT_EQ(verdict, Verdict::Lit) << x << ' ' << y;  // a convex body's lit faces
                return;
            }
            const glm::dvec3 place = ray.from - ray.from.y / ray.along.y * ray.along;
            const glm::dvec3 to_light =
                glm::dvec3(light.position_world) - light.position_world.w * place;
            const auto span = through_box({place, to_light}, min, max);
            const bool dark =
                span && span->first > 0.0 && (light.position_world.w == 0.0 || span->first < 1.0);
            EXPECT_EQ(verdict, dark ? Verdict::Shadowed : Verdict::Lit) << x << ' ' << y;
        });
}

TEST(Oracle, BoxUnderTheSun) {
    const Pinhole camera;
    const shadows::Light light = sun({0.4, 1.0, -0.3});
    expect_box_shadow(camera, picture_of(box_over_ground(), camera.view(), light, camera.options()),
                      light);
}

TEST(Oracle, BoxUnderALamp) {
    const Pinhole camera;
    const shadows::Light light = lamp({0.7, 2.5, -0.4});
    expect_box_shadow(camera, picture_of(box_over_ground(), camera.view(), light, camera.options()),
                      light);
}

TEST(Oracle, BoxFromAfar) {
    const Pinhole camera{.eye = {30.0, 8.0, 50.0}, .target = {0.0, 0.5, 0.0}, .fovy_rad = 0.06};
    const shadows::Light light = lamp({300.0, 4000.0, 2000.0});
    expect_box_shadow(camera, picture_of(box_over_ground(), camera.view(), light, camera.options()),
                      light);
}

// A UV sphere lies between two spheres: of its radius, and of its radius times the cosines of half
// a slice and half a stack. Pixels on which these two agree are known.
void expect_sphere_shadow(const shadows::Light& light) {
    const Pinhole camera{.eye = {1.0, 3.0, 5.0}};
    const glm::dvec3 centre(0.0, 1.2, 0.0);
    const double outer = 0.8;
    const double inner = outer * std::pow(std::cos(std::numbers::pi / 64.0), 2.0);
    const std::vector<Shape> world{{scene::make_plane(40.0F, 40.0F)},
                                   {scene::make_sphere(0.8F, 64, 64), at(0.0, 1.2, 0.0)}};
    const Picture picture = picture_of(world, camera.view(), light, camera.options());
    expect_telling(picture, 0.03);
    std::size_t known = 0;
    each_judged(
        camera, picture, [&](std::uint32_t x, std::uint32_t y, Verdict verdict, const Ray& ray) {
            if (to_sphere(ray, centre, inner)) {
                EXPECT_EQ(verdict, Verdict::Lit) << x << ' ' << y;
                return;
            }
            if (to_sphere(ray, centre, outer)) return;
            const glm::dvec3 place = ray.from - ray.from.y / ray.along.y * ray.along;
            const Ray shadow{place,
                             glm::dvec3(light.position_world) - light.position_world.w * place};
            const auto dark = [&](double radius) {
                const std::optional<double> t = to_sphere(shadow, centre, radius);
                return t && *t > 0.0 && (light.position_world.w == 0.0 || *t < 1.0);
            };
            if (dark(inner) != dark(outer)) return;
            ++known;
            EXPECT_EQ(verdict, dark(inner) ? Verdict::Shadowed : Verdict::Lit) << x << ' ' << y;
        });
    EXPECT_GT(known, 5000U);
}

TEST(Oracle, SphereUnderTheSun) { expect_sphere_shadow(sun({-0.3, 1.0, 0.2})); }
TEST(Oracle, SphereUnderALamp) { expect_sphere_shadow(lamp({1.0, 4.0, 0.5})); }

TEST(Oracle, HalfPlaneHasAStraightEdge) {
    // A huge sheet at height 1 that ends at x = 0; the light slants along x: the edge falls on x
    // = 1.
    const std::vector<Shape> world{
        {scene::make_plane(100.0F, 100.0F)},
        {scene::make_plane(1000.0F, 1000.0F), at(-500.0, 1.0, 0.0), true, false}};
    const Pinhole camera{.eye = {1.0, 3.0, 3.0}, .target = {1.0, 0.0, 0.0}};
    const Picture picture =
        picture_of(world, camera.view(), sun({-1.0, 1.0, 0.0}), camera.options());
    expect_telling(picture, 0.02);
    each_judged(
        camera, picture, [&](std::uint32_t x, std::uint32_t y, Verdict verdict, const Ray& ray) {
            const glm::dvec3 place = ray.from - ray.from.y / ray.along.y * ray.along;
            EXPECT_EQ(verdict, place.x < 1.0 ? Verdict::Shadowed : Verdict::Lit) << x << ' ' << y;
        });
}

/// Triangles at random, all of them casters and receivers.
std::vector<Shape> soup(unsigned seed, std::size_t triangles, float size) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-2.0F, 2.0F);
    std::uniform_real_distribution<float> spread(-size, size);
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < triangles; ++i) {
        const glm::vec3 middle(place(random), place(random), place(random));
        for (int k = 0; k < 3; ++k) {
            indices.push_back(static_cast<std::uint32_t>(positions.size()));
            positions.push_back(middle + glm::vec3(spread(random), spread(random), spread(random)));
        }
    }
    return {{mesh_of(std::move(positions), std::move(indices)),
             glm::rotate(at(0.1, 0.2, -0.3), 0.7, glm::dvec3(1.0, 2.0, -0.5))},
            {scene::make_plane(30.0F, 30.0F), at(0.0, -2.5, 0.0)}};
}

/// Whether brute force gives one and the same verdict at the centre and all over the neighbourhood.
bool agrees_everywhere(const BruteForce& brute, const Pinhole& camera, const shadows::Light& light,
                       const glm::dvec2& centre, double radius_px, Verdict expected,
                       std::mt19937& random, int samples) {
    std::uniform_real_distribution<double> jitter(-radius_px, radius_px);
    if (brute.verdict(camera.ray(centre), light) != expected) return false;
    for (int i = 0; i < samples; ++i) {
        const glm::dvec2 offset(jitter(random), jitter(random));
        if (brute.verdict(camera.ray(centre + offset), light) != expected) return false;
    }
    return true;
}

void expect_brute_force_agrees(const std::vector<Shape>& world, const shadows::Light& light,
                               double most_band) {
    const Pinhole camera{.width = 96, .height = 72};
    const BruteForce brute(world);
    const Picture picture = picture_of(world, camera.view(), light, camera.options());
    expect_telling(picture, most_band);
    std::mt19937 random(7);
    std::size_t undecided = 0;
    std::size_t undecided_rightly = 0;
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            const Verdict verdict = picture.verdicts[std::size_t{y} * picture.width + x];
            const glm::dvec2 centre = glm::dvec2(x, y) + 0.5;
            if (verdict != Verdict::Band) {
                EXPECT_TRUE(
                    agrees_everywhere(brute, camera, light, centre, 1.0 / 16.0, verdict, random, 8))
                    << x << ' ' << y << " verdict " << static_cast<int>(verdict);
                continue;
            }
            ++undecided;
            const Verdict middle = brute.verdict(camera.ray(centre), light);
            const bool rightly =
                brute.has_silhouette(camera, light, centre, 0.07) ||
                !agrees_everywhere(brute, camera, light, centre, 0.07, middle, random, 100);
            undecided_rightly += rightly ? 1U : 0U;
        }
    }
    // The band holds what it must and little more.
    EXPECT_GT(undecided, 0U);
    EXPECT_GT(static_cast<double>(undecided_rightly), 0.7 * static_cast<double>(undecided))
        << undecided_rightly << " of " << undecided;
}

TEST(Oracle, BruteForceAgreesOnRandomTrianglesUnderTheSun) {
    expect_brute_force_agrees(soup(1, 200, 0.8F), sun({0.5, 1.0, 0.3}), 0.25);
}
TEST(Oracle, BruteForceAgreesOnRandomTrianglesUnderALamp) {
    expect_brute_force_agrees(soup(2, 200, 0.8F), lamp({0.4, 2.8, 1.1}), 0.25);
}
TEST(Oracle, BruteForceAgreesOnSplinters) {
    expect_brute_force_agrees(soup(3, 600, 0.15F), sun({-0.5, 1.0, 0.3}), 0.25);
}
TEST(Oracle, BruteForceAgreesOnATorusKnot) {
    expect_brute_force_agrees({{scene::make_torus_knot(1.2F, 0.3F, 2, 3, 48, 8)},
                               {scene::make_plane(30.0F, 30.0F), at(0.0, -1.5, 0.0)}},
                              lamp({1.0, 4.0, 2.0}), 0.15);
}

TEST(Oracle, AMovedWorldGivesTheSamePicture) {
    const shadows::Light light = lamp({0.7, 2.5, -0.4});
    const Pinhole camera;
    const Picture here = picture_of(box_over_ground(), camera.view(), light, camera.options());
    const glm::dvec3 far(1e6, -2e6, 3e6);
    std::vector<Shape> world = box_over_ground();
    for (Shape& shape : world) shape.pose = glm::translate(glm::dmat4(1.0), far) * shape.pose;
    Pinhole moved = camera;
    moved.eye += far;
    moved.target += far;
    const Picture there =
        picture_of(world, moved.view(), lamp(glm::dvec3(light.position_world) + far),
                   moved.options(), moved.eye);
    expect_telling(there, 0.03);
    std::size_t different = 0;
    for (std::size_t i = 0; i < here.verdicts.size(); ++i) {
        different += here.verdicts[i] != there.verdicts[i] ? 1U : 0U;
    }
    EXPECT_LE(different, 2U);  // pixels whose band ends on a boundary to within 1e-9
}

TEST(Oracle, SamplePlacesAreThePixelsOfAFinerPicture) {
    const Pinhole coarse;
    Pinhole fine = coarse;
    fine.width *= 2;
    fine.height *= 2;
    const shadows::Light light = lamp({0.7, 2.5, -0.4});
    Options options = coarse.options();
    options.sample_position = {0.25, 0.75};
    Options fine_options = fine.options();
    fine_options.band_px = 2.0 * options.band_px;
    const Picture samples = picture_of(box_over_ground(), coarse.view(), light, options);
    const Picture pixels = picture_of(box_over_ground(), fine.view(), light, fine_options);
    const Picture centres = picture_of(box_over_ground(), coarse.view(), light, coarse.options());
    expect_telling(samples, 0.03);
    std::size_t unlike_centres = 0;
    for (std::uint32_t y = 0; y < coarse.height; ++y) {
        for (std::uint32_t x = 0; x < coarse.width; ++x) {
            const std::size_t i = std::size_t{y} * coarse.width + x;
            EXPECT_EQ(samples.verdicts[i],
                      pixels.verdicts[std::size_t{2 * y + 1} * fine.width + 2 * x]);
            unlike_centres += samples.verdicts[i] != centres.verdicts[i] ? 1U : 0U;
        }
    }
    EXPECT_GT(unlike_centres, 20U);
}

TEST(Oracle, AWiderBandJudgesLess) {
    const Pinhole camera{.eye = {1.1, 2.3, 5.7}, .target = {0.1, -0.2, 0.0}};
    Options wide = camera.options();
    wide.band_px = 0.5;
    const shadows::Light light = lamp({0.7, 2.5, -0.4});
    const Picture narrow = picture_of(box_over_ground(), camera.view(), light, camera.options());
    const Picture broad = picture_of(box_over_ground(), camera.view(), light, wide);
    EXPECT_GT(count(broad).band, 4 * count(narrow).band);
    for (std::size_t i = 0; i < narrow.verdicts.size(); ++i) {
        EXPECT_TRUE(broad.verdicts[i] == Verdict::Band || broad.verdicts[i] == narrow.verdicts[i]);
    }
}

TEST(Oracle, BeyondItsRangeALightIsNotJudged) {
    const Pinhole camera;
    shadows::Light light = lamp({0.7, 2.5, -0.4});
    light.range_m = 4.0;
    const Picture picture = picture_of(box_over_ground(), camera.view(), light, camera.options());
    expect_telling(picture, 0.04);
    std::size_t beyond = 0;
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            const Ray ray = camera.ray(glm::dvec2(x, y) + 0.5);
            if (ray.along.y >= 0.0 || through_box(ray, {-0.5, 0.75, -0.375}, {0.5, 1.25, 0.375}))
                continue;
            const glm::dvec3 place = ray.from - ray.from.y / ray.along.y * ray.along;
            const double distance = glm::distance(place, glm::dvec3(light.position_world));
            const Verdict verdict = picture.verdicts[std::size_t{y} * picture.width + x];
            if (distance > 4.1) {
                ++beyond;
                EXPECT_TRUE(verdict == Verdict::Unjudged || verdict == Verdict::Band);
            } else if (distance < 3.9) {
                EXPECT_NE(verdict, Verdict::Unjudged);
            }
        }
    }
    EXPECT_GT(beyond, 100U);
}

// The band's pixels have an answer too, if one asks of their centres alone: that of a single ray.
TEST(Oracle, TheCentresOfTheBandAreWhatARaySays) {
    const Pinhole camera;
    const std::vector<Shape> world = {{scene::make_plane(40.0F, 40.0F)},
                                      {scene::make_torus(1.0F, 0.3F, 16, 8), at(0, 1, 0)}};
    const shadows::Light light = lamp({0.7, 4.5, -0.4});
    Options options = camera.options();
    options.band_px = 0.25;
    const Picture picture = picture_of(world, camera.view(), light, options);
    ASSERT_EQ(picture.centres.size(), picture.verdicts.size());
    const BruteForce brute(world);
    std::size_t decided = 0;
    std::size_t undecided = 0;
    for (std::size_t i = 0; i < picture.verdicts.size(); ++i) {
        if (picture.verdicts[i] != Verdict::Band) {
            EXPECT_EQ(picture.centres[i], picture.verdicts[i]);
            continue;
        }
        const glm::dvec2 corner(i % picture.width, i / picture.width);
        if (picture.centres[i] == Verdict::Band) {
            ++undecided;
        } else {
            EXPECT_EQ(picture.centres[i], brute.verdict(camera.ray(corner + 0.5), light)) << i;
            ++decided;
        }
    }
    EXPECT_GT(decided, 100U);
    EXPECT_LT(undecided, decided / 10);
}

TEST(Oracle, AFlippedPixelIsFound) {
    const Pinhole camera;
    const Picture truth =
        picture_of(box_over_ground(), camera.view(), sun({0.4, 1.0, -0.3}), camera.options());
    expect_telling(truth, 0.03);
    std::vector<std::uint8_t> mask(truth.verdicts.size());
    std::uint32_t a_lit_one = 0;
    std::uint32_t a_dark_one = 0;
    for (std::uint32_t i = 0; i < mask.size(); ++i) {
        const Verdict verdict = truth.verdicts[i];
        mask[i] = verdict == Verdict::Shadowed ? 3 : 0;
        if (verdict == Verdict::Band || verdict == Verdict::Unjudged) mask[i] = i % 2;
        if (verdict == Verdict::Lit) a_lit_one = i;
        if (verdict == Verdict::Shadowed) a_dark_one = i;
    }
    const Counts counts = count(truth);
    const Judgement right = judge(truth, mask);
    EXPECT_EQ(right.wrong(), 0U);
    EXPECT_EQ(right.pixels, mask.size());
    EXPECT_EQ(right.lit, counts.lit);
    EXPECT_EQ(right.shadowed, counts.shadowed);
    EXPECT_EQ(right.band, counts.band);
    EXPECT_EQ(right.judged(), counts.lit + counts.shadowed);

    mask[a_lit_one] = 1;
    const Judgement with_shadow = judge(truth, mask);
    EXPECT_EQ(with_shadow.false_shadow, 1U);
    EXPECT_EQ(with_shadow.false_light, 0U);
    EXPECT_THAT(with_shadow.wrong_pixels, testing::ElementsAre(a_lit_one));

    mask[a_lit_one] = 0;
    mask[a_dark_one] = 0;
    const Judgement with_light = judge(truth, mask);
    EXPECT_EQ(with_light.false_shadow, 0U);
    EXPECT_EQ(with_light.false_light, 1U);
    EXPECT_THAT(with_light.wrong_pixels, testing::ElementsAre(a_dark_one));

    for (std::uint8_t& texel : mask) texel = texel == 0 ? 1 : 0;
    EXPECT_EQ(judge(truth, mask).wrong_pixels.size(), 1000U);
}

}  // namespace
}  // namespace gnomon::truth
