// SPDX-License-Identifier: MIT
//
// What pairs cost while nothing moves: no allocation, and few bytes each.
#include <gnomon/shadows/shadow_system.hpp>

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/shadows/allocation_count.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

View some_view() {
    return {look_at({0, 40, 90}, {0, 0, 0}, {0, 1, 0}), infinite_perspective(1, 1.5, 0.1)};
}

// A field of boxes under lamps.
struct Field {
    std::vector<Caster> casters;
    std::vector<Light> lights;

    Field(std::uint64_t caster_count, std::uint64_t light_count) {
        const auto box = test::build(test::box());
        const auto side =
            static_cast<std::uint64_t>(std::ceil(std::sqrt(static_cast<double>(caster_count))));
        for (std::uint64_t i = 0; i < caster_count; ++i) {
            const glm::dvec3 place(4.0 * static_cast<double>(i % side), 0.0,
                                   4.0 * static_cast<double>(i / side));
            casters.push_back({.key = i * 7919 % 1'000'003,
                               .mesh = box,
                               .world_from_local = glm::translate(glm::dmat4(1.0), place)});
        }
        for (std::uint64_t i = 0; i < light_count; ++i) {
            const auto x = static_cast<double>(i);
            lights.push_back({.key = i, .position_world = {60.0 * x, 90.0, 40.0 * x, 1.0}});
        }
    }
    const DrawList& submit(ShadowSystem& system, const View& view = some_view()) const {
        auto frame = system.begin_frame();
        for (const Caster& caster : casters) frame.caster(caster);
        for (const Light& light : lights) frame.light(light);
        return std::move(frame).finish(view);
    }
};

TEST(IdlePairs, TenThousandCastersAndFourLights) {
    const Field field(10'000, 4);
    ShadowSystem system = *ShadowSystem::create({.fill = FillOptions::none()});
    const DrawList& list = field.submit(system);
    EXPECT_EQ(list.draws.size(), 40'000U);
    EXPECT_EQ(list.stats.pairs_redetected, 40'000U);
    EXPECT_EQ(list.stats.split_lights, 0U);
    EXPECT_EQ(field.submit(system).stats.reasons[static_cast<std::size_t>(Reason::Unchanged)],
              40'000U);
    EXPECT_EQ(system.begin_frame(Submission::Delta).finish(some_view()).stats.pairs_reused,
              40'000U);
}

TEST(IdlePairs, AllocateNothing) {
    const Field field(500, 3);
    for (const bool threads : {false, true}) {
        SystemOptions options{.fill = FillOptions::none()};
        if (threads) options.jobs = thread_jobs(2);
        ShadowSystem system = *ShadowSystem::create(options);
        for (int warm_up = 0; warm_up < 3; ++warm_up) (void)field.submit(system);
        const std::uint64_t before = test::allocation_count();
        const std::uint64_t bytes = test::allocated_bytes();
        for (int i = 0; i < 200; ++i) {
            (void)field.submit(system);
            (void)system.begin_frame(Submission::Delta).finish(some_view());
        }
        EXPECT_EQ(test::allocation_count(), before);
        EXPECT_EQ(test::allocated_bytes(), bytes);
    }
}

// Of the list alone: one draw each, with its volume.
std::size_t bytes_of_list(const ShadowSystem& system) {
    const SystemMemory memory = system.memory();
    return memory.draws + memory.volumes;
}

TEST(IdlePairs, TakeLessThan64BytesBesideWhatIsDrawn) {
    const Field field(4'000, 4);
    constexpr double pairs = 16'000.0;
    const std::uint64_t before = test::allocated_bytes();
    ShadowSystem system = *ShadowSystem::create({.fill = FillOptions::none()});
    for (int i = 0; i < 3; ++i) (void)field.submit(system);
    const auto all = static_cast<double>(test::allocated_bytes() - before);
    const SystemMemory memory = system.memory();
    const auto known =
        static_cast<double>(memory.casters + memory.lights + memory.pairs + memory.extras +
                            memory.draws + memory.volumes + memory.scratch);
    // Nothing is left out: but for the control blocks of volumes, and what few things are not
    // counted.
    EXPECT_LE(known, all);
    EXPECT_GT(known + pairs * 40.0, all * 0.99);
    EXPECT_EQ(memory.extras, 0U);
    const auto per_pair = static_cast<double>(memory.pairs + memory.scratch) / pairs;
    EXPECT_LT(per_pair, 64.0);
    RecordProperty("bytes_per_pair", std::to_string(per_pair));
    RecordProperty("bytes_per_draw", std::to_string(static_cast<double>(memory.draws) / pairs));
    RecordProperty("bytes_per_volume", std::to_string(static_cast<double>(memory.volumes) / pairs));

    // A pair that casts nothing has nothing but that: measured by as many more of them.
    Field dark = field;
    for (int i = 0; i < 4; ++i) {
        dark.lights.push_back({.key = 100ULL + static_cast<std::uint64_t>(i),
                               .position_world = {0.0, 1e6, 0.0, 1.0},
                               .range_m = 1.0});
    }
    (void)dark.submit(system);
    for (int i = 0; i < 3; ++i) (void)dark.submit(system);
    const SystemMemory with_dark = system.memory();
    EXPECT_EQ(bytes_of_list(system) - (memory.draws + memory.volumes), 4 * sizeof(LightDraws));
    EXPECT_EQ(with_dark.pairs, 2 * memory.pairs);
}

TEST(IdlePairs, GiveEverythingBack) {
    const std::uint64_t before = test::allocated_bytes();
    {
        ShadowSystem system = *ShadowSystem::create(
            {.max_layers = 3, .jobs = thread_jobs(3), .fill = FillOptions::none()});
        Field field(300, 3);
        for (int i = 0; i < 20; ++i) {
            field.lights[0].position_world.x += 1.0;
            if (i % 5 == 0) field.casters.pop_back();
            (void)field.submit(system);
        }
    }
    EXPECT_EQ(test::allocated_bytes(), before);
}

TEST(IdlePairs, GiveTheirDetectorsBackAfterAWhile) {
    for (const SilhouetteStrategy& strategy : silhouette_strategies()) {
        SCOPED_TRACE(std::string(strategy.name));
        Field field(50, 2);
        ShadowSystem system =
            *ShadowSystem::create({.silhouette = strategy.name, .fill = FillOptions::none()});
        for (int round = 0; round < 3; ++round) {
            field.lights[1].position_world.y -= 45.0;
            const DrawList& list = field.submit(system);
            EXPECT_TRUE(list.stats.pairs_redetected > 0 || list.stats.quad_pairs > 0);
            EXPECT_EQ(list.stats.silhouette, strategy.name);
            EXPECT_EQ(system.memory().extras > 0, strategy.keeps_state);
            for (int i = 0; i < 60; ++i) (void)field.submit(system);
            EXPECT_EQ(system.memory().extras > 0, strategy.keeps_state);
            for (int i = 0; i < 70; ++i) (void)field.submit(system);
            EXPECT_EQ(system.memory().extras, 0U);
        }
    }
}

TEST(IdlePairs, SlotsAreUsedAgain) {
    Field field(200, 2);
    ShadowSystem system = *ShadowSystem::create({.fill = FillOptions::none()});
    (void)field.submit(system);
    const std::uint64_t pairs = system.memory().pairs;
    for (int i = 0; i < 50; ++i) {
        for (Caster& caster : field.casters) caster.key += 1'000'003;
        const DrawList& list = field.submit(system);
        ASSERT_EQ(list.draws.size(), 400U);
        ASSERT_EQ(list.stats.reasons[static_cast<std::size_t>(Reason::New)], 400U);
    }
    EXPECT_LE(system.memory().pairs, 4 * pairs);
}

}  // namespace
}  // namespace gnomon::shadows
