// SPDX-License-Identifier: MIT
//
// One pair by itself: with a detector of its own, which remembers.
#include "internal/pair.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows::internal {
namespace {

int detectors = 0;

// Says truly whether it found what it had found before.
class Remembering final : public SilhouetteDetector {
public:
    Remembering() { ++detectors; }
    ~Remembering() override { --detectors; }
    const Detection& detect(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) override {
        Detection now = plain_->detect(mesh, light, near_caps);
        now.changed = mesh_ != mesh.id() || now.casting != found_.casting ||
                      now.silhouette != found_.silhouette;
        mesh_ = mesh.id();
        found_ = std::move(now);
        return found_;
    }
    [[nodiscard]] std::size_t memory_bytes() const override { return sizeof *this; }

private:
    std::unique_ptr<SilhouetteDetector> plain_ = find_strategy("brute_force")->create();
    std::uint64_t mesh_ = 0;
    Detection found_;
};

const SilhouetteStrategy remembering{
    "remembering", "for tests", true,
    [] { return std::unique_ptr<SilhouetteDetector>(std::make_unique<Remembering>()); }};

struct OnePair {
    CasterState caster;
    LightState light;
    PairState pair;
    Scratch scratch;
    FrameTerms terms{.strategy = &remembering};
    std::shared_ptr<const Volume> volume;

    OnePair() {
        caster.mesh = test::build(test::box());
        caster.pose = make_pose(glm::dmat4(1.0));
    }
    // True where there is a new volume.
    bool update(const glm::dvec4& position) {
        FrameStats stats;
        ++terms.frame;
        light.moved = light.light.position_world != position;
        light.light.position_world = position;
        PairWork work;
        update_pair(pair, caster, light, terms, volume.get(), nullptr, scratch, work, stats);
        caster.mesh_before = caster.mesh->id();
        if (work.made == nullptr) return false;
        volume = work.made;
        return true;
    }
};

TEST(Pair, KeepsTheVolumeWhereItsOwnDetectorFindsTheSame) {
    OnePair one;
    EXPECT_TRUE(one.update({3, 4, 5, 1}));
    EXPECT_EQ(one.pair.reason, Reason::New);
    EXPECT_FALSE(one.update({3.5, 4, 5, 1}));
    EXPECT_EQ(one.pair.reason, Reason::WithinMargin);
    EXPECT_FALSE(one.update({30, 40, 50, 1})) << "far beyond the margin, and the same silhouette";
    EXPECT_EQ(one.pair.reason, Reason::LightMoved);
    EXPECT_EQ(one.pair.detected, glm::vec3(30, 40, 50));
    EXPECT_TRUE(one.update({0.5, 40, 50, 1}));
    // The same faces, but a far cap more or less.
    EXPECT_TRUE(one.update({0.5, 40, 50, 0}));
    EXPECT_EQ(one.volume->far_cap.count, 0U);
    one.terms.far_vertices = FarVertices::Finite;
    EXPECT_TRUE(one.update({0.5, 40, 50, 0}));
    EXPECT_EQ(one.pair.reason, Reason::ProjectionChanged);
    EXPECT_GT(one.volume->far_cap.count, 0U);
    // A plane has another cap than vertices that are finite one by one, whatever the light does.
    ReceiverTree ground;
    ground.build(std::array{Aabb{{-9, -9, -9}, {9, 9, -8}}});
    one.terms.fill = {{}, &ground, nullptr};
    EXPECT_TRUE(one.update({0.5, 40, 50, 0}));
    EXPECT_EQ(one.pair.reason, Reason::ProjectionChanged);
    EXPECT_EQ(one.volume->made_with.far_vertices, FarVertices::OnPlane);
}

TEST(Pair, ADetectorIsTheirsAloneAndGoesWithThem) {
    {
        OnePair one;
        OnePair other;
        (void)one.update({3, 4, 5, 1});
        (void)other.update({3, 4, 5, 1});
        EXPECT_EQ(detectors, 2);
        // Another strategy takes its place.
        one.terms.strategy = find_strategy("brute_force");
        EXPECT_TRUE(one.update({0.5, 4, 5, 1}));
        one.terms.strategy = &remembering;
        EXPECT_TRUE(one.update({3, 4, 5, 1})) << "what it found last is not what there is now";
        EXPECT_EQ(detectors, 2);
        other.pair = {};
        EXPECT_EQ(detectors, 1);
    }
    EXPECT_EQ(detectors, 0);
}

TEST(Pair, AChoiceIsMadeByWhatWasWanted) {
    const auto box = test::build(test::box());
    EXPECT_EQ(choose_strategy(&remembering, *box, {}).strategy, &remembering);
    EXPECT_EQ(choose_strategy(nullptr, *box, {}).choice, Choice::FewFaces);
}

TEST(Pair, OnlyWhatMovesOnGetsADetectorOfItsOwn) {
    const auto box = test::build(test::box());
    const auto small = test::build(test::sphere(20, 30));
    const auto large = test::build(test::sphere(80, 100));
    const PairHistory at_rest{.is_new = false, .frames_at_rest = 3};
    const PairHistory moving{.is_new = false, .frames_at_rest = 0};
    EXPECT_EQ(choose_strategy(nullptr, *large, {}).strategy, find_strategy("dual_bvh"));
    EXPECT_EQ(choose_strategy(nullptr, *large, {}).choice, Choice::Jump);
    EXPECT_EQ(choose_strategy(nullptr, *large, at_rest).choice, Choice::Jump);
    EXPECT_EQ(choose_strategy(nullptr, *large, moving).strategy, &automatic_strategy());
    EXPECT_EQ(choose_strategy(nullptr, *small, at_rest).strategy, find_strategy("simd"));
    EXPECT_EQ(choose_strategy(nullptr, *small, moving).strategy, &automatic_strategy());
    EXPECT_EQ(choose_strategy(nullptr, *box, moving).strategy, find_strategy("simd"));
    const auto deformed = large->deformed(test::sphere(80, 100).positions);
    ASSERT_TRUE(deformed);
    EXPECT_EQ(choose_strategy(nullptr, **deformed, moving).strategy, find_strategy("simd"));
    EXPECT_EQ(choose_strategy(nullptr, **deformed, moving).choice, Choice::Deforming);
}

}  // namespace
}  // namespace gnomon::shadows::internal
