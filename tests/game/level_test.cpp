// SPDX-License-Identifier: MIT
#include "level.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "assets.hpp"

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
            "guards[0].path[2] is where the entry before it is; a path must go on."},
        Bad{"path_closed_twice", with(R"("guards": [{"path": [[0, 0], [1, 0], [0, 0]]}])"),
            "guards[0].path[2] is where the path began; it closes by itself."},
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
    EXPECT_EQ(level.error().message, "no/such.json: the level cannot be read.");
}

TEST(Level, a_name_that_is_not_there_is_answered_with_those_that_are) {
    const auto level = load_named_level(GNOMON_GAME_ASSETS, "moon");
    ASSERT_FALSE(level);
    EXPECT_THAT(level.error().message, AllOf(StartsWith("There is no level \"moon\" in "),
                                             EndsWith("there are courtyard, barracks, "
                                                      "dockyard.")));
}

TEST(Level, those_that_come_with_the_game_are_read) {
    const auto names = level_names(GNOMON_GAME_ASSETS);
    EXPECT_GE(names.size(), 3U);
    for (const std::string& name : names) {
        const auto level = load_named_level(GNOMON_GAME_ASSETS, name);
        ASSERT_TRUE(level) << level.error().message;
        EXPECT_FALSE(level->hint.empty()) << name;
    }
}

}  // namespace
}  // namespace gnomon::game
