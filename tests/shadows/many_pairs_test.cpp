// SPDX-License-Identifier: MIT
//
// Many pairs over many frames: whatever is submitted, in whichever way and on however many threads,
// the list is the one that a system makes which has seen nothing before.
#include <gnomon/shadows/shadow_system.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <map>
#include <new>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/shadows/allocation_count.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

glm::dmat4 at(const glm::dvec3& place) { return glm::translate(glm::dmat4(1.0), place); }

View some_view() {
    return {look_at({0, 5, 30}, {0, 0, 0}, {0, 1, 0}), infinite_perspective(1, 1.5, 0.1)};
}

// What is equal in lists of systems that have little in common: all but revisions and reasons.
std::string described(const VolumeDraw& draw) {
    std::string text;
    const auto put = [&](const auto& value) {
        text.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    put(draw.light);
    put(draw.caster);
    put(draw.mesh->id());
    const Volume& volume = *draw.volume;
    // Strategies that remember find the same silhouette in another order.
    const std::span indices(volume.indices);
    const std::size_t side = volume.made_with.one_far_point() ? 3 : 6;
    std::multiset<std::vector<std::uint32_t>> sides;
    for (std::size_t i = 0; i < volume.sides.count; i += side) {
        const auto one = indices.subspan(volume.sides.first + i, side);
        sides.emplace(one.begin(), one.end());
    }
    for (const auto& one : sides) {
        for (const std::uint32_t index : one) put(index);
    }
    // How caps are put together is said where one is drawn, else which faces they are.
    const bool caps = draw.technique == Technique::DepthFail || draw.near_caps || draw.far_caps ||
                      !draw.slabs.empty();
    for (const CapList& list : volume.near_caps()) {
        put(list.faces);
        for_each_cap_face(*draw.mesh, volume, list, put);
        if (!caps || draw.bounds.empty()) continue;
        for (const std::uint32_t index : indices.subspan(list.triples.first, list.triples.count)) {
            put(index);
        }
        put(list);
    }
    if (caps && !draw.bounds.empty()) {
        for (const FaceRange& range : volume.ranges) put(range);
        put(volume.far_cap.count);
        put(volume.far_copies);
    }
    put(volume.silhouette_edges);
    if (draw.quads) {
        put(draw.quads->facing);
        put(draw.quads->near_caps);
        put(draw.quads->light);
        if (draw.quads->bits != nullptr) {
            for (const std::uint32_t word : *draw.quads->bits) put(word);
        }
    }
    put(draw.world_from_local);
    put(draw.world_from_far);
    put(draw.extrusion.scale);
    put(draw.extrusion.offset);
    put(draw.technique);
    put(draw.near_caps);
    put(draw.mirrored);
    put(draw.batch);
    for (const VolumeSlab& slab : draw.slabs) {
        put(slab.world_from_near);
        put(slab.world_from_far);
        put(slab.bounds.min);
        put(slab.bounds.max);
        put(slab.from_plane);
        put(slab.near_caps);
        put(slab.far_caps);
    }
    return text;
}

void expect_same(const DrawList& list, const DrawList& expected) {
    ASSERT_EQ(list.lights.size(), expected.lights.size());
    for (std::size_t i = 0; i < list.lights.size(); ++i) {
        ASSERT_EQ(list.lights[i].light, expected.lights[i].light);
        ASSERT_EQ(list.lights[i].first, expected.lights[i].first);
        ASSERT_EQ(list.lights[i].count, expected.lights[i].count);
        ASSERT_EQ(list.lights[i].batches, expected.lights[i].batches);
    }
    ASSERT_EQ(list.draws.size(), expected.draws.size());
    for (std::size_t i = 0; i < list.draws.size(); ++i) {
        ASSERT_EQ(described(list.draws[i]), described(expected.draws[i])) << "draw " << i;
    }
    const FrameStats& a = list.stats;
    const FrameStats& b = expected.stats;
    EXPECT_EQ(a.casters, b.casters);
    EXPECT_EQ(a.lights, b.lights);
    EXPECT_EQ(a.pairs, b.pairs);
    EXPECT_EQ(a.pairs_culled, b.pairs_culled);
    EXPECT_EQ(a.zpass_pairs, b.zpass_pairs);
    EXPECT_EQ(a.zfail_pairs, b.zfail_pairs);
    EXPECT_EQ(a.silhouette_edges, b.silhouette_edges);
    EXPECT_EQ(a.stencil_batches, b.stencil_batches);
    EXPECT_EQ(a.split_lights, b.split_lights);
}

// All but times.
void expect_same_stats(const FrameStats& a, const FrameStats& b) {
    EXPECT_EQ(a.pairs_redetected, b.pairs_redetected);
    EXPECT_EQ(a.pairs_reused, b.pairs_reused);
    EXPECT_EQ(a.detection.faces_tested, b.detection.faces_tested);
    EXPECT_EQ(a.reasons, b.reasons);
}

// A world that changes a little, much, or not at all from frame to frame.
struct World {
    std::vector<std::shared_ptr<const ShadowMesh>> meshes;
    std::map<std::uint64_t, Caster> casters;
    std::map<std::uint64_t, Light> lights;
    std::vector<std::uint64_t> gone_casters, gone_lights;  // in the last step
    std::vector<std::uint64_t> new_casters, new_lights;    // submitted anew in the last step
    View view = some_view();

    explicit World(Random& random) {
        meshes.push_back(test::build(test::box()));
        meshes.push_back(test::build(test::sphere(6, 7)));
        meshes.push_back(test::build(test::sheet(2)));
        meshes.push_back(test::build({}));
        for (int i = 0; i < 6; ++i) meshes.push_back(test::build(test::random_mesh(random)));
        for (int i = 0; i < 12; ++i) put_caster(random, random.below(40));
        for (int i = 0; i < 3; ++i) put_light(random, random.below(10));
    }

    glm::dmat4 random_pose(Random& random) const {
        glm::dmat4 pose = at(random.in_cube(8.0)) * glm::dmat4(random.rotation());
        if (random.chance(0.1)) pose = glm::scale(pose, glm::dvec3(1.0, 0.0, 1.0));
        if (random.chance(0.1)) pose = glm::scale(pose, glm::dvec3(-1.0, 2.0, 1.0));
        if (random.chance(0.03)) pose[3].x = std::numeric_limits<double>::quiet_NaN();
        return pose;
    }
    void put_caster(Random& random, std::uint64_t key) {
        casters[key] = {.key = key,
                        .mesh = meshes[random.below(static_cast<std::uint32_t>(meshes.size()))],
                        .world_from_local = random_pose(random),
                        .in_depth_buffer = random.chance(0.7),
                        .near_caps = random.chance(0.2) ? NearCaps::Averted : NearCaps::Facing};
        new_casters.push_back(key);
    }
    void put_light(Random& random, std::uint64_t key) {
        lights[key] = {.key = key,
                       .position_world = glm::dvec4(random.in_cube(10.0) + glm::dvec3(0, 8, 0),
                                                    random.chance(0.4) ? 0.0 : 1.0)};
        if (random.chance(0.3)) lights[key].range_m = random.uniform(3.0, 15.0);
        new_lights.push_back(key);
    }
    template <class T>
    std::uint64_t any_key(Random& random, const std::map<std::uint64_t, T>& of) {
        return std::next(of.begin(), random.below(static_cast<std::uint32_t>(of.size())))->first;
    }

    void step(Random& random) {
        gone_casters.clear();
        gone_lights.clear();
        new_casters.clear();
        new_lights.clear();
        if (random.chance(0.3)) return;
        if (random.chance(0.3)) {
            view.view_from_world =
                look_at(random.in_cube(20.0), random.in_cube(2.0), random.unit_vector());
        }
        if (random.chance(0.05)) {
            const bool infinite = view.projection == ProjectionKind::InfinitePerspective;
            view.projection =
                infinite ? ProjectionKind::Orthographic : ProjectionKind::InfinitePerspective;
            view.clip_from_view =
                infinite ? orthographic(20, 15, 0.1, 100) : infinite_perspective(1, 1.5, 0.1);
        }
        for (std::uint32_t i = random.below(4); i > 0 && !casters.empty(); --i) {
            const std::uint64_t key = any_key(random, casters);
            Caster& caster = casters[key];
            const std::uint32_t what = random.below(6);
            if (what == 0) caster.world_from_local = random_pose(random);
            if (what == 1) caster.world_from_local[3].y += random.uniform(-1e-3, 1e-3);
            if (what == 2) caster.mesh = meshes[random.below(4)];
            if (what == 3) caster.in_depth_buffer = !caster.in_depth_buffer;
            if (what == 4) put_caster(random, random.below(40));
            if (what == 5) {
                gone_casters.push_back(key);
                casters.erase(key);
            } else {
                new_casters.push_back(key);
            }
        }
        if (random.chance(0.2) && !lights.empty()) {
            const std::uint64_t key = any_key(random, lights);
            lights[key].position_world += glm::dvec4(random.in_cube(0.3), 0.0);
            new_lights.push_back(key);
        }
        if (random.chance(0.08)) put_light(random, random.below(10));
        if (random.chance(0.08) && !lights.empty()) {
            const std::uint64_t key = any_key(random, lights);
            gone_lights.push_back(key);
            lights.erase(key);
        }
    }

    const DrawList& full(ShadowSystem& system, Random* shuffled = nullptr) const {
        std::vector<std::uint64_t> order;
        for (const auto& [key, caster] : casters) order.push_back(key);
        if (shuffled != nullptr) {
            std::shuffle(order.begin(), order.end(), std::mt19937(shuffled->bits()));
        }
        auto frame = system.begin_frame();
        for (const std::uint64_t key : order) frame.caster(casters.at(key));
        for (const auto& [key, light] : lights) frame.light(light);
        return std::move(frame).finish(view);
    }
    // In one frame a key may have gone and come again, or come and gone.
    const DrawList& delta(ShadowSystem& system) const {
        auto frame = system.begin_frame(Submission::Delta);
        for (const std::uint64_t key : gone_casters) frame.remove_caster(key);
        for (const std::uint64_t key : gone_lights) frame.remove_light(key);
        for (const std::uint64_t key : new_casters) {
            if (const auto found = casters.find(key); found != casters.end())
                frame.caster(found->second);
        }
        for (const std::uint64_t key : new_lights) {
            if (const auto found = lights.find(key); found != lights.end())
                frame.light(found->second);
        }
        return std::move(frame).finish(view);
    }
};

// SystemOptions::max_layers and silhouette.
class ManyPairs : public testing::TestWithParam<std::tuple<std::uint32_t, std::string>> {
protected:
    [[nodiscard]] static std::uint32_t max_layers() { return std::get<0>(GetParam()); }
    [[nodiscard]] static SystemOptions options() {
        SystemOptions options{.silhouette = std::get<1>(GetParam()),
                              .max_layers = max_layers(),
                              .fill = FillOptions::none()};
        if (for_the_gpu()) options.layer_bound = LayerBound::Promised;
        return options;
    }
    // What was taken back from the GPU stays so until it is detected anew: where layers are to be
    // proved, the list depends on what came before.
    [[nodiscard]] static bool for_the_gpu() {
        const SilhouetteStrategy* strategy = find_strategy(std::get<1>(GetParam()));
        return strategy->quads != QuadFacing::None;
    }
};

// One that keeps nothing, one that does, those that leave work to the GPU, and the choice.
std::vector<std::string> strategies() {
    return {"auto", "brute_force", "certificates", "gpu_quads", "gpu_quads_float"};
}

TEST_P(ManyPairs, GiveTheListOfASystemThatSawNothingBefore) {
    GNOMON_RANDOM(random);
    const SystemOptions options = ManyPairs::options();
    std::uint64_t reused = 0;
    for (int run = 0; run < 12; ++run) {
        World world(random);
        ShadowSystem full = *ShadowSystem::create(options);
        ShadowSystem shuffled = *ShadowSystem::create(options);
        ShadowSystem delta = *ShadowSystem::create(options);
        SystemOptions threads = options;
        threads.jobs = thread_jobs(3);
        ShadowSystem threaded = *ShadowSystem::create(threads);
        for (int step = 0; step < 60; ++step) {
            SCOPED_TRACE(testing::Message() << "run " << run << ", step " << step);
            ShadowSystem fresh = *ShadowSystem::create(
                for_the_gpu() ? options
                              : SystemOptions{.max_layers = max_layers(), .fill = options.fill});
            const DrawList& expected = world.full(fresh);
            const DrawList& list = world.full(full);
            expect_same(list, expected);
            reused += list.stats.pairs_reused;
            for (const DrawList* other :
                 {&world.full(shuffled, &random), &world.delta(delta), &world.full(threaded)}) {
                expect_same(*other, expected);
                expect_same_stats(other->stats, list.stats);
            }
            if (HasFailure()) return;
            world.step(random);
        }
    }
    EXPECT_GT(reused, 10'000U);
}

TEST_P(ManyPairs, SayWhyEachIsWhatItIsAndWhetherTheListIsAnother) {
    GNOMON_RANDOM(random);
    World world(random);
    ShadowSystem system = *ShadowSystem::create(options());
    std::uint64_t same = 0;
    std::uint64_t other = 0;
    DrawList before = world.full(system);
    for (int step = 0; step < 400; ++step) {
        SCOPED_TRACE(step);
        world.step(random);
        const DrawList& list = world.full(system);
        // A draw that was made anew says so, and no other does.
        std::map<std::pair<std::uint64_t, std::uint64_t>, std::shared_ptr<const Volume>> known;
        for (const VolumeDraw& draw : before.draws) known[{draw.light, draw.caster}] = draw.volume;
        std::array<std::uint64_t, reason_count> reasons{};
        std::pair<std::uint64_t, std::uint64_t> last{~0ULL, ~0ULL};
        for (const VolumeDraw& draw : list.draws) {
            const bool part = draw.batch > 0 || list.lights.size() != world.lights.size();
            if (max_layers() == 255 && !part) {
                const bool kept = known[{draw.light, draw.caster}] == draw.volume;
                const bool says_kept =
                    draw.reason == Reason::Unchanged || draw.reason == Reason::WithinMargin;
                // A detector may find that nothing changed though the light moved on.
                // Caps are put together when one is drawn.
                const auto& had = known[{draw.light, draw.caster}];
                const bool capped = had != nullptr && had->made_with.caps.are_ranges_alone() &&
                                    (draw.technique == Technique::DepthFail || draw.near_caps ||
                                     draw.far_caps || !draw.slabs.empty());
                ASSERT_TRUE(kept || capped || !says_kept) << to_string(draw.reason);
            }
            if (std::pair(draw.light, draw.caster) != last) {
                ++reasons[static_cast<std::size_t>(draw.reason)];
            }
            last = {draw.light, draw.caster};
        }
        for (std::size_t r = 0; max_layers() == 255 && r < reason_count; ++r) {
            ASSERT_LE(reasons[r], list.stats.reasons[r]) << to_string(static_cast<Reason>(r));
        }
        bool equal =
            list.draws.size() == before.draws.size() && list.lights.size() == before.lights.size();
        for (std::size_t i = 0; equal && i < list.lights.size(); ++i) {
            equal = list.lights[i].light == before.lights[i].light;
        }
        for (std::size_t i = 0; equal && i < list.draws.size(); ++i) {
            equal = described(list.draws[i]) == described(before.draws[i]) &&
                    list.draws[i].revision == before.draws[i].revision;
        }
        if (list.revision == before.revision) {
            ASSERT_TRUE(equal);
            ++same;
        } else {
            ++other;
        }
        // Said twice, everything is unchanged and the list the same.
        const std::uint64_t revision = list.revision;
        for (int again = 0; again < 3; ++again) {
            const DrawList& quiet = world.full(system);
            ASSERT_EQ(quiet.revision, revision);
            ASSERT_EQ(quiet.stats.pairs_redetected, 0U);
            ASSERT_EQ(quiet.stats.detection.faces_tested, 0U);
            ASSERT_EQ(quiet.stats.pairs_reused, quiet.stats.pairs - quiet.stats.pairs_culled);
            ASSERT_EQ(quiet.stats.reasons[0] + quiet.stats.pairs_culled, quiet.stats.pairs);
            for (const VolumeDraw& draw : quiet.draws) ASSERT_EQ(draw.reason, Reason::Unchanged);
        }
        before = list;
    }
    EXPECT_GT(same, 50U);
    EXPECT_GT(other, 50U);
}

INSTANTIATE_TEST_SUITE_P(Options, ManyPairs,
                         testing::Combine(testing::Values(2U, 12U, 255U),
                                          testing::ValuesIn(strategies())),
                         [](const auto& row) {
                             return "layers_" + std::to_string(std::get<0>(row.param)) + "_" +
                                    std::get<1>(row.param);
                         });

// Of the draws, by revision: systems of one process share the numbers.
std::vector<std::size_t> order_of_revisions(const DrawList& list) {
    std::vector<std::size_t> order(list.draws.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return list.draws[a].revision < list.draws[b].revision;
    });
    return order;
}

// Revisions follow the order of the work, whoever did it.
TEST(Threads, GiveTheSameListBitForBit) {
    GNOMON_RANDOM(random);
    World world(random);
    for (std::uint64_t key = 100; key < 400; ++key) world.put_caster(random, key);
    std::vector<ShadowSystem> systems;
    for (const unsigned threads : {1U, 2U, 8U}) {
        systems.push_back(*ShadowSystem::create({.jobs = thread_jobs(threads)}));
    }
    // A runner that keeps the order of nothing.
    systems.push_back(*ShadowSystem::create(
        {.jobs = [](std::size_t count, const std::function<void(std::size_t)>& task) {
            for (std::size_t i = count; i > 0; --i) task(i - 1);
        }}));
    ShadowSystem serial = *ShadowSystem::create();
    for (int step = 0; step < 5; ++step) {
        SCOPED_TRACE(step);
        const DrawList& expected = world.full(serial);
        for (ShadowSystem& system : systems) {
            const DrawList& list = world.full(system);
            expect_same(list, expected);
            expect_same_stats(list.stats, expected.stats);
            ASSERT_EQ(order_of_revisions(list), order_of_revisions(expected));
            for (std::size_t i = 0; i < list.draws.size(); ++i) {
                ASSERT_EQ(list.draws[i].reason, expected.draws[i].reason);
            }
        }
        for (auto& [key, light] : world.lights) light.position_world.x += 1.0;
        world.view.view_from_world = look_at(random.in_cube(20.0), {0, 0, 0}, {0, 1, 0});
    }
}

TEST(Threads, PassOnWhatATaskThrowsOnceAllAreDone) {
    for (const unsigned threads : {1U, 4U}) {
        const Jobs jobs = thread_jobs(threads);
        std::atomic<int> done{0};
        for (int round = 0; round < 20; ++round) {
            EXPECT_THROW(jobs(50,
                              [&](std::size_t i) {
                                  if (i == 7) throw std::bad_alloc();
                                  ++done;
                              }),
                         std::bad_alloc);
        }
        if (threads > 1) {
            EXPECT_EQ(done, 20 * 49);
        }
        done = 0;
        jobs(50, [&](std::size_t) { ++done; });
        EXPECT_EQ(done, 50);
    }
}

TEST(Threads, RunEachTaskOnceAndServeManyCallers) {
    const Jobs jobs = thread_jobs(4);
    std::vector<std::thread> callers;
    for (int caller = 0; caller < 3; ++caller) {
        callers.emplace_back([&jobs] {
            for (std::size_t count = 0; count < 200; ++count) {
                std::vector<int> runs(count);
                jobs(count, [&](std::size_t i) { ++runs[i]; });
                EXPECT_EQ(std::count(runs.begin(), runs.end(), 1),
                          static_cast<std::ptrdiff_t>(count));
            }
        });
    }
    for (std::thread& caller : callers) caller.join();
}

}  // namespace
}  // namespace gnomon::shadows
