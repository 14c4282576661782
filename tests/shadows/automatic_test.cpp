// SPDX-License-Identifier: MIT
//
// What "auto" chooses, and that its choices change no answer.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/shadows/detector.hpp>

#include "modules/shadows/internal/jump.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

struct AutomaticAnswer {
    CastingFaces casting;
    std::vector<SilhouetteEdge> silhouette;
    std::vector<std::uint8_t> solid_averted;
    bool operator==(const AutomaticAnswer&) const = default;
};

AutomaticAnswer automatic_answer(const Detection& found) {
    AutomaticAnswer answer{found.casting, found.silhouette, found.solid_averted};
    std::ranges::sort(answer.silhouette);
    return answer;
}

// A cube whose sides are of cells x cells flat quads.
std::shared_ptr<const ShadowMesh> flat_cube(int cells) {
    test::Triangles cube;
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool upper : {false, true}) {
            const auto first = static_cast<std::uint32_t>(cube.positions.size());
            const auto row = static_cast<std::uint32_t>(cells + 1);
            for (int i = 0; i <= cells; ++i) {
                for (int j = 0; j <= cells; ++j) {
                    glm::vec3 p;
                    p[axis] = upper ? 1.0F : -1.0F;
                    p[(axis + 1) % 3] = -1.0F + 2.0F * static_cast<float>(i) / float(cells);
                    p[(axis + 2) % 3] = -1.0F + 2.0F * static_cast<float>(j) / float(cells);
                    cube.positions.push_back(p);
                }
            }
            for (std::uint32_t i = 0; i + 1 < row; ++i) {
                for (std::uint32_t j = 0; j + 1 < row; ++j) {
                    const std::uint32_t a = first + i * row + j;
                    std::vector<std::uint32_t> quad{a, a + row, a + row + 1, a, a + row + 1, a + 1};
                    if (!upper) std::swap(quad[1], quad[2]), std::swap(quad[4], quad[5]);
                    cube.indices.insert(cube.indices.end(), quad.begin(), quad.end());
                }
            }
        }
    }
    return test::build(cube);
}

LightLocal turned_about_y(LightLocal light, double angle) {
    const glm::dvec3 p(light.position);
    return {glm::vec4(p.x * std::cos(angle) - p.z * std::sin(angle), p.y,
                      p.x * std::sin(angle) + p.z * std::cos(angle), light.position.w)};
}

// Steps of all lengths, jumps, rests, the other kind of light, lights in the planes of flat sides
// and lights that are not finite, one after the other.
TEST(Automatic, IsRightWhateverCameBefore) {
    GNOMON_RANDOM(random);
    const auto plain = find_strategy("brute_force")->create();
    for (const auto& mesh :
         {test::build(test::sphere(40, 60)), flat_cube(24), test::build(test::sphere(12, 20))}) {
        const auto automatic = automatic_strategy().create();
        LightLocal light{{5, 1, 2, 1}};
        NearCaps near_caps = NearCaps::Facing;
        std::array<int, choice_count> choices{};
        AutomaticAnswer before;
        for (int frame = 0; frame < 3'000; ++frame) {
            const double kind = random.uniform(0.0, 1.0);
            if (kind < 0.02) light = test::random_light(random, *mesh);
            if (kind > 0.02 && kind < 0.03) light.position = {5, 0, 0, random.chance(0.5) ? 1 : 0};
            if (kind > 0.03 && kind < 0.04) {
                light.position.y = random.chance(0.5) ? std::numeric_limits<float>::quiet_NaN()
                                                      : std::numeric_limits<float>::infinity();
            }
            if (kind > 0.04 && kind < 0.05) {
                near_caps = near_caps == NearCaps::Facing ? NearCaps::Averted : NearCaps::Facing;
            }
            if (!std::isfinite(light.position.y) && kind > 0.3) light.position = {2, 4, 3, 1};
            if (kind > 0.2)
                light = turned_about_y(light, std::pow(10.0, random.uniform(-7.0, -1.0)));
            const Detection& found = automatic->detect(*mesh, light, near_caps);
            const AutomaticAnswer answer = automatic_answer(found);
            ASSERT_EQ(answer, automatic_answer(plain->detect(*mesh, light, near_caps)))
                << frame << " " << to_string(automatic->choice());
            if (!found.changed) {
                ASSERT_EQ(answer, before) << frame;
            }
            before = answer;
            ++choices[static_cast<std::size_t>(automatic->choice())];
        }
        const Choice anew = mesh->faces().size() < 2'000 ? Choice::FewFaces : Choice::Jump;
        EXPECT_GT(choices[static_cast<std::size_t>(anew)], 0);
        EXPECT_GT(choices[static_cast<std::size_t>(Choice::SmallStep)], 0);
    }
}

// The planes of two thirds of the faces contain this light: everything has to be looked at, once.
TEST(Automatic, ForgetsALightAmongFlatFaces) {
    const auto mesh = flat_cube(40);
    const auto automatic = automatic_strategy().create();
    automatic->detect(*mesh, {{1, 0, 0, 0}}, NearCaps::Facing);
    EXPECT_EQ(automatic->choice(), Choice::LargeSilhouette);
    int searches = 0;
    for (int frame = 0; frame < 10; ++frame) {
        const double angle = 2.0 * frame + 0.3;
        automatic->detect(*mesh, turned_about_y({{1, 0.5, 0.2, 0}}, angle), NearCaps::Facing);
        searches += automatic->choice() == Choice::Jump ? 1 : 0;
    }
    EXPECT_GE(searches, 9);
}

// Where the light's kind of motion changes, so does the choice, within a frame or two.
TEST(Automatic, FollowsTheMotion) {
    const auto mesh = test::build(test::sphere(60, 80));
    const auto automatic = automatic_strategy().create();
    const auto choices = [&](double step, int frames, Choice wanted) {
        static double angle = 0.0;
        int count = 0;
        for (int frame = 0; frame < frames; ++frame) {
            angle += step;
            automatic->detect(*mesh, turned_about_y({{4, 2, 1, 1}}, angle), NearCaps::Facing);
            count += automatic->choice() == wanted ? 1 : 0;
        }
        return count;
    };
    for (int round = 0; round < 3; ++round) {
        EXPECT_GE(choices(1e-4, 200, Choice::SmallStep), 190);
        EXPECT_GE(choices(1.0, 50, Choice::Jump), 48);
    }
}

// A light that stands or stays within the margin is not looked at, whoever decided last.
TEST(Automatic, LooksAtNothingWhereNothingMoves) {
    for (const auto& mesh : {test::build(test::sphere(40, 60)), test::build(test::box())}) {
        const auto automatic = automatic_strategy().create();
        for (const LightLocal light : {LightLocal{{5, 6, 7, 1}}, LightLocal{{-5, 4, 7, 0}}}) {
            const double margin = automatic->detect(*mesh, light, NearCaps::Facing).margin;
            ASSERT_GT(margin, 1e-5);
            const Detection& still = automatic->detect(*mesh, light, NearCaps::Facing);
            EXPECT_FALSE(still.changed);
            EXPECT_EQ(still.stats.faces_tested, 0U);
            EXPECT_EQ(still.margin, margin);
            const Detection& near =
                automatic->detect(*mesh, turned_about_y(light, 0.05 * margin), NearCaps::Facing);
            EXPECT_FALSE(near.changed);
            EXPECT_EQ(near.stats.faces_tested, 0U);
            EXPECT_LT(near.margin, margin);
        }
    }
}

TEST(Backoff, WaitsLongerEachTimeAndNotForEver) {
    internal::Backoff backoff(1, 4);
    std::vector<int> waits;
    for (int failure = 0; failure < 5; ++failure) {
        int waited = 0;
        while (!backoff.is_due()) ++waited;
        waits.push_back(waited);
        backoff.failed();
    }
    EXPECT_EQ(waits, (std::vector{0, 1, 2, 4, 4}));
    backoff.paid();
    EXPECT_TRUE(backoff.is_due());
}

}  // namespace
}  // namespace gnomon::shadows
