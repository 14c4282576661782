// SPDX-License-Identifier: MIT
//
// All strategies give the same answer: for one light, and along motions where those that keep state
// work from what they saw last.
#include <gnomon/shadows/detector.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "modules/shadows/internal/displacement.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

struct Answer {
    CastingFaces casting;
    std::vector<SilhouetteEdge> silhouette;
    std::vector<std::uint8_t> solid_averted;
    bool operator==(const Answer&) const = default;
};

// The plain way, which no detector shares.
Answer expected(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) {
    Facing facing;
    classify_faces(mesh, light, facing, near_caps, FacingFilter::Scalar);
    Answer answer;
    pack_weights(facing.weights, answer.casting);
    find_silhouette(mesh, facing.weights, answer.silhouette);
    std::ranges::sort(answer.silhouette);
    answer.solid_averted = facing.solid_averted;
    return answer;
}

Answer answer_of(const Detection& found) {
    Answer answer{found.casting, found.silhouette, found.solid_averted};
    std::ranges::sort(answer.silhouette);
    return answer;
}

// A light that went no further than the margin, in some direction; where rounding permits.
std::optional<LightLocal> within(Random& random, LightLocal light, double margin) {
    margin = std::min(margin, 10.0);
    LightLocal other = light;
    if (light.is_directional()) {
        const double length = glm::length(glm::dvec3(light.position));
        if (!(length > 0.0)) return std::nullopt;
        const glm::dvec3 unit = glm::dvec3(light.position) / length;
        const glm::dvec3 to = unit + 0.999 * margin * random.unit_vector();
        if (!(glm::length(to) > 0.0)) return std::nullopt;
        other.position = glm::vec4(glm::vec3(to), 0.0F);
    } else {
        const glm::dvec3 to = glm::dvec3(light.position) + 0.999 * margin * random.unit_vector();
        other.position = glm::vec4(glm::vec3(to), 1.0F);
    }
    if (internal::displacement(light, other) > margin) return std::nullopt;
    return other;
}

std::uint64_t pairs_to_try() {
    const char* set = std::getenv("GNOMON_PAIRS");
    return set == nullptr ? 3'000 : std::strtoull(set, nullptr, 10);
}

std::uint64_t frames_to_run() {
    const char* set = std::getenv("GNOMON_FRAMES");
    return set == nullptr ? 3'000 : std::strtoull(set, nullptr, 10);
}

bool is_empty(const Detection& found) {
    std::vector<FaceRun> runs;
    runs_of(found.casting, runs);
    return runs.empty();
}

class EveryStrategy : public testing::TestWithParam<std::string> {
protected:
    const SilhouetteStrategy& strategy() const { return *find_strategy(GetParam()); }
};

TEST_P(EveryStrategy, FindsWhatThePlainWayFinds) {
    GNOMON_RANDOM(random);
    const auto detector = strategy().create();
    for (std::uint64_t i = 0; i < pairs_to_try(); ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        const LightLocal light = test::random_light(random, *mesh);
        const NearCaps near_caps = random.chance(0.5) ? NearCaps::Facing : NearCaps::Averted;
        const Answer wanted = expected(*mesh, light, near_caps);
        const Detection& found = detector->detect(*mesh, light, near_caps);
        ASSERT_EQ(answer_of(found), wanted) << "pair " << i;
        ASSERT_GE(found.margin, 0.0);
        if (const auto other = within(random, light, found.margin)) {
            ASSERT_EQ(expected(*mesh, *other, near_caps), wanted) << "pair " << i;
        }
    }
}

// Steps of every size, from far below a margin to a jump; the light stays, turns back, becomes a
// direction, and goes to places where everything is degenerate.
TEST_P(EveryStrategy, FollowsAMotion) {
    GNOMON_RANDOM(random);
    for (int motion = 0; motion < 60; ++motion) {
        const auto mesh =
            test::build(motion % 3 == 0 ? test::sphere(12, 17) : test::random_mesh(random));
        const auto detector = strategy().create();
        LightLocal light = test::random_light(random, *mesh);
        NearCaps near_caps = NearCaps::Facing;
        Answer last;
        for (int step = 0; step < 100; ++step) {
            if (random.chance(0.05)) light = test::random_light(random, *mesh);
            if (random.chance(0.02)) {
                near_caps = near_caps == NearCaps::Facing ? NearCaps::Averted : NearCaps::Facing;
            }
            if (random.chance(0.9)) {
                const double length = std::pow(10.0, random.uniform(-7.0, 0.5));
                light.position += glm::vec4(length * random.unit_vector(), 0.0);
            }
            const Answer wanted = expected(*mesh, light, near_caps);
            const Detection& found = detector->detect(*mesh, light, near_caps);
            const Answer answer = answer_of(found);
            ASSERT_EQ(answer, wanted) << "motion " << motion << ", step " << step;
            if (const auto other = within(random, light, found.margin)) {
                ASSERT_EQ(expected(*mesh, *other, near_caps), wanted)
                    << "motion " << motion << ", step " << step;
            }
            if (!found.changed) {
                ASSERT_EQ(answer, last) << "motion " << motion << ", step " << step;
            }
            last = answer;
        }
    }
}

// Along long ways: an orbit by small and by large steps, a drift, a tremble about one place, and a
// walk through the mesh. Nothing may add up.
TEST_P(EveryStrategy, NeverDrifts) {
    GNOMON_RANDOM(random);
    if (!strategy().keeps_state) GTEST_SKIP() << "remembers nothing";
    const std::uint64_t frames = frames_to_run();
    const std::uint64_t compared_every = std::min<std::uint64_t>(1'000, frames / 10);
    const auto mesh = test::build(
        test::merged(test::torus(60, 90), test::moved(test::sphere(20, 30), {2, 0, 0})));
    for (const std::string_view motion :
         {"orbit", "fast orbit", "drift", "tremble", "walk", "sun"}) {
        const auto detector = strategy().create();
        glm::dvec3 place(3.0, 1.0, 0.5);
        double angle = 0.0;
        for (std::uint64_t frame = 1; frame <= frames; ++frame) {
            LightLocal light;
            if (motion == "orbit" || motion == "fast orbit") {
                angle += motion == "orbit" ? 1e-4 : 7e-3;
                place = {3.0 * std::cos(angle), 1.0, 3.0 * std::sin(angle)};
            } else if (motion == "drift") {
                place += glm::dvec3(1e-6, -2e-6, 3e-6);
            } else if (motion == "tremble") {
                place = glm::dvec3(3.0, 1.0, 0.5) + 1e-3 * random.in_cube(1.0);
            } else {
                place += 0.01 * random.in_cube(1.0);
                if (glm::length(place) > 4.0) place *= 0.9;
            }
            light.position = glm::vec4(glm::vec3(place), 1.0F);
            if (motion == "sun") {
                angle += 1e-5;
                light.position = {std::cos(angle), std::sin(angle), 0.3F, 0.0F};
            }
            const Detection& found = detector->detect(*mesh, light, NearCaps::Facing);
            if (frame % compared_every != 0) continue;
            ASSERT_EQ(answer_of(found), expected(*mesh, light, NearCaps::Facing))
                << motion << ", frame " << frame;
        }
    }
}

// The same triangles in new places every frame, as a skin has them.
TEST_P(EveryStrategy, FollowsADeformation) {
    GNOMON_RANDOM(random);
    const auto detector = strategy().create();
    for (int i = 0; i < 30; ++i) {
        const test::Triangles rest = i % 2 == 0 ? test::torus(9, 14) : test::random_mesh(random);
        const auto mesh = test::build(rest);
        const LightLocal light = test::random_light(random, *mesh);
        for (int frame = 0; frame < 10; ++frame) {
            std::vector<glm::vec3> positions = rest.positions;
            for (glm::vec3& p : positions) {
                p.x += 0.3F * std::sin(p.y + 0.1F * static_cast<float>(frame));
            }
            const auto deformed = mesh->deformed(positions);
            ASSERT_TRUE(deformed);
            const Detection& found = detector->detect(**deformed, light, NearCaps::Facing);
            ASSERT_EQ(answer_of(found), expected(**deformed, light, NearCaps::Facing))
                << "mesh " << i << ", frame " << frame;
        }
    }
}

TEST_P(EveryStrategy, FindsNothingForALightThatIsNotFinite) {
    const auto mesh = test::build(test::box());
    const auto detector = strategy().create();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(is_empty(detector->detect(*mesh, {{5, 6, 7, 1}}, NearCaps::Facing)));
    const Detection& none = detector->detect(*mesh, {{nan, 0, 0, 1}}, NearCaps::Facing);
    EXPECT_TRUE(is_empty(none));
    EXPECT_TRUE(none.silhouette.empty());
    EXPECT_EQ(none.margin, 0.0);
    EXPECT_FALSE(is_empty(detector->detect(*mesh, {{5, 6, 7, 1}}, NearCaps::Facing)));
}

TEST_P(EveryStrategy, TakesAMeshWithoutFaces) {
    const auto mesh = test::build({});
    const auto detector = strategy().create();
    const Detection& found = detector->detect(*mesh, {{5, 6, 7, 1}}, NearCaps::Facing);
    EXPECT_TRUE(is_empty(found));
    EXPECT_TRUE(found.silhouette.empty());
}

TEST_P(EveryStrategy, CountsWhatItRemembers) {
    const auto mesh = test::build(test::sphere(40, 60));
    const auto detector = strategy().create();
    const std::size_t before = detector->memory_bytes();
    const std::size_t edges =
        detector->detect(*mesh, {{5, 6, 7, 1}}, NearCaps::Facing).silhouette.size();
    EXPECT_GE(detector->memory_bytes(), before + edges * sizeof(SilhouetteEdge));
}

std::vector<std::string> names() {
    std::vector<std::string> result;
    for (const SilhouetteStrategy& strategy : silhouette_strategies()) {
        result.emplace_back(strategy.name);
    }
    result.emplace_back(automatic_strategy().name);
    return result;
}

INSTANTIATE_TEST_SUITE_P(Strategies, EveryStrategy, testing::ValuesIn(names()),
                         [](const auto& row) { return row.param; });

TEST(Strategies, HaveNamesOfTheirOwn) {
    std::set<std::string> unique;
    for (const SilhouetteStrategy& strategy : silhouette_strategies()) {
        EXPECT_FALSE(strategy.summary.empty());
        EXPECT_NE(strategy.name, "auto");
        EXPECT_EQ(find_strategy(strategy.name), &strategy);
        unique.insert(std::string(strategy.name));
    }
    EXPECT_EQ(unique.size(), silhouette_strategies().size());
    EXPECT_TRUE(unique.contains("brute_force"));
    EXPECT_EQ(find_strategy("no such"), nullptr);
}

TEST(Runs, AreTheWeights) {
    GNOMON_RANDOM(random);
    std::vector<FaceRun> runs;
    for (int i = 0; i < 1'000; ++i) {
        std::vector<std::int8_t> weights(random.below(200) + 1);
        for (std::int8_t& weight : weights) {
            weight = static_cast<std::int8_t>(random.chance(0.6) ? 1 : random.integer(-2, 2));
        }
        runs_of(weights, runs);
        for (std::size_t r = 0; r < runs.size(); ++r) {
            ASSERT_NE(runs[r].weight, 0);
            ASSERT_GT(runs[r].count, 0U);
            if (r == 0) continue;
            const std::uint32_t end = runs[r - 1].first + runs[r - 1].count;
            ASSERT_GE(runs[r].first, end);
            ASSERT_TRUE(runs[r].first > end || runs[r].weight != runs[r - 1].weight);
        }
        std::vector<std::int8_t> back(weights.size(), 7);
        weights_of(runs, back);
        ASSERT_EQ(back, weights);

        for (std::int8_t& weight : weights) weight = std::clamp<std::int8_t>(weight, -1, 1);
        runs_of(weights, runs);
        CastingFaces casting;
        pack_weights(weights, casting);
        std::vector<FaceRun> packed_runs;
        runs_of(casting, packed_runs);
        ASSERT_EQ(packed_runs, runs);
    }
}

}  // namespace
}  // namespace gnomon::shadows
