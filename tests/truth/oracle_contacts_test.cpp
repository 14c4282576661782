// SPDX-License-Identifier: MIT
//
// The oracle on dirty and extreme geometry: surfaces that touch, coincide, cross, crack or nearly
// vanish. Each case has an answer that is known beforehand, and bounds how much is left undecided.
#include "tests/truth/oracle_fixture.hpp"

namespace gnomon::truth {
namespace {

Shape ground(float size = 60.0F) { return {scene::make_plane(size, size)}; }

/// The same triangles once more; `turned` winds them the other way.
scene::Mesh doubled(const scene::Mesh& mesh, bool turned) {
    scene::Mesh twice = mesh;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        twice.indices.push_back(mesh.indices[i]);
        twice.indices.push_back(mesh.indices[i + (turned ? 2 : 1)]);
        twice.indices.push_back(mesh.indices[i + (turned ? 1 : 2)]);
    }
    return twice;
}

std::size_t differences(const Picture& a, const Picture& b) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.verdicts.size(); ++i) {
        different += a.verdicts[i] != b.verdicts[i] ? 1U : 0U;
    }
    return different;
}
/// Pixels that one picture says are lit and the other says are in shadow.
std::size_t contradictions(const Picture& a, const Picture& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.verdicts.size(); ++i) {
        const bool judged = a.verdicts[i] >= Verdict::Lit && b.verdicts[i] >= Verdict::Lit;
        count += judged && a.verdicts[i] != b.verdicts[i] ? 1U : 0U;
    }
    return count;
}

TEST(OracleContacts, CoincidentFacesDoNotShadowEachOther) {
    const Pinhole camera;
    const shadows::Light light = lamp({1.0, 4.0, 2.0});
    const glm::dmat4 pose = glm::rotate(at(0.1, 0.9, 0.0), 0.7, glm::dvec3(1.0, 0.3, 0.2));
    const scene::Mesh torus = scene::make_torus(0.7F, 0.25F, 48, 24);
    const Picture once =
        picture_of({ground(), {torus, pose}}, camera.view(), light, camera.options());
    expect_telling(once, 0.06);
    for (const bool turned : {false, true}) {
        const Picture twice = picture_of({ground(), {doubled(torus, turned), pose}}, camera.view(),
                                         light, camera.options());
        EXPECT_EQ(differences(once, twice), 0U) << turned;
    }
    // The same mesh submitted as two instances.
    const Picture pair = picture_of({ground(), {torus, pose}, {torus, pose}}, camera.view(), light,
                                    camera.options());
    EXPECT_EQ(differences(once, pair), 0U);
}

TEST(OracleContacts, ASheetListedTwiceIsLitOnBothSides) {
    const scene::Mesh sheet = doubled(scene::make_plane(1.0F, 1.0F, 3), true);
    for (const double height : {5.0, -5.0}) {
        const Pinhole camera{.eye = {0.3, height / 2.0, 3.0}};
        const Picture picture =
            picture_of({{sheet}}, camera.view(), lamp({0.2, height, 0.1}), camera.options());
        EXPECT_GT(count(picture).lit, 500U);
        EXPECT_EQ(count(picture).shadowed, 0U);
        EXPECT_LT(count(picture).band, 60U);  // its outline alone
    }
}

TEST(OracleContacts, CoplanarOverlapIsOneSurface) {
    // Two tables whose tops overlap in one plane, and a decal that lies in it.
    const std::vector<Shape> tables{ground(),
                                    {scene::make_box({1.0F, 0.1F, 1.0F}), at(0.0, 0.75, 0.0)},
                                    {scene::make_box({1.0F, 0.1F, 1.0F}), at(0.37, 0.75, 0.21)},
                                    {scene::make_plane(0.5F, 0.5F), at(0.11, 0.8, -0.07)}};
    const Pinhole camera{.eye = {0.0, 4.0, 3.0}};
    const Picture picture =
        picture_of(tables, camera.view(), sun({0.4, 1.0, 0.3}), camera.options());
    expect_telling(picture, 0.06);
    std::size_t on_top = 0;
    each_judged(
        camera, picture, [&](std::uint32_t x, std::uint32_t y, Verdict verdict, const Ray& ray) {
            const glm::dvec3 place = ray.from + (0.8 - ray.from.y) / ray.along.y * ray.along;
            const bool first = std::abs(place.x) < 0.5 && std::abs(place.z) < 0.5;
            const bool second = std::abs(place.x - 0.37) < 0.5 && std::abs(place.z - 0.21) < 0.5;
            if (!first && !second) return;
            ++on_top;
            EXPECT_EQ(verdict, Verdict::Lit) << x << ' ' << y;
        });
    EXPECT_GT(on_top, 1000U);
}

TEST(OracleContacts, ASheetWithinRoundingOfTheGroundIsOneSurfaceWithIt) {
    // A third of a micrometre above it, or below: no depth buffer tells which one is drawn, but
    // either way it is lit.
    const Pinhole camera{.eye = {0.2, 3.0, 3.0}};
    for (const double height : {3e-7, -3e-7}) {
        const Picture picture =
            picture_of({ground(), {scene::make_plane(1.0F, 1.0F), at(0.0, height, 0.0)}},
                       camera.view(), sun({0.3, 1.0, 0.2}), camera.options());
        const Counts counts = count(picture);
        EXPECT_EQ(counts.shadowed, 0U);
        EXPECT_GT(counts.lit, 10000U);
        EXPECT_LT(counts.band, 300U);  // along its edges
    }
}

TEST(OracleContacts, AWallOfBoxesIsOneWall) {
    // Boxes stacked face to face, at places that binary fractions cannot hold.
    const float side = 0.3F;
    std::vector<Shape> wall{ground()};
    for (int row = 0; row < 5; ++row) {
        for (int column = -4; column <= 4; ++column) {
            wall.push_back({scene::make_box(glm::vec3(side)),
                            at(static_cast<double>(side) * column,
                               static_cast<double>(side) * (row + 0.5), 0.0)});
        }
    }
    const std::vector<Shape> slab{ground(),
                                  {scene::make_box({9.0F * side, 5.0F * side, side}),
                                   at(0.0, 2.5 * static_cast<double>(side), 0.0)}};
    const shadows::Light light = lamp({0.9, 5.0, 3.0});
    for (const double z : {7.0, -7.0}) {
        const Pinhole camera{.eye = {1.0, 3.0, z}};
        const Picture of_wall = picture_of(wall, camera.view(), light, camera.options());
        const Picture of_slab = picture_of(slab, camera.view(), light, camera.options());
        expect_telling(of_wall, 0.05);
        EXPECT_EQ(contradictions(of_wall, of_slab), 0U);
        EXPECT_LT(count(of_wall).band, count(of_slab).band + 100U);  // its seams
    }
}

TEST(OracleContacts, TouchingTheGroundIsNotFloating) {
    const Pinhole camera;
    const shadows::Light light = sun({0.6, 1.0, 0.4});
    const Picture resting =
        picture_of({ground(), {scene::make_box({1.0F, 1.0F, 1.0F}), at(0.0, 0.5, 0.0)}},
                   camera.view(), light, camera.options());
    const Picture sunk =
        picture_of({ground(), {scene::make_box({1.0F, 2.0F, 1.0F}), at(0.0, 0.0, 0.0)}},
                   camera.view(), light, camera.options());
    expect_telling(resting, 0.05);
    EXPECT_EQ(contradictions(resting, sunk), 0U);
    EXPECT_LT(differences(resting, sunk), 5U);
}

TEST(OracleContacts, AnUndrawnFaceInADrawnSurfaceIsUndecidable) {
    // Its caps lie exactly in the ground, but nothing says on which side of it they come to lie.
    const Pinhole camera{.eye = {0.2, 3.0, 3.0}};
    const shadows::Light light = sun({0.3, 1.0, 0.2});
    const scene::Mesh sheet = scene::make_plane(1.0F, 1.0F);
    const auto pictured = [&](bool drawn) {
        return picture_of({ground(), {sheet, at(0.0, 0.0, 0.0), true, drawn}}, camera.view(), light,
                          camera.options());
    };
    EXPECT_EQ(count(pictured(true)).shadowed, 0U);
    EXPECT_LT(count(pictured(true)).band, 300U);
    EXPECT_GT(count(pictured(false)).band, 700U);

    // A proxy of the very same triangles gets the very same depth: no doubt there.
    const scene::Mesh sphere = scene::make_sphere(0.7F, 24, 12);
    const Picture twin = picture_of({{ground()},
                                     {sphere, at(0.0, 0.9, 0.0), false, true},
                                     {sphere, at(0.0, 0.9, 0.0), true, false}},
                                    camera.view(), light, camera.options());
    const Picture single = picture_of({{ground()}, {sphere, at(0.0, 0.9, 0.0)}}, camera.view(),
                                      light, camera.options());
    expect_telling(single, 0.05);
    EXPECT_EQ(contradictions(twin, single), 0U);
    EXPECT_LT(count(twin).band, count(single).band + count(single).band / 2);
}

TEST(OracleContacts, ACrackIsBandAndNoMore) {
    // A screen of two triangles against one with a T-junction: a corner in the middle of a long
    // edge.
    const std::vector<glm::vec3> corners{
        {-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, {0.125F, 0, 0.125F}};
    const scene::Mesh whole = mesh_of(corners, {0, 2, 1, 0, 3, 2});
    const scene::Mesh cracked = mesh_of(corners, {0, 4, 1, 4, 2, 1, 0, 3, 2});
    const Pinhole camera{.eye = {2.0, 3.0, 3.0}};
    const shadows::Light light = sun({0.3, 1.0, -0.4});
    const auto pictured = [&](const scene::Mesh& screen) {
        return picture_of({ground(), {screen, at(0.0, 1.0, 0.0), true, false}}, camera.view(),
                          light, camera.options());
    };
    const Picture of_whole = pictured(whole);
    const Picture of_cracked = pictured(cracked);
    expect_telling(of_cracked, 0.04);
    EXPECT_EQ(contradictions(of_whole, of_cracked), 0U);
    EXPECT_GT(count(of_cracked).band, count(of_whole).band);
    EXPECT_LT(count(of_cracked).band, count(of_whole).band + 40U);
}

TEST(OracleContacts, AMicrometreAboveATableCountsUpClose) {
    // A sheet one micrometre above a table, seen through a microscope: its shadow is a micrometre
    // and a half wide.
    const double micrometre = 1e-6;
    const std::vector<Shape> world{
        {scene::make_plane(2e-4F, 2e-4F)},
        {scene::make_plane(1e-4F, 1e-4F), at(-0.5e-4, micrometre, 0.0), true, true}};
    const Pinhole camera{.eye = {2e-6, 12e-6, 4e-6}, .target = {0.0, 0.0, 0.0}, .near_m = 1e-7};
    const Picture picture =
        picture_of(world, camera.view(), sun({-1.5, 1.0, 0.0}), camera.options(), camera.eye);
    expect_telling(picture, 0.05);
    each_judged(camera, picture,
                [&](std::uint32_t x, std::uint32_t y, Verdict verdict, const Ray& ray) {
                    const double on_sheet =
                        ray.from.x + (micrometre - ray.from.y) / ray.along.y * ray.along.x;
                    const double on_table = ray.from.x - ray.from.y / ray.along.y * ray.along.x;
                    const bool dark = on_sheet > 0.0 && on_table < 1.5 * micrometre;
                    EXPECT_EQ(verdict, dark ? Verdict::Shadowed : Verdict::Lit) << x << ' ' << y;
                });
}

TEST(OracleContacts, AMicrometreThickBoxCastsLikeAnyOther) {
    const Pinhole camera;
    const shadows::Light light = sun({0.5, 1.0, 0.2});
    const Picture thin =
        picture_of({ground(), {scene::make_box({1.0F, 1e-6F, 1.0F}), at(0.0, 1.0, 0.0)}},
                   camera.view(), light, camera.options());
    const Picture sheet = picture_of({ground(), {scene::make_plane(1.0F, 1.0F), at(0.0, 1.0, 0.0)}},
                                     camera.view(), light, camera.options());
    expect_telling(thin, 0.04);
    EXPECT_EQ(contradictions(thin, sheet), 0U);
    EXPECT_LT(count(thin).band, count(sheet).band + 60U);
}

TEST(OracleContacts, ANeedleIsNeverMissed) {
    // Its shadow is a hundredth of a pixel wide: rays at nine places would nearly always miss it.
    const Pinhole camera{.eye = {0.0, 30.0, 60.0}, .fovy_rad = 0.6};
    const scene::Mesh needle = scene::make_box({200.0F, 2e-4F, 2e-4F});
    const glm::dmat4 pose = glm::rotate(at(0.0, 4.0, 0.0), 0.3, glm::dvec3(0.0, 1.0, 0.0));
    const Picture picture = picture_of({ground(2000.0F), {needle, pose, true, false}},
                                       camera.view(), sun({0.1, 1.0, 0.2}), camera.options());
    const Counts counts = count(picture);
    EXPECT_EQ(counts.shadowed, 0U);
    EXPECT_GT(counts.lit, 10000U);
    // The line crosses the picture once; an eighth of its pixels have it within the band.
    EXPECT_GT(counts.band, camera.width / 16U);
    EXPECT_LT(counts.band, camera.width);
}

TEST(OracleContacts, ASphereOfTenMicrometres) {
    // The same picture as of a sphere of ten metres, a million times smaller.
    const auto pictured = [](double scale) {
        const Pinhole camera{.eye = glm::dvec3(0.0, 25.0, 45.0) * scale, .near_m = 0.1 * scale};
        const auto small = static_cast<float>(scale);
        const std::vector<Shape> world{
            {scene::make_plane(400.0F * small, 400.0F * small)},
            {scene::make_sphere(10.0F * small, 24, 12), at(0.0, 12.0 * scale, 0.0)}};
        return picture_of(world, camera.view(), lamp(glm::dvec3(12.0, 60.0, 20.0) * scale),
                          camera.options(), camera.eye);
    };
    const Picture large = pictured(1.0);
    const Picture small = pictured(0x1p-20);
    expect_telling(small, 0.05);
    EXPECT_EQ(contradictions(large, small), 0U);
    EXPECT_LT(differences(large, small), 5U);
}

TEST(OracleContacts, AFlattenedMeshIsItsOutline) {
    const Pinhole camera{.eye = {0.4, 3.0, 5.0}};
    const shadows::Light light = sun({0.4, 1.0, 0.3});
    const glm::dmat4 tilted = glm::rotate(at(0.0, 1.0, 0.0), 0.4, glm::dvec3(0.3, 0.2, 1.0));
    const auto pictured = [&](const scene::Mesh& mesh) {
        return picture_of({ground(), {mesh, glm::scale(tilted, glm::dvec3(1.0, 0.0, 1.0))}},
                          camera.view(), light, camera.options());
    };
    const Picture box = pictured(scene::make_box({1.2F, 0.7F, 1.2F}));
    const Picture sheet = pictured(scene::make_plane(1.2F, 1.2F));
    expect_telling(box, 0.05);
    EXPECT_EQ(contradictions(box, sheet), 0U);
    EXPECT_LT(differences(box, sheet), 20U);
}

TEST(OracleContacts, CrossingSurfacesAgreeWithBruteForce) {
    const Pinhole camera{.eye = {1.0, 2.5, 4.0}, .width = 96, .height = 72};
    const std::vector<Shape> world{
        ground(),
        {scene::make_box({1.0F, 1.0F, 1.0F}), glm::rotate(at(0.0, 0.6, 0.0), 0.5, glm::dvec3(1.0))},
        {scene::make_box({0.4F, 2.0F, 0.4F}), at(0.2, 0.7, 0.1)},
        {scene::make_torus(0.7F, 0.1F, 24, 8), at(0.0, 0.8, 0.0)}};
    const shadows::Light light = lamp({1.5, 3.0, 1.0});
    const Picture picture = picture_of(world, camera.view(), light, camera.options());
    expect_telling(picture, 0.12);
    const BruteForce brute(world);
    each_judged(camera, picture,
                [&](std::uint32_t x, std::uint32_t y, Verdict verdict, const Ray& ray) {
                    EXPECT_EQ(verdict, brute.verdict(ray, light)) << x << ' ' << y;
                });
}

TEST(OracleContacts, ALampOnAVertexOrAFace) {
    const Pinhole camera;
    for (const glm::dvec3& place : {glm::dvec3(0.5, 1.5, 0.5), glm::dvec3(0.1, 1.5, 0.2)}) {
        const std::vector<Shape> world{ground(),
                                       {scene::make_box({1.0F, 1.0F, 1.0F}), at(0.0, 1.0, 0.0)}};
        const Picture picture = picture_of(world, camera.view(), lamp(place), camera.options());
        const Counts counts = count(picture);
        EXPECT_LT(counts.band, picture.verdicts.size() / 10U);
        if (place.x == 0.5) {
            expect_telling(picture, 0.1);  // on the corner: some of the ground still sees it
        } else {
            EXPECT_GT(counts.shadowed, 10000U);  // on the top: the ground beneath does not
            EXPECT_EQ(counts.lit, 0U);
        }
    }
}

TEST(OracleContacts, AHugeMeshIsPlacedLessPrecisely) {
    // Single precision places a mesh that reaches 100 km from its origin to some centimetres.
    const Pinhole camera{.eye = {1.1, 2.3, 5.7}};
    const auto band = [&](float size) {
        return count(picture_of(
                         {ground(size), {scene::make_box({1.0F, 1.0F, 1.0F}), at(0.0, 1.5, 0.0)}},
                         camera.view(), sun({0.4, 1.0, 0.3}), camera.options(), camera.eye))
            .band;
    };
    EXPECT_GT(band(2e5F), 2U * band(60.0F));
}

TEST(OracleContacts, GrazingLightIsNotJudged) {
    const Pinhole camera;
    const auto judged = [&](double elevation_rad) {
        const Counts counts = count(picture_of(
            {ground()}, camera.view(), sun({std::cos(elevation_rad), std::sin(elevation_rad), 0.0}),
            camera.options()));
        return counts.lit + counts.shadowed;
    };
    EXPECT_EQ(judged(1e-6), 0U);
    EXPECT_GT(judged(1e-3), 10000U);
}

TEST(OracleContacts, WhereDepthIsCoarserThanThePictureNothingIsSaidWrongly) {
    // Through a long lens a pixel is narrower than the steps of depth: a caster that stands within
    // them above its shadow leaves the shadow undecided, not lit.
    const std::vector<Shape> shapes{ground(20.0F),
                                    {scene::make_torus(1.0F, 0.4F, 48, 24), at(0.0, 1.5, 0.0)}};
    const BruteForce brute_force(shapes);
    for (const double distance : {1e4, 1e5, 1e6}) {
        Pinhole camera;
        camera.eye = distance * glm::normalize(glm::dvec3(0.0, 2.0, 5.0));
        camera.fovy_rad = 2.0 * std::atan(3.0 / distance);
        camera.near_m = 0.25 * distance;
        camera.width = 80;
        camera.height = 60;
        for (const double elevation : {1.0, 0.1}) {
            const shadows::Light light = sun({0.6, elevation, 0.5});
            const Picture picture =
                picture_of(shapes, camera.view(), light, camera.options(), camera.eye);
            if (distance < 1e5) expect_telling(picture, 0.06);
            std::size_t wrong = 0;
            each_judged(camera, picture, [&](auto, auto, Verdict verdict, const Ray& ray) {
                wrong += brute_force.verdict(ray, light) != verdict ? 1U : 0U;
            });
            EXPECT_EQ(wrong, 0U) << distance << " m away, elevation " << elevation;
        }
    }
}

}  // namespace
}  // namespace gnomon::truth
