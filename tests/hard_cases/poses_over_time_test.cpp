// SPDX-License-Identifier: MIT
//
// Hard cases that take many frames: poses that drift, jitter and turn over. A shadow system that
// lived through all of it gives the masks that one made on the spot gives.
#include <gtest/gtest.h>

#include <random>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>

#include "tests/rows/picture.hpp"
#include "tests/rows/stage.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

const PictureOptions small_picture{.width = 160, .height = 120};

// 28: caches that compare with the last frame drift, and those that compare |cos| miss half a turn.
class PosesOverTime : public DeviceTest {
protected:
    PosesOverTime() {
        stage_.ground();
        caster_ = stage_.place(shared(scene::make_torus_knot(1.0F, 0.32F, 2, 3, 96, 16)), start_);
        stage_.lamp({1.5, 4.5, 2.0});
        stage_.sun({-0.5, -1.0, -0.4});
        stage_.look({0.0, 2.6, 5.5}, {0.0, 0.9, 0.0});
        setting_ = stage_.finish();
    }

    // A frame of the system that has seen all the others.
    shadows::DrawList pose(const glm::dmat4& pose) {
        setting_.scene.registry.get<scene::LocalTransform>(caster_).matrix = pose;
        scene::update_world_transforms(setting_.scene.registry);
        auto frame = system_.begin_frame();
        must(adapter_.submit(setting_.scene, frame));
        return std::move(frame).finish(setting_.view);
    }

    // The masks of `list` and of a system that has seen nothing.
    void expect_masks_of_a_rebuild(const shadows::DrawList& list) {
        const Picture rebuilt = must(take_picture(device(), setting_, small_picture));
        PictureOptions options = small_picture;
        options.mutate = [&](shadows::DrawList& fresh) { fresh = list; };
        const Picture kept = must(take_picture(device(), setting_, options));
        ASSERT_EQ(kept.masks.size(), rebuilt.masks.size());
        for (std::size_t light = 0; light < rebuilt.masks.size(); ++light) {
            EXPECT_EQ(differing_bytes(kept.masks[light][0], rebuilt.masks[light][0]), 0U);
        }
    }

    const glm::dmat4 start_ = moved({0.0, 1.7, 0.0}) * turned(20, {1, 1, 0});
    Stage stage_;
    scene::Entity caster_;
    Setting setting_;
    scene::ShadowAdapter adapter_;
    shadows::ShadowSystem system_ = must(
        shadows::ShadowSystem::create({.receivers = shadows::Receivers::Submitted}));
};

TEST_P(PosesOverTime, a_drift_arrives_where_a_rebuild_does) {
    std::uint64_t reused = 0;
    std::uint64_t redetected = 0;
    for (int frame = 0; frame <= 4'000; ++frame) {
        const shadows::DrawList list = pose(start_ * turned(1e-5 * frame, {0.6, 0.8, 0.0}));
        reused += list.stats.pairs_reused;
        redetected += list.stats.pairs_redetected;
        if (frame % 1'000 != 0) continue;
        SCOPED_TRACE(frame);
        expect_masks_of_a_rebuild(list);
    }
    EXPECT_GT(reused, 0U) << "no margin was at work";
    EXPECT_GT(redetected, 4U) << "no step was worth a detection";
}

TEST_P(PosesOverTime, jitter_leaves_nothing_behind) {
    std::minstd_rand random(28);
    const auto uniform = [&] { return static_cast<double>(random() % 2'001) / 1'000.0 - 1.0; };
    std::uint64_t reused = 0;
    for (int frame = 0; frame <= 400; ++frame) {
        const double size = frame % 2 == 0 ? 1e-9 : 1e-5;
        const shadows::DrawList list =
            pose(moved(size * glm::dvec3(uniform(), uniform(), uniform())) * start_ *
                 turned(100.0 * size * uniform(), {0, 1, 0}));
        reused += list.stats.pairs_reused;
        if (frame % 100 >= 2) continue;
        SCOPED_TRACE(frame);
        expect_masks_of_a_rebuild(list);
    }
    EXPECT_GT(reused, 0U) << "no margin was at work";
    expect_masks_of_a_rebuild(pose(start_));
}

TEST_P(PosesOverTime, half_a_turn_is_seen) {
    (void)pose(start_);
    for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
        for (const double degrees : {180.0, 0.0}) {
            const shadows::DrawList list = pose(start_ * turned(degrees, axis));
            EXPECT_EQ(list.stats.pairs_reused, 2U) << "the ground's two";
            expect_masks_of_a_rebuild(list);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Devices, PosesOverTime, testing::ValuesIn(drawing_devices()),
                         device_case_name);

}  // namespace
}  // namespace gnomon::test
