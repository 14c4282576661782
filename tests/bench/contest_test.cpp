// SPDX-License-Identifier: MIT
#include "contest.hpp"

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "meshlets.hpp"
#include "subjects.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::bench {
namespace {

// brute_force, but with a fault or a delay.
class Altered final : public shadows::SilhouetteDetector {
public:
    explicit Altered(bool forgets, int late_every)
        : plain_(shadows::find_strategy("brute_force")->create()),
          forgets_(forgets),
          late_every_(late_every) {}

    const shadows::Detection& detect(const shadows::ShadowMesh& mesh, shadows::LightLocal light,
                                     shadows::NearCaps near_caps) override {
        found_ = plain_->detect(mesh, light, near_caps);
        if (forgets_) found_.silhouette.pop_back();
        if (late_every_ > 0 && ++calls_ % late_every_ == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return found_;
    }
    [[nodiscard]] std::size_t memory_bytes() const override { return plain_->memory_bytes(); }

private:
    std::unique_ptr<shadows::SilhouetteDetector> plain_;
    shadows::Detection found_;
    bool forgets_;
    int late_every_;
    int calls_ = 0;
};

Contestant altered(std::string name, bool forgets, int late_every) {
    return {std::move(name), [=] { return std::make_unique<Altered>(forgets, late_every); }};
}

const Motion jump{"jump", Motion::Kind::Jump, 0.0, false};

TEST(Contest, NamesWhoFindsAnotherAnswer) {
    const auto mesh = test::build(test::sphere(12, 17));
    const std::vector<Contestant> contestants{altered("right", false, 0),
                                              altered("forgetful", true, 0)};
    const Contest contest = run_contest(*mesh, jump, contestants, 0.01);
    ASSERT_GE(contest.disagreements.size(), 2U);
    for (const std::string& sentence : contest.disagreements) {
        EXPECT_TRUE(sentence.starts_with("forgetful ")) << sentence;
    }
}

// The frame that is slow each time counts as the worst, and the ratios are block by block.
TEST(Contest, FindsTheSlowFrame) {
    const auto mesh = test::build(test::box());
    const std::vector<Contestant> contestants{altered("brute_force", false, 0),
                                              altered("late", false, 7)};
    const Contest contest = run_contest(*mesh, jump, contestants, 0.05);
    ASSERT_EQ(contest.measured.size(), 2U);
    EXPECT_GT(contest.measured[1].worst_ns, 1.5e6);
    EXPECT_LT(contest.measured[0].worst_ns, 1.5e6);
    EXPECT_LT(contest.measured[1].time_ns.median, 1.5e6);
    EXPECT_LT(contest.measured[1].faster_than_brute_force->median, 0.5);
    EXPECT_FALSE(contest.measured[1].faster_than_simd.has_value());
    EXPECT_GT(contest.floor_ns.median, 0.0);
    EXPECT_EQ(contest.frames % contest.frames_per_block, 0U);
}

// Whatever the time allowed, there are turns enough for an interval of their median; and "auto" is
// told by how much it is slower than what it chooses from.
TEST(Contest, HasTurnsEnoughAndSaysByHowMuch) {
    const auto mesh = test::build(test::box());
    const std::vector<Contestant> contestants{altered("simd", false, 0), altered("auto", false, 1)};
    const Contest contest = run_contest(*mesh, jump, contestants, 1e-9);
    EXPECT_GE(contest.frames / contest.frames_per_block, 9U);
    EXPECT_GE(contest.frames_per_block, 3U);
    const Measured& automatic = contest.measured[1];
    ASSERT_EQ(automatic.slower_than_parts_ns.size(), 1U);
    EXPECT_EQ(automatic.slower_than_parts_ns[0].first, "simd");
    EXPECT_GT(automatic.slower_than_parts_ns[0].second.low, 1.9e6);
    EXPECT_LT(automatic.faster_than_parts[0].second.high, 0.5);
    EXPECT_TRUE(contest.measured[0].slower_than_parts_ns.empty());
}

TEST(Motions, StayAtThreeRadii) {
    const Sphere about{{1, 2, 3}, 2.0};
    for (const Motion& motion : motions(false)) {
        std::set<std::vector<float>> seen;
        for (std::uint64_t frame = 0; frame < 100; ++frame) {
            const glm::vec4 light = light_of(motion, about, frame).position;
            seen.insert({light.x, light.y, light.z});
            const glm::dvec3 from_center = glm::dvec3(light) - double(light.w) * about.center;
            EXPECT_NEAR(glm::length(from_center), motion.directional ? 1.0 : 6.0, 1e-5);
            EXPECT_EQ(light.w, motion.directional ? 0.0F : 1.0F);
        }
        EXPECT_EQ(seen.size(), motion.kind == Motion::Kind::Static ? 1U : 100U) << motion.name;
    }
}

// A step is the angle that it says, as the caster turns as well as the light.
TEST(Motions, MoveByTheAngleTheySay) {
    for (const Motion& motion : motions(false)) {
        if (motion.degrees < 0.1) continue;
        const auto direction = [&](std::uint64_t frame) {
            return glm::normalize(glm::dvec3(light_of(motion, {}, frame).position));
        };
        double largest = 0.0;
        for (std::uint64_t frame = 0; frame < 50; ++frame) {
            largest = std::max(largest, glm::length(direction(frame + 1) - direction(frame)));
        }
        EXPECT_LT(largest, glm::radians(motion.degrees) * 1.01) << motion.name;
        EXPECT_GT(largest, glm::radians(motion.degrees) * 0.5) << motion.name;
    }
}

TEST(Subjects, AreClosedAndOutsideOut) {
    for (const auto& list : {subjects("no such folder", true), stand_ins(true)}) {
        for (const Subject& subject : list) {
            const auto source = subject.make();
            ASSERT_TRUE(source.has_value()) << subject.name;
            const auto mesh = test::build(test::Triangles{source->positions, source->indices});
            EXPECT_TRUE(mesh->report().closed()) << subject.name;
            for (const shadows::Component& component : mesh->components()) {
                EXPECT_FALSE(component.inside_out) << subject.name;
            }
        }
    }
}

TEST(Subjects, OfTheLiteratureHaveItsSizes) {
    constexpr double sizes[] = {11'353, 13'615, 147'296, 182'038};
    const std::vector<Subject> scenes = stand_ins(false);
    ASSERT_EQ(scenes.size(), std::size(sizes));
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        EXPECT_NEAR(static_cast<double>(scenes[i].make()->triangle_count()), sizes[i],
                    0.01 * sizes[i]);
    }
}

// Against the plain way, on any mesh and light: cones in single precision decide nothing wrong.
TEST(Meshlets, FindWhatThePlainWayFinds) {
    const auto contestant = meshlets();
    if (!contestant) GTEST_SKIP() << "meshoptimizer was not found when this was built";
    GNOMON_RANDOM(random);
    const auto clusters = contestant->create();
    const auto plain = shadows::find_strategy("brute_force")->create();
    const auto sphere = test::build(test::sphere(40, 60));
    for (int i = 0; i < 600; ++i) {
        const auto mesh = i % 3 == 0 ? sphere : test::build(test::random_mesh(random));
        const shadows::LightLocal light = test::random_light(random, *mesh);
        const shadows::Detection& wanted = plain->detect(*mesh, light, shadows::NearCaps::Facing);
        const shadows::Detection& found = clusters->detect(*mesh, light, shadows::NearCaps::Facing);
        auto sorted = [](std::vector<shadows::SilhouetteEdge> edges) {
            std::ranges::sort(edges);
            return edges;
        };
        ASSERT_EQ(found.casting, wanted.casting) << i;
        ASSERT_EQ(sorted(found.silhouette), sorted(wanted.silhouette)) << i;
    }
}

}  // namespace
}  // namespace gnomon::bench
