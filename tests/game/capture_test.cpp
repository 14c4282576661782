// SPDX-License-Identifier: MIT
//
// What is kept of a frame, by its names: on the device that draws nothing.
#include "capture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <gnomon/gpu/null_backend.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "small_level.hpp"
#include "tests/support/paths.hpp"
#include "world.hpp"

namespace gnomon::game {
namespace {

using testing::ElementsAre;

/// Names of the files that are kept of a frame in which the lights with these places are switched.
std::set<std::string> kept(World& world, const std::vector<std::size_t>& off,
                           const std::vector<std::size_t>& unshadowed) {
    std::vector<std::uint64_t> keys;
    for (const MeterLight& light : world.stage().lights()) keys.push_back(light.shadow.key);
    std::ranges::sort(keys);
    DrawingOptions options{.width = 32, .height = 24, .samples = 1};
    for (const std::size_t i : off) options.off.push_back(scene::Entity::from_key(keys.at(i)));
    for (const std::size_t i : unshadowed) {
        options.unshadowed.push_back(scene::Entity::from_key(keys.at(i)));
    }
    gpu::Device device(gpu::create_null_backend());
    auto drawing = Drawing::create(device, world.stage(), options);
    EXPECT_TRUE(drawing);
    const std::filesystem::path folder = test::output_folder() / "game" / "kept";
    std::filesystem::remove_all(folder);
    auto capture = Capture::into(folder, true);
    EXPECT_TRUE(capture);
    const Status drawn =
        drawing->draw(world.stage(), world.level(), follow(world.level(), world.player(), 1.0),
                      capture->after_light(*drawing));
    EXPECT_TRUE(drawn) << drawn.error().message;
    const Status done = capture->keep(*drawing, 7);
    EXPECT_TRUE(done) << done.error().message;
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        names.insert(entry.path().filename().string());
    }
    return names;
}

TEST(Capture, a_lights_masks_keep_its_number_whichever_others_are_off) {
    Level level = bare_level();
    level.sun = noon(50.0);
    level.lamps = {{.at = {-2.0, 3.0, 0.0}}};  // and the exit has one
    auto world = World::create(level);
    ASSERT_TRUE(world) << world.error().message;
    ASSERT_EQ(world->stage().lights().size(), 3U);
    EXPECT_THAT(kept(*world, {}, {}),
                ElementsAre("tick_000007.light0.pgm", "tick_000007.light1.pgm",
                            "tick_000007.light2.pgm", "tick_000007.png"));
    EXPECT_THAT(kept(*world, {0}, {}),
                ElementsAre("tick_000007.light1.pgm", "tick_000007.light2.pgm", "tick_000007.png"));
    EXPECT_THAT(kept(*world, {1}, {0}), ElementsAre("tick_000007.light2.pgm", "tick_000007.png"));
}

}  // namespace
}  // namespace gnomon::game
