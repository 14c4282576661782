// SPDX-License-Identifier: MIT
//
// What fast detectors are made of, each part against the plain way: vectors against one by one, the
// hierarchies of boxes against their planes, deadlines against a list.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/orientation.hpp>

#include "modules/shadows/internal/deadlines.hpp"
#include "modules/shadows/internal/detection_tables.hpp"
#include "modules/shadows/internal/face_filter.hpp"
#include "modules/shadows/internal/kd_order.hpp"
#include "modules/shadows/internal/side_detection.hpp"
#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

TEST(DetectorParts, BlocksAreFilteredAlikeWithAndWithoutVectors) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 2'000; ++i) {
        const auto mesh =
            test::build(i % 3 == 0 ? test::wild_soup(random, 40) : test::random_mesh(random));
        const internal::FilterLight light =
            internal::filter_light(mesh->planes(), test::random_light(random, *mesh));
        const std::size_t blocks = (mesh->faces().size() + 15) / 16;
        std::vector<internal::FilteredBlock> fast(blocks);
        std::vector<internal::FilteredBlock> plain(blocks);
        internal::filter_blocks(mesh->planes(), light, 0, fast);
        internal::filter_blocks_plain(mesh->planes(), light, 0, plain);
        std::vector<std::int8_t> sides(mesh->faces().size());
        internal::filter_scalar(mesh->planes(), light, sides);
        for (std::size_t b = 0; b < blocks; ++b) {
            ASSERT_EQ(fast[b].decided, plain[b].decided);
            ASSERT_EQ(fast[b].facing, plain[b].facing);
            ASSERT_EQ(fast[b].nearest, plain[b].nearest);
        }
        for (std::size_t f = 0; f < sides.size(); ++f) {
            ASSERT_EQ((fast[f / 16].decided >> (f % 16)) & 1, sides[f] != 0 ? 1 : 0);
            ASSERT_EQ((fast[f / 16].facing >> (f % 16)) & 1, sides[f] > 0 ? 1 : 0);
        }
    }
}

TEST(DetectorParts, EdgesDifferAlikeWithAndWithoutVectors) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 1'000; ++i) {
        const auto mesh = test::build(i % 2 == 0 ? test::torus(7, 11) : test::random_mesh(random));
        std::vector<std::uint64_t> facing(mesh->faces().size() / 64 + 1);
        for (std::uint64_t& word : facing) {
            word = (std::uint64_t{random.bits()} << 32U) | random.bits();
        }
        const std::size_t edges = mesh->regular_edges();
        const std::size_t first = edges == 0 ? 0 : random.below(edges);
        std::vector<std::uint32_t> fast(edges - first + 8);
        std::vector<std::uint32_t> plain(fast.size());
        const std::size_t count =
            internal::differing_edges(mesh->uses(), first, edges - first, facing, fast.data());
        ASSERT_EQ(count, internal::differing_edges_plain(mesh->uses(), first, edges - first, facing,
                                                         plain.data()));
        fast.resize(count);
        plain.resize(count);
        ASSERT_EQ(fast, plain);
    }
}

// The hierarchy's answer for whole pieces is that of every plane in them; all blocks are there
// once.
TEST(DetectorParts, SettledBoxesAreRightAboutTheirFaces) {
    GNOMON_RANDOM(random);
    std::size_t settled_blocks = 0;
    for (int i = 0; i < 600; ++i) {
        const auto mesh =
            test::build(i % 3 == 0 ? test::sphere(24, 40) : test::random_mesh(random));
        const LightLocal light = test::random_light(random, *mesh);
        Facing facing;
        classify_faces(*mesh, light, facing);
        const internal::FilterLight filtered = internal::filter_light(mesh->planes(), light);
        std::vector<int> met((mesh->faces().size() + 15) / 16, 0);
        internal::DetectionTables tables = internal::make_tables(*mesh);
        tables.faces.visit(
            filtered,
            [&](std::size_t first, std::size_t count, bool towards, float) {
                settled_blocks += count;
                for (std::size_t b = first; b < first + count; ++b) ++met[b];
                const std::size_t end = std::min((first + count) * 16, mesh->faces().size());
                for (std::size_t f = first * 16; f < end; ++f) {
                    if (mesh->is_degenerate(f)) continue;
                    const auto& [a, b, c] = mesh->faces()[f];
                    const auto p = mesh->positions();
                    ASSERT_EQ(exact_facing(p[a], p[b], p[c], light), towards ? 1 : -1);
                }
            },
            [&](std::size_t block) { ++met[block]; });
        for (const int times : met) ASSERT_EQ(times, 1);
    }
    EXPECT_GT(settled_blocks, 1'000U);
}

TEST(DetectorParts, BoxesAreTestedAlikeWithAndWithoutVectors) {
    GNOMON_RANDOM(random);
    for (int i = 0; i < 20'000; ++i) {
        internal::BoxNode node;
        const float scale = std::pow(10.0F, static_cast<float>(random.uniform(-3.0, 3.0)));
        for (std::size_t box = 0; box < internal::boxes_per_node; ++box) {
            for (std::size_t d = 0; d < 4; ++d) {
                node.center[d][box] = static_cast<float>(random.uniform(-1.0, 1.0)) * scale;
                node.half[d][box] = static_cast<float>(random.uniform(0.0, 0.1)) * scale;
            }
            node.error[box] = static_cast<float>(random.uniform(0.0, 1e-5));
        }
        const internal::FilterLight light{glm::vec3(random.in_cube(3.0)),
                                          random.chance(0.5) ? 1.0F : 0.0F, 9.0F};
        const internal::BoxSides fast = internal::test_boxes(node, light);
        const internal::BoxSides plain = internal::test_boxes_plain(node, light);
        ASSERT_EQ(fast.facing, plain.facing);
        ASSERT_EQ(fast.averted, plain.averted);
        ASSERT_EQ(fast.nearest, plain.nearest);
    }
}

TEST(DetectorParts, DeadlinesAreAList) {
    GNOMON_RANDOM(random);
    for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 255U, 257U, 5'000U}) {
        internal::Deadlines deadlines;
        deadlines.resize(count);
        std::vector<double> list(count);
        for (std::size_t i = 0; i < count; ++i) {
            deadlines.values()[i] = list[i] = random.uniform(0.0, 1.0);
        }
        deadlines.rebuild();
        for (double time = 0.0; time < 3.0; time += random.uniform(0.0, 0.05)) {
            std::vector<std::uint32_t> expected;
            for (std::uint32_t i = 0; i < count; ++i) {
                if (list[i] < time) expected.push_back(i);
            }
            std::vector<std::uint32_t> due;
            const auto first_due = [&](std::size_t most) {
                due.clear();
                deadlines.visit_due(time, [&](std::size_t i) {
                    due.push_back(static_cast<std::uint32_t>(i));
                    return due.size() < most;
                });
                return due;
            };
            const std::size_t some = std::min<std::size_t>(3, expected.size());
            ASSERT_EQ(first_due(3),
                      std::vector(expected.begin(),
                                  expected.begin() + static_cast<std::ptrdiff_t>(some)));
            ASSERT_EQ(first_due(count + 1), expected);
            for (const std::uint32_t i : due) {
                deadlines.values()[i] = list[i] = time + random.uniform(0.0, 1.0);
            }
            deadlines.renew(due);
            const double next = list.empty() ? std::numeric_limits<double>::infinity()
                                             : *std::min_element(list.begin(), list.end());
            ASSERT_EQ(deadlines.next(), next);
        }
    }
}

TEST(DetectorParts, OrderKeepsNeighboursTogether) {
    GNOMON_RANDOM(random);
    std::vector<internal::KdItem> items(5'000);
    for (std::uint32_t i = 0; i < items.size(); ++i) {
        items[i].id = i;
        for (float& key : items[i].key) key = static_cast<float>(random.uniform(0.0, 1.0));
    }
    internal::kd_order(items);
    std::set<std::uint32_t> ids;
    double sides = 0.0;
    for (std::size_t begin = 0; begin + 16 <= items.size(); begin += 16) {
        float low = 1.0F;
        float high = 0.0F;
        for (std::size_t i = begin; i < begin + 16; ++i) {
            low = std::min(low, items[i].key[0]);
            high = std::max(high, items[i].key[0]);
        }
        sides += static_cast<double>(high - low);
    }
    for (const internal::KdItem& item : items) ids.insert(item.id);
    EXPECT_EQ(ids.size(), items.size());
    // Sixteen of 5,000 points in four dimensions: about a quarter of the unit in each.
    EXPECT_LT(sides / static_cast<double>(items.size() / 16), 0.4);
}

}  // namespace
}  // namespace gnomon::shadows
