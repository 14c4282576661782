// SPDX-License-Identifier: MIT
#include "level.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "assets.hpp"
#include "recording.hpp"
#include "tests/support/paths.hpp"
#include "world.hpp"

namespace gnomon::game {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

/// The smallest level, with more members between its braces.
std::string with(const std::string& more) {
    return R"({"format": "gnomon-level 1", "name": "small", "size_m": [10, 8],
"player": {"at": [-3, 0]}, "exit": {"at": [3, 0]})" +
           (more.empty() ? "" : ", " + more) + "}";
}

TEST(Level, the_smallest_one_has_a_start_and_an_exit) {
    const auto level = read_level(with(""), "small.json");
    ASSERT_TRUE(level) << level.error().message;
    EXPECT_EQ(level->name, "small");
    EXPECT_EQ(level->start, glm::dvec2(-3.0, 0.0));
    EXPECT_EQ(level->exit, glm::dvec2(3.0, 0.0));
    EXPECT_TRUE(level->blocks.empty());
}

TEST(Level, angles_are_given_in_degrees) {
    const auto level = read_level(
        with(R"("sun": {"from_deg": [90, 30]}, "doors": [{"hinge": [0, 0], "open_deg": -90}])"),
        "small.json");
    ASSERT_TRUE(level) << level.error().message;
    EXPECT_DOUBLE_EQ(level->sun->from_rad.x, glm::radians(90.0));
    EXPECT_EQ(level->sun->from_rad, level->sun->to_rad);
    EXPECT_DOUBLE_EQ(level->doors[0].open_rad, glm::radians(-90.0));
}

TEST(Level, walls_run_from_point_to_point_and_share_a_pier_where_they_meet) {
    const auto level =
        read_level(with(R"("walls": [{"from": [0, 0], "to": [4, 0]}, {"from": [4, 0], "to": [4, 3]},
                          {"from": [-4, 2], "to": [-1, 2], "base_m": 2.1, "height_m": 0.3}])"),
                   "small.json");
    ASSERT_TRUE(level) << level.error().message;
    ASSERT_EQ(level->blocks.size(), 6U) << "three walls and three piers; a lintel has none";
    EXPECT_EQ(level->blocks[0].at, glm::dvec2(2.0, 0.0));
    EXPECT_EQ(level->blocks[0].size_m.x, 4.0);
    EXPECT_EQ(level->blocks[1].at, glm::dvec2(4.0, 1.5));
    EXPECT_DOUBLE_EQ(std::abs(level->blocks[1].turn_rad), glm::radians(90.0));
}

struct Bad {
    const char* name;
    std::string text;
    std::string sentence;
};
void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.name; }

class BadLevels : public testing::TestWithParam<Bad> {};

TEST_P(BadLevels, are_refused_in_one_sentence) {
    const auto level = read_level(GetParam().text, "yard.json");
    ASSERT_FALSE(level);
    EXPECT_EQ(level.error().code, ErrorCode::InvalidInput);
    EXPECT_EQ(level.error().message, "yard.json: " + GetParam().sentence);
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadLevels,
    testing::Values(
        Bad{"no_json", "{\"format\": ", "the JSON is broken at byte 12 of 11."},
        Bad{"no_object", "[1, 2]", "the JSON is an array of 2, but must be an object."},
        Bad{"deep", std::string(40, '['), "the JSON is nested deeper than 16 levels at byte 16."},
        Bad{"huge_number", R"({"format": 1e999})", "the JSON holds a number that is too large."},
        Bad{"no_format", "{}", "the document has no member \"format\"."},
        Bad{"other_format", R"({"format": "gnomon-level 2"})",
            "format is \"gnomon-level 2\", but must be \"gnomon-level 1\"."},
        Bad{"unknown_member", with(R"("sunn": 3)"),
            "the document has the unknown member \"sunn\"; known are format, name, hint, size_m, "
            "mood, camera, player, exit, seen_lux, caught_after_s, sun, walls, blocks, columns, "
            "lamps, searchlights, guards, doors, cranes, wheels."},
        Bad{"huge_unknown_member", "{\"" + std::string(5000, 'x') + "\": 1}",
            "the document has the unknown member \"" + std::string(59, 'x') +
                "…; known are format, name, hint, size_m, mood, camera, player, exit, seen_lux, "
                "caught_after_s, sun, walls, blocks, columns, lamps, searchlights, guards, doors, "
                "cranes, wheels."},
        Bad{"unknown_member_that_a_terminal_obeys", with(R"("sun": {"\u001b[2J": 1})"),
            R"(sun has the unknown member "\u001b[2J"; known are from_deg, to_deg, period_s, lux, )"
            "color."},
        Bad{"name_that_a_terminal_obeys", R"({"format": "gnomon-level 1", "name": "a\u001b[2J"})",
            R"(name is "a\u001b[2J", but must be a text without control characters.)"},
        Bad{"name_with_a_control_of_two_bytes",
            R"({"format": "gnomon-level 1", "name": "a\u009b2J"})",
            R"(name is "a\u009b2J", but must be a text without control characters.)"},
        Bad{"wrong_kind", with(R"("guards": {"path": []})"),
            "guards is an object, but must be an array of 0 to 200 entries."},
        Bad{"out_of_range", with(R"("guards": [{"path": [[0, 0], [1, 0]], "speed_m_s": -2}])"),
            "guards[0].speed_m_s is -2, but must be a number from 0.1 to 4."},
        Bad{"not_a_number", with(R"("seen_lux": "much")"),
            "seen_lux is \"much\", but must be a number from 0.01 to 100000."},
        Bad{"short_array", with(R"("lamps": [{"at": [1, 2]}])"),
            "lamps[0].at is an array of 2, but must be an array of 3 numbers."},
        Bad{"path_of_one", with(R"("searchlights": [{"at": [0, 5, 0], "path": [[1, 1]]}])"),
            "searchlights[0].path is an array of 1, but must be an array of 2 to 64 entries."},
        Bad{"path_that_stays", with(R"("guards": [{"path": [[0, 0], [1, 0], [1, 0], [2, 2]]}])"),
            "guards[0].path[2] is 0 m from the entry before it; a path must go on by 0.05 m at "
            "least."},
        // Its length is a number, but no direction can be made of it.
        Bad{"path_that_hardly_moves",
            with(R"("guards": [{"path": [[0, 0], [1e-200, 0], [2, 2]]}])"),
            "guards[0].path[1] is 0 m from the entry before it; a path must go on by 0.05 m at "
            "least."},
        Bad{"path_of_small_steps",
            with(R"("searchlights": [{"at": [0, 5, 0], "path": [[0, 0], [0, 0.03125], [2, 2]]}])"),
            "searchlights[0].path[1] is 0.03125 m from the entry before it; a path must go on by "
            "0.05 m at least."},
        Bad{"path_closed_twice", with(R"("guards": [{"path": [[0, 0], [1, 0], [0, 0]]}])"),
            "guards[0].path[2] is 0 m from where the path began, but must be 0.05 m or more from "
            "there: a "
            "path closes by itself."},
        Bad{"low_lamp", with(R"("lamps": [{"at": [0, -0.5, 0]}])"),
            "lamps[0].at is -0.5 m above the ground, but must be 0.5 m or more above it."},
        Bad{"low_column", with(R"("columns": [{"at": [0, 0], "height_m": 0.2}])"),
            "columns[0].height_m is 0.2, but must be a number from 0.5 to 20."},
        Bad{"low_searchlight",
            with(R"("searchlights": [{"at": [0, 1, 0], "path": [[1, 1], [2, 2]]}])"),
            "searchlights[0].at is 1 m above the ground, but must be 2 m or more above it."},
        Bad{"sun_below", with(R"("sun": {"from_deg": [0, -5]})"),
            "sun.from_deg has the elevation -5, but that must be a number from 3 to 90."},
        Bad{"wall_without_length", with(R"("walls": [{"from": [1, 1], "to": [1, 1]}])"),
            "walls[0].to is where the wall begins; it has no length."},
        Bad{"spokes", with(R"("wheels": [{"at": [0, 0], "spokes": 2.5}])"),
            "wheels[0].spokes is 2.5, but must be a whole number from 2 to 64."},
        Bad{"load_above_crane",
            with(R"("cranes": [{"at": [0, 0], "height_m": 5, "load_base_m": 4}])"),
            "cranes[0] has a load whose top hangs 5.6 m above the ground, but that must be below "
            "its height_m of 5."},
        Bad{"long_name", R"({"format": "gnomon-level 1", "name": ""})",
            "name is \"\", but must be a text of 1 to 60 bytes."}),
    [](const auto& row) { return row.param.name; });

struct Extreme {
    const char* name;
    std::string members;
};
void PrintTo(const Extreme& extreme, std::ostream* out) { *out << extreme.name; }

class ExtremeLevels : public testing::TestWithParam<Extreme> {};

void expect_finite(Stage& stage) {
    const scene::Registry& registry = stage.scene().registry;
    std::size_t broken = 0;
    const auto count = [&](const auto& vector) {
        for (glm::length_t i = 0; i < vector.length(); ++i)
            broken += std::isfinite(vector[i]) ? 0 : 1;
    };
    registry.each<scene::WorldTransform>([&](scene::Entity, const scene::WorldTransform& world) {
        for (glm::length_t i = 0; i < 4; ++i) count(world.world_from_local[i]);
    });
    registry.each<scene::MeshInstance>([&](scene::Entity, const scene::MeshInstance& instance) {
        for (const glm::vec3& position : instance.mesh->positions) count(position);
        for (const glm::vec3& normal : instance.mesh->normals) count(normal);
    });
    EXPECT_EQ(broken, 0U) << "numbers of poses and meshes";
}

// Whatever a level file may say can be played.
TEST_P(ExtremeLevels, are_staged_and_played) {
    const auto level = read_level(with(GetParam().members), "extreme.json");
    ASSERT_TRUE(level) << level.error().message;
    auto stage = Stage::create(*level);
    ASSERT_TRUE(stage) << stage.error().message;
    expect_finite(*stage);
    auto world = World::create(*level);
    ASSERT_TRUE(world) << world.error().message;
    for (int i = 0; i < 8; ++i) {
        const Status done = world->tick({.east = 127, .south = -127, .run = true});
        ASSERT_TRUE(done) << done.error().message;
    }
    expect_finite(world->stage());
    EXPECT_TRUE(std::isfinite(world->reading().level));
    const glm::dvec2 beyond = glm::abs(world->player().at) - level->size_m * 0.5;
    EXPECT_LE(std::max(beyond.x, beyond.y), 0.0) << "it stays on the ground";
}

INSTANTIATE_TEST_SUITE_P(
    Files, ExtremeLevels,
    testing::Values(
        Extreme{"nothing", ""},
        Extreme{"small_blocks",
                R"("blocks": [{"at": [0, 0], "size_m": [0.05, 0.05, 0.05]},
                              {"at": [1, 0], "size_m": [0.08, 1, 0.08], "base_m": 20},
                              {"at": [2, 0], "size_m": [0.2, 0.05, 0.2], "base_m": 1},
                              {"at": [-2, 0], "size_m": [0.05, 3, 60]}])"},
        Extreme{"large_blocks", R"("blocks": [{"at": [0, 0], "size_m": [60, 60, 60]}])"},
        Extreme{"short_wall", R"("walls": [{"from": [0, 0], "to": [0, 0.05], "height_m": 0.1,
                                            "thickness_m": 0.05}])"},
        Extreme{"long_wall", R"("walls": [{"from": [-200, -200], "to": [200, 200], "height_m": 20,
                                           "thickness_m": 10, "base_m": 20}])"},
        Extreme{"columns", R"("columns": [{"at": [0, 0], "radius_m": 0.05, "height_m": 0.5},
                                          {"at": [2, 2], "radius_m": 10, "height_m": 20}])"},
        Extreme{"lamps", R"("lamps": [{"at": [0, 0.5, 0], "range_m": 0.5, "candela": 0},
                                      {"at": [-200, 200, 200], "range_m": 200, "candela": 1e5}])"},
        Extreme{"searchlight_above_its_path",
                R"("searchlights": [{"at": [0, 2, 0], "path": [[0, 0], [0.05, 0]], "period_s": 2,
                                     "cone_deg": 1},
                                    {"at": [3, 200, 3], "path": [[-200, 200], [200, -200]],
                                     "period_s": 600, "cone_deg": 45}])"},
        Extreme{"guards",
                R"("guards": [{"path": [[2, 2], [2.0625, 2]], "speed_m_s": 4, "pause_s": 0,
                                         "cone_deg": 5},
                                        {"path": [[2, -2], [2, -2.0625]], "speed_m_s": 0.1,
                                         "pause_s": 60, "hearing_m": 50, "cone_deg": 80},
                                        {"path": [[-200, 200], [200, -200]]}])"},
        Extreme{"doors", R"("doors": [{"hinge": [0, 0], "width_m": 0.5, "height_m": 0.5,
                                       "open_deg": -170},
                                      {"hinge": [-2, 0], "width_m": 5, "height_m": 6,
                                       "turn_deg": 360, "open_deg": 170}])"},
        Extreme{"small_crane",
                R"("cranes": [{"at": [0, 0], "height_m": 4, "arm_m": 1, "period_s": 4,
                                              "load_m": [0.2, 0.2, 0.2], "load_base_m": 2}])"},
        Extreme{"large_crane", R"("cranes": [{"at": [0, 0], "height_m": 40, "arm_m": 40,
                                              "swing_deg": [-720, 720], "period_s": 600,
                                              "load_m": [20, 20, 20], "load_base_m": 19.9}])"},
        Extreme{"wheels", R"("wheels": [{"at": [0, 0], "radius_m": 0.5, "spokes": 2, "period_s": 2},
                                        {"at": [1, 1], "radius_m": 20, "spokes": 64,
                                         "period_s": 600}])"},
        Extreme{"low_sun", R"("sun": {"from_deg": [-360, 3], "to_deg": [360, 3], "period_s": 5,
                                      "lux": 1e5})"},
        Extreme{"high_sun", R"("sun": {"from_deg": [0, 90], "lux": 0})"},
        Extreme{"patience", R"("seen_lux": 0.01, "caught_after_s": 0.1)"}),
    [](const auto& row) { return row.param.name; });

TEST(Stage, what_is_too_narrow_for_bars_is_a_plain_box) {
    Level level;
    level.blocks.push_back({.at = {0.0, 0.0}, .size_m = {0.08, 1.0, 0.08}});
    level.blocks.push_back({.at = {2.0, 0.0}, .size_m = {1.0, 1.0, 1.0}});
    auto stage = Stage::create(level);
    ASSERT_TRUE(stage) << stage.error().message;
    expect_finite(*stage);
    std::size_t crates = 0;
    stage->scene().registry.each<scene::MeshInstance>(
        [&](scene::Entity, const scene::MeshInstance& instance) {
            crates += instance.mesh->name == "crate" ? 1U : 0U;
        });
    EXPECT_EQ(crates, 1U);
}

TEST(Level, places_that_somebody_stands_at_lie_on_the_ground) {
    const auto level = read_level(
        R"({"format": "gnomon-level 1", "name": "n", "size_m": [10, 8], "player": {"at": [6, 0]},
            "exit": {"at": [0, 0]}})",
        "yard.json");
    ASSERT_FALSE(level);
    EXPECT_EQ(level.error().message,
              "yard.json: player.at is [6, 0], but must lie on the ground, which reaches to [5, "
              "4].");
}

TEST(Level, a_file_that_is_not_there_is_named) {
    const auto level = load_level("no/such.json");
    ASSERT_FALSE(level);
    EXPECT_EQ(level.error().code, ErrorCode::Io);
    EXPECT_EQ(level.error().message,
              "no/such.json: the level cannot be read: No such file or directory.");
}

TEST(Level, a_name_that_is_not_there_is_answered_with_those_that_are) {
    const auto level = load_named_level(GNOMON_GAME_ASSETS, "moon");
    ASSERT_FALSE(level);
    EXPECT_THAT(level.error().message, AllOf(StartsWith("There is no level \"moon\" in "),
                                             EndsWith("there are courtyard, barracks, "
                                                      "dockyard.")));
}

TEST(Level, names_are_those_that_recordings_can_hold) {
    const auto assets = test::output_folder() / "game" / "named";
    std::filesystem::remove_all(assets);
    std::filesystem::create_directories(assets / "levels");
    for (const char* name :
         {"b.json", "a-1_B.json", "with space.json", "dots.2.json", "other.txt", "dockyard.json"}) {
        std::ofstream(assets / "levels" / name) << with("");
    }
    std::ofstream(assets / "levels" / (std::string(61, 'x') + ".json")) << with("");
    const auto names = level_names(assets);
    ASSERT_TRUE(names) << names.error().message;
    EXPECT_EQ(*names, (std::vector<std::string>{"dockyard", "a-1_B", "b"}));
    for (const std::string& name : *names) {
        const Recording recording{.level = name, .inputs = {}};
        EXPECT_EQ(read_recording(to_text(recording), "x.replay"), recording);
        EXPECT_TRUE(load_named_level(assets, name));
    }
}

TEST(Level, those_that_come_with_the_game_are_read) {
    const auto names = level_names(GNOMON_GAME_ASSETS);
    ASSERT_TRUE(names) << names.error().message;
    EXPECT_GE(names->size(), 3U);
    for (const std::string& name : *names) {
        const auto level = load_named_level(GNOMON_GAME_ASSETS, name);
        ASSERT_TRUE(level) << level.error().message;
        EXPECT_FALSE(level->hint.empty()) << name;
    }
}

}  // namespace
}  // namespace gnomon::game
