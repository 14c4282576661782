// SPDX-License-Identifier: MIT
//
// The coarse sums of layers never say less than the sweep that they save, and are the same whatever
// was added and taken away before.
#include "internal/layer_grid.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows::internal {
namespace {

using test::Random;
using Row = std::pair<OrientedBounds, std::uint32_t>;

Row random_row(Random& random) {
    glm::dmat4 pose = glm::translate(glm::dmat4(1.0), random.in_cube(20.0)) *
                      glm::dmat4(random.rotation()) *
                      glm::scale(glm::dmat4(1.0), glm::dvec3(random.uniform(0.1, 2.0)));
    if (random.chance(0.05)) pose[3] *= 1e5;
    if (random.chance(0.02)) pose[0] *= 1e200;
    if (random.chance(0.01)) pose *= std::numeric_limits<double>::max();
    return {{pose, glm::dvec3(-1.0), glm::dvec3(1.0)}, random.below(random.chance(0.1) ? 300 : 6)};
}

std::vector<Footprint> footprints_of(const std::vector<Row>& rows, const glm::dvec4& light) {
    std::vector<Footprint> footprints;
    for (const auto& [bounds, layers] : rows) append_footprints(bounds, light, layers, footprints);
    return footprints;
}

TEST(LayerGrid, IsOnTheSafeSideAndKeptInStep) {
    GNOMON_RANDOM(random);
    int within = 0;
    int beyond = 0;
    for (int round = 0; round < 300; ++round) {
        const glm::dvec4 light(random.in_cube(30.0), random.chance(0.5) ? 1.0 : 0.0);
        const auto limit = static_cast<std::uint32_t>(random.integer(1, 255));
        std::vector<Row> rows;
        for (std::uint32_t i = random.below(200); i > 0; --i) rows.push_back(random_row(random));
        LayerGrid grid(light, footprints_of(rows, light), limit);
        for (int step = 0; step < 20; ++step) {
            if (!rows.empty() && random.chance(0.6)) {
                std::swap(rows[random.below(static_cast<std::uint32_t>(rows.size()))], rows.back());
                grid.remove(rows.back().first, rows.back().second);
                rows.pop_back();
            }
            if (random.chance(0.5)) {
                rows.push_back(random_row(random));
                grid.add(rows.back().first, rows.back().second);
            }
            if (grid.within_limit()) {
                ++within;
                ASSERT_LE(most_layers(footprints_of(rows, light)), limit);
            } else {
                ++beyond;
            }
        }
        for (const auto& [bounds, layers] : rows) grid.remove(bounds, layers);
        EXPECT_TRUE(grid.within_limit());
    }
    EXPECT_GT(within, 500);
    EXPECT_GT(beyond, 500);
}

TEST(LayerGrid, KnowsThatAFieldDoesNotPileUp) {
    std::vector<Row> rows;
    for (int x = 0; x < 100; ++x) {
        for (int z = 0; z < 100; ++z) {
            rows.push_back({{glm::translate(glm::dmat4(1.0), glm::dvec3(4.0 * x, 0.0, 4.0 * z)),
                             glm::dvec3(-1.0), glm::dvec3(1.0)},
                            2});
        }
    }
    for (const glm::dvec4& light : {glm::dvec4(0.3, 1.0, 0.2, 0.0), glm::dvec4(200, 80, 100, 1)}) {
        EXPECT_TRUE(LayerGrid(light, footprints_of(rows, light), 255).within_limit());
    }
}

}  // namespace
}  // namespace gnomon::shadows::internal
