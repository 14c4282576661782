// SPDX-License-Identifier: MIT
//
// Casters in another's umbra have no volume, or none that is drawn; and have one again as soon as
// they lie there no longer. What no caster needs is never missed.
#include <gnomon/shadows/shadow_system.hpp>

#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/shadows/shadow_query.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

glm::dmat4 standing(const glm::dvec3& place, const glm::dvec3& scale = glm::dvec3(1.0)) {
    glm::dmat4 pose(1.0);
    for (int i = 0; i < 3; ++i) pose[i] *= scale[i];
    pose[3] = glm::dvec4(place, 1.0);
    return pose;
}

View from(const glm::dvec3& eye, const glm::dvec3& target) {
    return {.view_from_world = look_at(eye, target, {0, 1, 0}),
            .clip_from_view = infinite_perspective(0.8, 1.5, 0.1)};
}

std::uint64_t pairs(const DrawList& list, Reason reason) {
    return list.stats.reasons[static_cast<std::size_t>(reason)];
}

class UmbraCulls : public testing::Test {
protected:
    static constexpr std::uint64_t wall = 1;
    static constexpr std::uint64_t thing = 2;

    // A sun to the right; a wall, and a thing on its left.
    UmbraCulls() {
        casters_[wall] = {
            .key = wall, .mesh = box_, .world_from_local = standing({0, 3, 0}, {0.1, 3, 3})};
        casters_[thing] = {.key = thing,
                           .mesh = test::build(test::torus(8, 8)),
                           .world_from_local = standing({-2, 2, 0})};
    }
    static ShadowSystem make(bool on, Receivers receivers = Receivers::Submitted) {
        return *ShadowSystem::create({.receivers = receivers, .fill = {.cull_by_umbra = on}});
    }
    const DrawList& frame(ShadowSystem& system, const View& view) {
        auto frame = system.begin_frame();
        for (const auto& [key, caster] : casters_) frame.caster(caster);
        frame.light(light_);
        if (frame.takes_receivers()) {
            frame.receiver({.key = 1, .bounds = {glm::dmat4(1.0), {-20, -0.1, -20}, {20, 9, 20}}});
        }
        return std::move(frame).finish(view);
    }
    const DrawList& frame() { return frame(system_, view_); }
    static std::set<std::uint64_t> drawn(const DrawList& list) {
        std::set<std::uint64_t> casters;
        for (const VolumeDraw& draw : list.draws) {
            if (!draw.bounds.empty()) casters.insert(draw.caster);
        }
        return casters;
    }
    using Keys = std::set<std::uint64_t>;

    std::shared_ptr<const ShadowMesh> box_ = test::build(test::box());
    std::map<std::uint64_t, Caster> casters_;
    Light light_{.key = 1, .position_world = {1.0, 0.5, 0.0, 0.0}};
    View view_ = from({0, 12, 40}, {0, 0, 0});
    ShadowSystem system_ = make(true);
};

TEST_F(UmbraCulls, LeaveOutWhatIsBehindAWall) {
    const DrawList& list = frame();
    EXPECT_EQ(drawn(list), Keys{wall});
    EXPECT_EQ(pairs(list, Reason::InUmbra), 1U);
    EXPECT_EQ(list.stats.pairs_in_umbra, 1U);
    EXPECT_EQ(list.stats.pairs_culled, 1U);
    EXPECT_EQ(list.stats.pairs_redetected, 1U);
    ShadowSystem without = make(false);
    EXPECT_EQ(drawn(frame(without, view_)), (Keys{wall, thing}));
    EXPECT_EQ(frame(without, view_).stats.pairs_in_umbra, 0U);
    ShadowSystem anywhere = make(true, Receivers::Anywhere);
    EXPECT_EQ(drawn(frame(anywhere, view_)), Keys{wall});
}

TEST_F(UmbraCulls, EndWithWhatHidAndItsPlace) {
    (void)frame();
    casters_[wall].world_from_local[3].z = 2.5;
    EXPECT_EQ(drawn(frame()), (Keys{wall, thing}));
    EXPECT_EQ(frame().stats.pairs_in_umbra, 0U);
    casters_[wall].world_from_local[3].z = 0.0;
    const DrawList& again = frame();
    EXPECT_EQ(drawn(again), Keys{wall});
    EXPECT_EQ(again.stats.pairs_hidden, 1U) << "its volume is kept";
    EXPECT_EQ(again.stats.pairs_in_umbra, 1U);
    const Caster gone = casters_[wall];
    casters_.erase(wall);
    const DrawList& alone = frame();
    EXPECT_EQ(drawn(alone), Keys{thing});
    EXPECT_EQ(alone.stats.pairs_redetected, 0U);
    casters_[wall] = gone;
    EXPECT_EQ(drawn(frame()), Keys{wall});
    casters_.erase(thing);
    EXPECT_EQ(frame().stats.pairs_in_umbra, 0U);
}

TEST_F(UmbraCulls, EndWithTheLightAndTheCaster) {
    (void)frame();
    light_.position_world.x = -1.0;
    EXPECT_EQ(drawn(frame()), (Keys{wall, thing}));
    light_.position_world.x = 1.0;
    const DrawList& back = frame();
    EXPECT_EQ(drawn(back), Keys{wall});
    EXPECT_EQ(pairs(back, Reason::InUmbra), 1U) << "a volume for another light is not kept";
    casters_[thing].world_from_local[3].x = 2.0;
    EXPECT_EQ(drawn(frame()), (Keys{wall, thing}));
    casters_[thing].world_from_local[3].x = -2.0;
    EXPECT_EQ(drawn(frame()), Keys{wall});
    casters_[wall].near_caps = NearCaps::Averted;
    EXPECT_EQ(drawn(frame()), (Keys{wall, thing})) << "its volume begins behind it";
    casters_[wall].near_caps = NearCaps::Facing;
    EXPECT_EQ(drawn(frame()), Keys{wall});
    casters_[wall].mesh = test::build(test::torus(8, 8));
    EXPECT_EQ(drawn(frame()), (Keys{wall, thing}));
    // A sheet hides what is behind either side.
    casters_[wall].mesh = test::build(test::sheet(1));
    casters_[wall].world_from_local =
        standing({0, 0, -3}) * glm::dmat4(glm::dmat3(0, 6, 0, -1, 0, 0, 0, 0, 6));
    EXPECT_EQ(drawn(frame()), Keys{wall});
    casters_[wall].world_from_local =
        standing({0, 0, -3}) * glm::dmat4(glm::dmat3(0, 6, 0, 1, 0, 0, 0, 0, 6));
    EXPECT_EQ(drawn(frame()), Keys{wall});
}

TEST_F(UmbraCulls, CostNothingWhereOnlyTheCameraMoves) {
    (void)frame();
    const View away = from({0, 12, 40}, {0, 12, 80});
    (void)frame(system_, away);
    EXPECT_EQ(frame(system_, away).stats.pairs_hidden, 1U);
    const DrawList& back = frame();
    EXPECT_EQ(back.stats.pairs_redetected, 0U);
    EXPECT_EQ(drawn(back), Keys{wall});
    // It leaves while nobody looks.
    (void)frame(system_, away);
    casters_.erase(wall);
    EXPECT_EQ(pairs(frame(system_, away), Reason::OutOfView), 1U);
    EXPECT_EQ(pairs(frame(), Reason::New), 1U);
    EXPECT_EQ(drawn(frame()), Keys{thing});
}

TEST_F(UmbraCulls, TakeUpAPairOnceThatWasOutOfViewTwice) {
    const View away = from({0, 12, 40}, {0, 12, 80});
    casters_.erase(wall);
    EXPECT_EQ(pairs(frame(system_, away), Reason::OutOfView), 1U);
    const Caster hides{
        .key = wall, .mesh = box_, .world_from_local = standing({0, 3, 0}, {0.1, 3, 3})};
    for (int i = 0; i < 3; ++i) {
        casters_[wall] = hides;
        light_.position_world.y += 0.001;
        EXPECT_EQ(pairs(frame(system_, away), Reason::InUmbra), 1U);
        casters_.erase(wall);
        light_.position_world.y += 0.001;
        EXPECT_EQ(pairs(frame(system_, away), Reason::OutOfView), 1U);
    }
    const DrawList& back = frame();
    ASSERT_EQ(back.draws.size(), 1U);
    EXPECT_EQ(back.draws[0].reason, Reason::New);
    EXPECT_EQ(back.stats.pairs_redetected, 1U);
}

TEST_F(UmbraCulls, KeepOneOfTwoThatAreInOnePlace) {
    casters_[thing] = casters_[wall];
    casters_[thing].key = thing;
    EXPECT_EQ(drawn(frame()), (Keys{wall, thing}));
    // All but in one place, and two within each other.
    casters_[thing].world_from_local[3].x -= 1e-3;
    EXPECT_GE(drawn(frame()).size(), 1U);
    casters_[thing].world_from_local = standing({0, 3, 0}, {0.09, 2.9, 2.9});
    EXPECT_EQ(drawn(frame()), Keys{wall});
    casters_[3] = {
        .key = 3, .mesh = box_, .world_from_local = standing({0, 3, 0}, {0.08, 2.8, 2.8})};
    casters_[4] = {.key = 4, .mesh = box_, .world_from_local = standing({-1, 2.5, 0}, {0.1, 2, 2})};
    EXPECT_EQ(drawn(frame()), Keys{wall}) << "each within the one before";
    casters_.erase(wall);
    EXPECT_EQ(drawn(frame()), Keys{thing}) << "the next takes its place";
}

TEST_F(UmbraCulls, FollowALampAndItsRange) {
    light_.position_world = {2, 3, 0, 1};
    EXPECT_EQ(drawn(frame()), Keys{wall});
    light_.range_m = 2.0;
    EXPECT_EQ(pairs(frame(), Reason::OutOfRange), 1U) << "the thing";
    EXPECT_EQ(frame().stats.pairs_in_umbra, 0U);
    light_.range_m = std::nullopt;
    casters_[thing].world_from_local = standing({-15, 3, 0}, {4, 4, 4});
    EXPECT_EQ(drawn(frame()), Keys{wall}) << "the shadow of a lamp widens";
    light_.position_world = {20, 3, 0, 1};
    EXPECT_EQ(drawn(frame()), (Keys{wall, thing}));
    light_.position_world = {0.05, 3, 0, 1};
    EXPECT_EQ(drawn(frame()), (Keys{wall, thing})) << "the lamp is in the wall";
}

// All kinds of boxes and others, one in another and behind another, that come, go and move, under
// lights that do; and what comes of it in frames.
struct World {
    explicit World(Random& random) : random_(random) {
        for (std::uint64_t key = 0; key < 24; ++key) casters[key] = caster(key);
        for (std::uint64_t key = 0; key < 3; ++key) lights[key] = light(key);
    }
    Caster caster(std::uint64_t key) {
        const double size = std::pow(10.0, random_.uniform(-0.7, 0.9));
        glm::dmat3 linear = random_.chance(0.5) ? random_.rotation() : glm::dmat3(1.0);
        for (int i = 0; i < 3; ++i) linear[i] *= size * random_.uniform(0.1, 1.0);
        if (random_.chance(0.1)) linear[0] = -linear[0];
        glm::dmat4 pose(linear);
        pose[3] = glm::dvec4(random_.in_cube(5.0), 1.0);
        return {
            .key = key, .mesh = meshes_[random_.below(meshes_.size())], .world_from_local = pose};
    }
    Light light(std::uint64_t key) {
        Light light{
            .key = key,
            .position_world = glm::dvec4(random_.in_cube(14.0), random_.chance(0.5) ? 0.0 : 1.0)};
        if (random_.chance(0.3)) light.range_m = random_.uniform(5.0, 20.0);
        return light;
    }
    void step() {
        const std::uint64_t key = random_.below(24);
        const auto found = casters.find(key);
        switch (random_.integer(0, 6)) {
            case 0: casters[key] = caster(key); break;
            case 1: casters.erase(key); break;
            case 2:
            case 3:
                if (found != casters.end()) {
                    found->second.world_from_local[3] += glm::dvec4(random_.in_cube(0.5), 0.0);
                }
                break;
            case 4: lights[key % 3] = light(key % 3); break;
            case 5:
                if (found != casters.end()) {
                    found->second.near_caps =
                        random_.chance(0.2) ? NearCaps::Averted : NearCaps::Facing;
                }
                break;
            default: view = from(random_.in_cube(15.0), random_.in_cube(3.0)); break;
        }
    }
    const DrawList& submit(ShadowSystem& system) const {
        auto frame = system.begin_frame();
        for (const auto& [key, caster] : casters) frame.caster(caster);
        for (const auto& [key, light] : lights) frame.light(light);
        return std::move(frame).finish(view);
    }

    std::map<std::uint64_t, Caster> casters;
    std::map<std::uint64_t, Light> lights;
    View view = from({0, 12, 40}, {0, 0, 0});

private:
    Random& random_;
    std::vector<std::shared_ptr<const ShadowMesh>> meshes_{
        test::build(test::box()),
        test::build(test::sphere(6, 7)),
        test::build(test::inside_out(test::box())),
        test::build(test::sheet(2)),
        test::build(test::l_shape()),
        test::build(test::book(4)),
        test::build(test::torus(6, 6)),
        test::build(test::merged(test::box({-1, -1, -1}, {0, 1, 1}),
                                 test::box({0.2F, -1, -1}, {1, 1, 1})))};
};

using Pair = std::pair<std::uint64_t, std::uint64_t>;

std::set<Pair> drawn_pairs(const DrawList& list) {
    std::set<Pair> found;
    for (const VolumeDraw& draw : list.draws) {
        if (!draw.bounds.empty()) found.emplace(draw.light, draw.caster);
    }
    return found;
}

TEST(UmbraCullsOfAnyWorld, AreThoseOfASystemThatSawNothingBefore) {
    GNOMON_RANDOM(random);
    std::uint64_t in_umbra = 0;
    std::uint64_t pairs_seen = 0;
    for (int run = 0; run < 30; ++run) {
        World world(random);
        const SystemOptions options{.jobs = run % 2 == 0 ? Jobs{} : thread_jobs(2)};
        ShadowSystem system = *ShadowSystem::create(options);
        for (int step = 0; step < 60; ++step) {
            SCOPED_TRACE(testing::Message() << "run " << run << ", step " << step);
            for (int changes = random.integer(0, 3); changes > 0; --changes) world.step();
            const DrawList& list = world.submit(system);
            ShadowSystem fresh = *ShadowSystem::create(options);
            const DrawList& expected = world.submit(fresh);
            ASSERT_EQ(drawn_pairs(list), drawn_pairs(expected));
            ASSERT_EQ(list.stats.pairs_in_umbra, expected.stats.pairs_in_umbra);
            in_umbra += list.stats.pairs_in_umbra;
            pairs_seen += list.stats.pairs;
        }
    }
    std::printf("%llu of %llu pairs in an umbra\n", static_cast<unsigned long long>(in_umbra),
                static_cast<unsigned long long>(pairs_seen));
    EXPECT_GT(in_umbra, 5'000U);
}

TEST(UmbraCullsOfAnyWorld, LeaveNoPointOutOfTheShadow) {
    GNOMON_RANDOM(random);
    std::uint64_t left_out = 0;
    std::uint64_t asked = 0;
    for (int run = 0; run < 400; ++run) {
        SCOPED_TRACE(run);
        World world(random);
        // Every shadow is seen, so that only umbrae leave any out.
        ShadowSystem system = *ShadowSystem::create({.fill = {.cull_by_view = false}});
        const DrawList& list = world.submit(system);
        const std::set<Pair> drawn = drawn_pairs(list);
        left_out += list.stats.pairs_in_umbra;
        for (const auto& [key, light] : world.lights) {
            std::vector<Caster> casters;
            std::vector<Caster> casters_drawn;
            for (const auto& [number, caster] : world.casters) {
                casters.push_back(caster);
                if (drawn.contains({key, number})) casters_drawn.push_back(caster);
            }
            if (casters.size() == casters_drawn.size()) continue;
            ShadowQueries all;
            ShadowQueries some;
            (void)all.update(casters);
            (void)some.update(casters_drawn);
            for (int i = 0; i < 300; ++i) {
                const glm::dvec3 point = random.in_cube(random.chance(0.5) ? 6.0 : 30.0);
                ++asked;
                ASSERT_EQ(all.at(light, point), some.at(light, point))
                    << "light " << key << " " << point.x << " " << point.y << " " << point.z;
            }
        }
    }
    std::printf("%llu pairs left out, %llu points\n", static_cast<unsigned long long>(left_out),
                static_cast<unsigned long long>(asked));
    EXPECT_GT(left_out, 1'500U);
}

}  // namespace
}  // namespace gnomon::shadows
