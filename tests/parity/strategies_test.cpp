// SPDX-License-Identifier: MIT
//
// Whoever finds the silhouettes, the masks are the same bytes on every device: also where a
// strategy works from what it saw in the frames before, in which the lights came near.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <gnomon/shadows/detector.hpp>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/support/devices.hpp"
#include "tests/support/share.hpp"

namespace gnomon::test {
namespace {

class Strategies : public DeviceTest {};

TEST_P(Strategies, give_the_same_bytes) {
    std::uint64_t certified = 0;
    for (std::size_t i = 0; i < rows().size(); ++i) {
        const Row& row = rows()[i];
        SCOPED_TRACE(row.name);
        const Setting setting = row.make();
        PictureOptions options{.silhouette = "brute_force",
                               .approach_frames = 0,
                               .cull_back_faces = row.cull_back_faces};
        options.width /= 2;
        options.height /= 2;
        const Picture expected = must(take_picture(device(), setting, options));
        options.approach_frames = 4;
        std::vector<std::string> names{"auto"};
        for (const auto& strategy : shadows::silhouette_strategies()) {
            // Quadratic in the mesh; its answers are compared where meshes are small.
            if (strategy.name == "edge_stack_naive") continue;
            // In single precision: parity_quads has its devices, the truth its pictures.
            if (strategy.quads == shadows::QuadFacing::InShader) continue;
            names.emplace_back(strategy.name);
        }
        for (std::size_t n = 0; n < names.size(); ++n) {
            if (!falls_to(number(), i + n, 2)) continue;
            const std::string& name = names[n];
            options.silhouette = name;
            const Picture actual = must(take_picture(device(), setting, options));
            certified +=
                actual.list.stats.choices[static_cast<std::size_t>(shadows::Choice::SmallStep)];
            ASSERT_EQ(actual.masks.size(), expected.masks.size());
            for (std::size_t light = 0; light < expected.masks.size(); ++light) {
                const auto& a = actual.masks[light][0];
                const auto& e = expected.masks[light][0];
                EXPECT_EQ(differing_bytes(a, e), 0U)
                    << name << ", light " << light << ": "
                    << save_difference(fmt::format("strategies.{}.{}", row.name, name),
                                       options.width, options.height, a, e);
            }
        }
    }
    EXPECT_GT(certified, 0U) << "auto never took certificates";
}

INSTANTIATE_TEST_SUITE_P(Devices, Strategies, testing::ValuesIn(drawing_devices()),
                         device_case_name);

}  // namespace
}  // namespace gnomon::test
