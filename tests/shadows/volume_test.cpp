// SPDX-License-Identifier: MIT
//
// Volumes are closed as integers whatever the weights; caps keep the mesh's triples and order; and
// far vertices go where the extrusion says. What the volume counts is in count_test.cpp.
#include <gnomon/shadows/volume.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/shadows/facing.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

struct Made {
    std::vector<SilhouetteEdge> silhouette;
    Volume volume;
};

Made make(const ShadowMesh& mesh, const std::vector<std::int8_t>& weights, bool directional,
          FarVertices far_vertices) {
    Made made;
    find_silhouette(mesh, weights, made.silhouette);
    build_volume(mesh, weights, made.silhouette, directional, far_vertices, made.volume);
    return made;
}

std::vector<std::int8_t> weights_for(Random& random, const ShadowMesh& mesh, LightLocal light) {
    if (random.chance(0.5)) {
        Facing facing;
        classify_faces(mesh, light, facing);
        return facing.weights;
    }
    std::vector<std::int8_t> weights;
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
        weights.push_back(static_cast<std::int8_t>(random.integer(-2, 2)));
    }
    return weights;
}

// The near triples a cap must have, in the mesh's own order.
std::vector<std::uint32_t> cap(const ShadowMesh& mesh, const std::vector<std::int8_t>& weights,
                               int sign) {
    std::vector<std::uint32_t> indices;
    for (std::size_t f = 0; f < weights.size(); ++f) {
        for (int i = 0; i < sign * weights[f]; ++i) {
            for (const std::uint32_t v : mesh.faces()[f]) indices.push_back(2 * v);
        }
    }
    return indices;
}

std::vector<std::uint32_t> slice(const Volume& volume, const IndexRange& range) {
    const auto begin = volume.indices.begin() + range.first;
    return {begin, begin + range.count};
}

TEST(Volume, IsClosedForAnyMeshAnyLightAnyWeights) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 4'000; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        const LightLocal light = test::random_light(random, *mesh);
        const auto weights = weights_for(random, *mesh, light);
        const auto far = random.chance(0.5) ? FarVertices::AtInfinity : FarVertices::Finite;
        const bool one_far_point = light.is_directional() && far == FarVertices::AtInfinity;
        const auto [silhouette, volume] = make(*mesh, weights, light.is_directional(), far);

        ASSERT_TRUE(is_closed(*mesh, volume)) << "mesh " << i;

        // The ranges follow each other and hold what they must.
        std::uint32_t sides = 0;
        for (const SilhouetteEdge& e : silhouette) sides += static_cast<std::uint32_t>(e.count);
        std::uint32_t layers = 0;
        for (const int w : weights) layers += static_cast<std::uint32_t>(std::abs(w));
        ASSERT_EQ(volume.silhouette_edges, silhouette.size());
        ASSERT_EQ(volume.far_cap.first, 0U);
        ASSERT_EQ(volume.far_cap.count, one_far_point ? 0 : 3 * layers);
        ASSERT_EQ(volume.sides.first, volume.far_cap.count);
        ASSERT_EQ(volume.sides.count, sides * (one_far_point ? 3 : 6));
        const IndexRange& near = volume.near_cap.triples;
        ASSERT_EQ(near.first, volume.sides.first + volume.sides.count);
        const IndexRange& flipped = volume.near_cap_flipped.triples;
        ASSERT_EQ(flipped.first, near.first + near.count);
        ASSERT_EQ(volume.near_cap_averted.triples.first, flipped.first + flipped.count);
        ASSERT_EQ(volume.near_cap_averted.triples.count, 0U);
        ASSERT_EQ(volume.indices.size(), flipped.first + flipped.count);
        ASSERT_TRUE(volume.ranges.empty());
        ASSERT_EQ(volume.far_copies, FarCopies::None);

        ASSERT_EQ(slice(volume, near), cap(*mesh, weights, 1));
        ASSERT_EQ(slice(volume, flipped), cap(*mesh, weights, -1));
        for (const std::uint32_t index : slice(volume, volume.far_cap)) ASSERT_EQ(index % 2, 1U);
        for (const std::uint32_t index : volume.indices) {
            ASSERT_LT(index, 2 * mesh->positions().size());
        }
    }
}

TEST(Volume, WithRangesIsTheSameTriangles) {
    GNOMON_RANDOM(random);
    // How often each triangle is drawn; what is undone adds nothing. Far caps are turned round
    // where they are written out.
    using Drawn = std::map<std::array<std::uint32_t, 3>, int>;
    const auto drawn = [](const ShadowMesh& mesh, const Volume& volume) {
        Drawn triangles;
        for_each_triangle(mesh, volume, [&](std::array<std::uint32_t, 3> t, bool exchanged) {
            int sign = exchanged ? -1 : 1;
            const bool far = (t[0] & t[1] & t[2] & 1U) != 0;
            if (far && t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
                std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
                if (t[1] > t[2]) {
                    std::swap(t[1], t[2]);
                    sign = -sign;
                }
            } else if (far) {
                return;  // a triangle with two corners at one place is nothing
            }
            triangles[t] += sign;
        });
        std::erase_if(triangles, [](const auto& entry) { return entry.second == 0; });
        return triangles;
    };
    std::size_t with_ranges = 0;
    std::size_t limited = 0;
    std::size_t better = 0;
    std::size_t undone = 0;
    std::size_t recapped = 0;
    Volume unlimited_volume;
    std::array<std::size_t, 3> kinds{};
    std::array<std::size_t, 3> copies{};
    for (int i = 0; i < 4'000; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        const LightLocal light = test::random_light(random, *mesh);
        std::vector<std::int8_t> weights = weights_for(random, *mesh, light);
        std::vector<std::uint8_t> averted;
        if (random.chance(0.5)) {
            Facing facing;
            classify_faces(*mesh, light, facing, NearCaps::Averted);
            weights = facing.weights;
            averted = facing.solid_averted;
        }
        const VolumeOptions options{
            light.is_directional(),
            random.chance(0.5) ? FarVertices::AtInfinity : FarVertices::Finite,
            {.draw_worth_faces = random.below(12), .max_ranges = random.below(6)}};
        std::vector<SilhouetteEdge> silhouette;
        find_silhouette(*mesh, weights, silhouette);
        std::vector<FaceRun> casting;
        runs_of(weights, casting);
        Volume plain;
        build_volume(*mesh, weights, silhouette, options.directional, options.far_vertices, plain,
                     averted);
        Volume volume;
        build_volume(*mesh, casting, silhouette, options, volume, averted);
        ASSERT_EQ(drawn(*mesh, volume), drawn(*mesh, plain)) << "mesh " << i;
        for (std::size_t k = 0; k < 3; ++k) {
            const CapList list = volume.near_caps()[k];
            ASSERT_EQ(list.faces, plain.near_caps()[k].faces);
            kinds[k] += list.ranges.count > 0 ? 1 : 0;
        }
        // Ranges alone, in room that another volume had, and their caps put together after all.
        Volume of_ranges = plain;
        VolumeOptions alone = options;
        alone.caps = CapOptions::ranges_alone();
        build_volume(*mesh, casting, silhouette, alone, of_ranges, averted);
        ASSERT_EQ(drawn(*mesh, of_ranges), drawn(*mesh, plain)) << "mesh " << i;
        ASSERT_TRUE(is_closed(*mesh, of_ranges));
        const bool once = std::ranges::all_of(
            casting, [](const FaceRun& run) { return std::abs(run.weight) == 1; });
        if (once) {
            ASSERT_EQ(of_ranges.indices.size(), of_ranges.sides.count);
            const Volume capped = with_caps(*mesh, of_ranges, options.caps);
            ASSERT_EQ(capped.indices, volume.indices);
            ASSERT_EQ(capped.ranges, volume.ranges);
            ASSERT_EQ(capped.far_copies, volume.far_copies);
            for (std::size_t k = 0; k < 3; ++k) {
                const CapList a = capped.near_caps()[k];
                const CapList b = volume.near_caps()[k];
                ASSERT_EQ(a.faces, b.faces);
                ASSERT_EQ(a.ranges.count, b.ranges.count);
                ASSERT_EQ(a.triples.count, b.triples.count);
                ASSERT_EQ(a.undone.count, b.undone.count);
            }
            ++recapped;
        }
        // No worse than either extreme, nor than a range for each run that is long enough.
        const CapOptions& caps = options.caps;
        ASSERT_LE(volume.ranges.size(), caps.max_ranges);
        const auto cost = [&](const Volume& v) {
            std::size_t faces = 0;
            for (const CapList& list : v.near_caps()) {
                faces += (list.triples.count + list.undone.count) / 3;
            }
            return faces + v.ranges.size() * caps.draw_worth_faces;
        };
        std::size_t run_by_run = 0;
        for (const FaceRun& run : casting) {
            const auto weight = static_cast<std::size_t>(std::abs(run.weight));
            run_by_run += std::min<std::size_t>(run.count * weight,
                                                caps.draw_worth_faces + run.count * (weight - 1));
        }
        VolumeOptions unlimited = options;
        unlimited.caps.max_ranges = 1'000;
        build_volume(*mesh, casting, silhouette, unlimited, unlimited_volume, averted);
        ASSERT_LE(cost(unlimited_volume), cost(volume));
        ASSERT_LE(cost(unlimited_volume), cost(plain));
        if (averted.empty()) {
            ASSERT_LE(cost(unlimited_volume), run_by_run);
        }
        better += cost(unlimited_volume) < run_by_run ? 1 : 0;
        limited += unlimited_volume.ranges.size() > caps.max_ranges ? 1 : 0;
        undone += volume.near_cap.undone.count > 0 ? 1 : 0;
        with_ranges += volume.ranges.empty() ? 0 : 1;
        ++copies[static_cast<std::size_t>(volume.far_copies)];
    }
    EXPECT_GT(with_ranges, 1'000U);
    EXPECT_GT(limited, 300U);
    EXPECT_GT(better, 300U);
    EXPECT_GT(undone, 300U);
    EXPECT_GT(recapped, 1'000U);
    for (const std::size_t count : kinds) EXPECT_GT(count, 50U);
    for (const std::size_t count : copies) EXPECT_GT(count, 200U);
}

TEST(Volume, ChoosesRangesSoThatLittleIsWritten) {
    const auto mesh = test::build(test::sphere(8, 12));
    Volume volume;
    using Runs = std::vector<FaceRun>;
    using Ranges = std::vector<FaceRange>;
    const auto ranges = [&](const Runs& casting, std::uint32_t most = 9) {
        build_volume(*mesh, casting, {}, {.caps = {.draw_worth_faces = 10, .max_ranges = most}},
                     volume);
        return volume.ranges;
    };
    EXPECT_TRUE(ranges({{0, 9, 1}}).empty());
    EXPECT_EQ(ranges({{0, 11, 1}}), (Ranges{{0, 11}}));

    EXPECT_EQ(ranges({{0, 100, 1}, {104, 50, 1}}), (Ranges{{0, 154}})) << "a gap is undone";
    EXPECT_EQ(volume.near_cap.undone.count, 3U * 4);
    EXPECT_EQ(slice(volume, volume.near_cap.undone)[3], 2 * mesh->faces()[101][0]);
    EXPECT_EQ(volume.near_cap.triples.count, 0U);
    EXPECT_EQ(volume.near_cap.faces, 150U);
    std::size_t visited = 0;
    for_each_cap_face(*mesh, volume, volume.near_cap, [&](const auto& face) {
        EXPECT_EQ(face, mesh->faces()[visited + (visited < 100 ? 0 : 4)]);
        ++visited;
    });
    EXPECT_EQ(visited, 150U);
    EXPECT_EQ(ranges({{0, 100, 1}, {120, 40, 1}}), (Ranges{{0, 100}, {120, 40}})) << "or is not";

    EXPECT_EQ(ranges({{0, 100, -1}, {100, 4, 1}, {104, 50, -1}}), (Ranges{{0, 154}}));
    EXPECT_EQ(volume.near_cap_flipped.undone.count, 3U * 4);
    EXPECT_EQ(volume.near_cap.triples.count, 3U * 4) << "and what casts the other way is written";

    EXPECT_EQ(ranges({{0, 60, 2}}), (Ranges{{0, 60}})) << "once in a range, once written";
    EXPECT_EQ(volume.near_cap.triples.count, 3U * 60);

    const Runs three{{0, 20, 1}, {45, 30, 1}, {87, 40, 1}};
    EXPECT_EQ(ranges(three), (Ranges{{0, 20}, {45, 30}, {87, 40}}));
    EXPECT_EQ(ranges(three, 2), (Ranges{{0, 20}, {45, 82}}));
    EXPECT_EQ(ranges(three, 1), (Ranges{{45, 82}}));
    EXPECT_TRUE(ranges(three, 0).empty());
}

TEST(Volume, WithAFanIsClosedAsWell) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 2'000; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        const LightLocal light = test::random_light(random, *mesh);
        const auto weights = weights_for(random, *mesh, light);
        const auto far = random.chance(0.5) ? FarVertices::AtInfinity : FarVertices::Finite;
        std::vector<SilhouetteEdge> silhouette;
        find_silhouette(*mesh, weights, silhouette);
        std::vector<FaceRun> casting;
        runs_of(weights, casting);
        Volume volume;
        build_volume(*mesh, casting, silhouette,
                     {light.is_directional(), far, {.far_cap = FarCap::Fan, .draw_worth_faces = 3}},
                     volume);
        ASSERT_TRUE(is_closed(*mesh, volume)) << "mesh " << i;
        ASSERT_EQ(volume.far_copies, FarCopies::None);
        ASSERT_EQ(volume.far_cap.count,
                  volume.made_with.one_far_point() ? 0 : volume.sides.count / 2);
    }
}

TEST(Volume, IsClosedWithCapsOnAvertedFaces) {
    GNOMON_RANDOM(random);
    int with_averted = 0;
    int with_others = 0;
    int same_outlines = 0;
    for (int i = 0; i < 4'000; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        const LightLocal light = test::random_light(random, *mesh);
        const auto far = random.chance(0.5) ? FarVertices::AtInfinity : FarVertices::Finite;
        Facing averted;
        classify_faces(*mesh, light, averted, NearCaps::Averted);
        std::vector<SilhouetteEdge> silhouette;
        find_silhouette(*mesh, averted.weights, silhouette);
        Volume volume;
        build_volume(*mesh, averted.weights, silhouette, light.is_directional(), far, volume,
                     averted.solid_averted);
        ASSERT_TRUE(is_closed(*mesh, volume)) << "mesh " << i;

        // The caps of solids come last, and the others are as they are without them.
        std::vector<std::int8_t> of_solids(averted.weights.size(), 0);
        std::vector<std::int8_t> of_others = averted.weights;
        for (std::size_t f = 0; f < of_solids.size(); ++f) {
            if (averted.solid_averted[mesh->face_components()[f]] == 0) continue;
            std::swap(of_solids[f], of_others[f]);
        }
        const CapList& of_averted = volume.near_cap_averted;
        const CapList& rest = volume.near_cap_flipped;
        ASSERT_EQ(slice(volume, of_averted.triples), cap(*mesh, of_solids, -1));
        ASSERT_EQ(slice(volume, volume.near_cap.triples), cap(*mesh, of_others, 1));
        ASSERT_EQ(slice(volume, rest.triples), cap(*mesh, of_others, -1));
        with_averted += of_averted.faces > 0 ? 1 : 0;
        with_others += of_averted.faces > 0 && rest.faces > 0 ? 1 : 0;

        // Where no face is edge-on, both kinds end at the same edges, run the same way.
        Facing facing;
        classify_faces(*mesh, light, facing);
        bool edge_on = false;
        for (std::size_t f = 0; f < facing.weights.size(); ++f) {
            edge_on = edge_on || (facing.weights[f] == 0 && averted.weights[f] == 0);
        }
        if (edge_on) continue;
        std::vector<SilhouetteEdge> outline;
        find_silhouette(*mesh, facing.weights, outline);
        ASSERT_EQ(silhouette, outline) << "mesh " << i;
        same_outlines += volume.near_cap_averted.faces > 0 ? 1 : 0;
    }
    EXPECT_GT(with_averted, 300);
    EXPECT_GT(with_others, 10);
    EXPECT_GT(same_outlines, 100);
}

TEST(Volume, ReplacesWhatWasThereBefore) {
    const auto mesh = test::build(test::box());
    const std::vector<std::int8_t> weights(12, 0);
    Volume volume;
    volume.indices = {1, 2, 3};
    volume.ranges = {{0, 4}};
    volume.silhouette_edges = 5;
    build_volume(*mesh, weights, {}, false, FarVertices::AtInfinity, volume);
    EXPECT_TRUE(volume.empty());
    EXPECT_EQ(volume.silhouette_edges, 0U);
    EXPECT_TRUE(is_closed(*mesh, volume));
}

// ---------------------------------------------------------------------------------------------
// is_closed must be able to say no

class BrokenVolume : public ::testing::TestWithParam<bool> {
protected:
    [[nodiscard]] bool directional() const { return GetParam(); }
    [[nodiscard]] Volume whole() const {
        Facing facing;
        classify_faces(*mesh_, {glm::vec4(3, 4, 5, directional() ? 0 : 1)}, facing);
        // One averted face, so that no range is empty.
        facing.weights[static_cast<std::size_t>(
            std::find(facing.weights.begin(), facing.weights.end(), 0) - facing.weights.begin())] =
            -1;
        return make(*mesh_, facing.weights, directional(), FarVertices::AtInfinity).volume;
    }
    void expect_broken(const Volume& volume) const { EXPECT_FALSE(is_closed(*mesh_, volume)); }
    // The range's triangles become points, which have no edges.
    static void drop(Volume& volume, IndexRange range) {
        for (std::uint32_t i = 0; i < range.count; ++i) {
            volume.indices[range.first + i] = volume.indices[range.first];
        }
    }
    std::shared_ptr<const ShadowMesh> mesh_ = test::build(test::sphere(4, 6));
};

TEST_P(BrokenVolume, IsWholeBeforeItIsBroken) { EXPECT_TRUE(is_closed(*mesh_, whole())); }

TEST_P(BrokenVolume, NoticesAnyMissingTriangle) {
    const Volume good = whole();
    for (std::uint32_t t = 0; t < good.indices.size(); t += 3) {
        Volume bad = good;
        drop(bad, {t, 3});
        expect_broken(bad);
    }
}

TEST_P(BrokenVolume, NoticesAnyFlippedTriangle) {
    const Volume good = whole();
    for (std::uint32_t t = 0; t < good.indices.size(); t += 3) {
        Volume bad = good;
        std::swap(bad.indices[t + 1], bad.indices[t + 2]);
        expect_broken(bad);
    }
}

TEST_P(BrokenVolume, NoticesAMissingCap) {
    const Volume good = whole();
    for (const IndexRange& range :
         {good.sides, good.near_cap.triples, good.far_cap, good.near_cap_flipped.triples}) {
        if (range.count == 0) continue;  // directional: no far cap to miss
        Volume bad = good;
        drop(bad, range);
        expect_broken(bad);
    }
}

TEST_P(BrokenVolume, NoticesAMissingListOfFlippedCaps) {
    Volume bad = whole();
    bad.near_cap_flipped = {};
    expect_broken(bad);
}

TEST_P(BrokenVolume, NoticesFlippedCapsAmongTheOthers) {
    Volume bad = whole();
    bad.near_cap.triples.count += bad.near_cap_flipped.triples.count;
    bad.near_cap_flipped = {};
    expect_broken(bad);
}

TEST_P(BrokenVolume, NoticesAnyWrongRange) {
    mesh_ = test::build(test::torus(16, 24));  // with ranges far apart
    Facing facing;
    classify_faces(*mesh_, {glm::vec4(3, 4, 5, directional() ? 0 : 1)}, facing);
    std::vector<SilhouetteEdge> silhouette;
    find_silhouette(*mesh_, facing.weights, silhouette);
    std::vector<FaceRun> casting;
    runs_of(facing.weights, casting);
    Volume good;
    build_volume(*mesh_, casting, silhouette,
                 {directional(), FarVertices::AtInfinity, {.draw_worth_faces = 2}}, good);
    EXPECT_TRUE(is_closed(*mesh_, good));
    ASSERT_GT(good.ranges.size(), 1U);
    ASSERT_GT(good.near_cap.undone.count, 0U);
    Volume all_cast = good;
    all_cast.near_cap.undone.count = 0;
    expect_broken(all_cast);
    for (std::size_t i = 0; i < good.ranges.size(); ++i) {
        Volume bad = good;
        --bad.ranges[i].count;
        expect_broken(bad);
        bad = good;
        bad.ranges[i] = good.ranges[(i + 1) % good.ranges.size()];
        expect_broken(bad);
    }
    if (directional()) return;  // no far caps
    for (const FarCopies copies : {FarCopies::None, FarCopies::OfRanges, FarCopies::OfAll}) {
        if (copies == good.far_copies) continue;
        Volume bad = good;
        bad.far_copies = copies;
        if (bad.near_cap.triples.count > 0 || copies == FarCopies::None) expect_broken(bad);
    }
}

TEST_P(BrokenVolume, NoticesOneFacingBitThatOnlyTheSidesSaw) {
    Facing facing;
    classify_faces(*mesh_, {glm::vec4(3, 4, 5, directional() ? 0 : 1)}, facing);
    for (std::size_t f = 0; f < facing.weights.size(); ++f) {
        std::vector<std::int8_t> other = facing.weights;
        other[f] = static_cast<std::int8_t>(other[f] == 0 ? 1 : 0);
        std::vector<SilhouetteEdge> silhouette;
        find_silhouette(*mesh_, other, silhouette);
        Volume volume;
        build_volume(*mesh_, facing.weights, silhouette, directional(), FarVertices::AtInfinity,
                     volume);
        expect_broken(volume);
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, BrokenVolume, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "Directional" : "Point"; });

TEST(Volume, FarVerticesAreOnePointOnlyWhereTheyAreAtInfinity) {
    const auto mesh = test::build(test::box());
    Facing facing;
    classify_faces(*mesh, {{3, 4, 5, 0}}, facing);
    Volume at_infinity = make(*mesh, facing.weights, true, FarVertices::AtInfinity).volume;
    EXPECT_TRUE(is_closed(*mesh, at_infinity));
    at_infinity.made_with.directional = false;
    EXPECT_FALSE(is_closed(*mesh, at_infinity))
        << "the far ends are open unless they are one point";
    EXPECT_TRUE(is_closed(*mesh, make(*mesh, facing.weights, true, FarVertices::Finite).volume));
}

TEST(Volume, NeighboursSplitACommonSideAlike) {
    // The same edge in two meshes whose vertex numbers run the other way round.
    const auto one = test::build({{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {0, 1, 2}});
    const auto two = test::build({{{0, 0, 1}, {0, 0, 0}, {-1, 0, 0}}, {0, 1, 2}});
    const auto diagonal = [](const ShadowMesh& mesh) {
        // The side of the edge between (0,0,0) and (0,0,1): which near vertex has the diagonal?
        const std::vector<std::int8_t> weights{1};
        const Volume volume = make(mesh, weights, false, FarVertices::AtInfinity).volume;
        std::vector<glm::vec3> starts;
        for (std::uint32_t t = volume.sides.first; t < volume.sides.first + volume.sides.count;
             t += 3) {
            std::vector<std::uint32_t> near;
            std::vector<std::uint32_t> far;
            for (std::uint32_t i = 0; i < 3; ++i) {
                const std::uint32_t index = volume.indices[t + i];
                (index % 2 == 0 ? near : far).push_back(index / 2);
            }
            if (near.size() != 2) continue;
            const glm::vec3 a = mesh.positions()[near[0]];
            const glm::vec3 b = mesh.positions()[near[1]];
            if (a.x != 0.0F || b.x != 0.0F) continue;
            // The triangle with two near corners: its far corner ends the diagonal.
            starts.push_back(far[0] == near[0] ? b : a);
        }
        return starts;
    };
    ASSERT_EQ(diagonal(*one).size(), 1U);
    EXPECT_EQ(diagonal(*one), diagonal(*two));
    EXPECT_EQ(diagonal(*one)[0], glm::vec3(0, 0, 0)) << "the lexicographically smaller position";
}

// ---------------------------------------------------------------------------------------------
// Extrusion

TEST(Extrusion, AtInfinityIsTheWayFromTheLight) {
    const std::vector<glm::vec3> positions{{1, 2, 3}, {-4, 0.1F, 9}, {0, 0, 0}};
    std::vector<glm::vec4> far{{1, 1, 1, 1}};
    extrude(positions, infinite_extrusion({{5, -6, 7, 1}}), far);
    ASSERT_EQ(far.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(far[i], glm::vec4(positions[i] - glm::vec3(5, -6, 7), 0.0F));
    }
    extrude(positions, infinite_extrusion({{0.3F, 1, -2, 0}}), far);
    for (const glm::vec4& v : far) EXPECT_EQ(v, glm::vec4(-0.3F, -1, 2, 0)) << "all are one point";
}

TEST(Extrusion, DoesExactlyWhatTheShaderDoes) {
    GNOMON_RANDOM(random);
    std::vector<glm::vec4> far;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 p(random.in_cube(100.0));
        const Extrusion e{static_cast<float>(random.uniform(0.0, 5.0)),
                          glm::vec4(glm::vec3(random.in_cube(100.0)), 0.25F)};
        extrude(std::vector{p}, e, far);
        for (int c = 0; c < 3; ++c) {
            const float product = p[c] * e.scale;
            const float sum = product + e.offset[c];
            ASSERT_EQ(far[0][c], sum);
        }
        ASSERT_EQ(far[0].w, 0.25F);
    }
}

glm::dvec3 place(const glm::vec4& homogeneous) {
    return glm::dvec3(homogeneous) / static_cast<double>(homogeneous.w);
}

TEST(Extrusion, FiniteGoesReachTimesAsFarFromTheLight) {
    GNOMON_RANDOM(random);
    std::vector<glm::vec4> far;
    for (int i = 0; i < 2'000; ++i) {
        const glm::vec3 l(random.in_cube(20.0));
        const glm::vec3 p =
            l + glm::vec3(random.unit_vector() * std::pow(10.0, random.uniform(-3, 2)));
        const double reach = std::pow(10.0, random.uniform(0.1, 7.0));
        extrude(std::vector{p}, finite_extrusion({{l, 1.0F}}, reach), far);
        const glm::dvec3 expected = glm::dvec3(l) + reach * (glm::dvec3(p) - glm::dvec3(l));
        // Rounded as the light itself was: by single precision at the light's and p's coordinates.
        const double allowed =
            0x1p-22 * reach * (glm::length(glm::dvec3(l)) + glm::length(glm::dvec3(p)));
        ASSERT_LT(glm::length(place(far[0]) - expected), allowed) << "reach " << reach;
    }
    const glm::vec3 d(0.5F, -2.0F, 1.0F);
    const glm::vec3 p(3, 4, 5);
    extrude(std::vector{p}, finite_extrusion({{d, 0.0F}}, 64.0), far);
    EXPECT_EQ(place(far[0]), glm::dvec3(p) - 64.0 * glm::dvec3(d));
}

}  // namespace
}  // namespace gnomon::shadows
