// SPDX-License-Identifier: MIT
//
// gnomon profile as a user runs it.
#include "tests/cli/profile.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <sstream>

#include <unistd.h>

namespace gnomon::cli::test {
namespace {

TEST_F(Profile, WritesWhatItPromises) {
    run_well(profile("study"));
    for (const char* name :
         {"profile.png", "profile.pgw", "hours.png", "hours.pgw", "hours.csv", "summary.json",
          "sun-path.png", "report.html", "study.json", "masks/open.npy",
          "masks/2026-03-21T0900.npy", "masks/2026-03-21T1500.npy"}) {
        EXPECT_TRUE(std::filesystem::is_regular_file(path(std::string("study/") + name))) << name;
    }
    const nlohmann::json s = summary("study");
    EXPECT_EQ(s["cells"], 80 * 80);
    // Two boxes lie above 8 x 8 and 4 x 4 cells.
    EXPECT_EQ(s["open_cells"], 80 * 80 - 64 - 16);
    EXPECT_EQ(s["hours"]["possible"], 6.0);
    EXPECT_EQ(s["hours"]["min"], 0.0);
    EXPECT_EQ(s["hours"]["max"], 6.0);
    ASSERT_EQ(s["steps"].size(), 7U);
    EXPECT_EQ(s["steps"][3]["utc"], "2026-03-21T11:00:00Z");
    EXPECT_EQ(s["steps"][3]["clock"], "12:00");
    EXPECT_NEAR(s["steps"][3]["altitude_deg"], 42.0, 0.5);
    EXPECT_EQ(s["criteria"][0]["id"], "bre209");
    EXPECT_FALSE(s["criteria"][0]["applies"]);  // the sun is up before 09:00
    double last = 1.0;
    for (const auto& at_least : s["share_at_least"]) {
        EXPECT_LE(at_least["share"], last);
        last = at_least["share"];
    }
    EXPECT_NE(read("study/report.html").find("hours.png"), std::string::npos);
}

// The shadow of the tower's top, by hand: 9.9 m above the plane.
TEST_F(Profile, PutsShadowsWhereTheSunSays) {
    run_well(profile("study"));
    const nlohmann::json s = summary("study");
    for (const auto& step : s["steps"]) {
        const auto lines = mask("study/" + step["mask"].get<std::string>(), 80, 80);
        const double azimuth = step["azimuth_deg"].get<double>() * std::numbers::pi / 180.0;
        const double altitude = step["altitude_deg"].get<double>() * std::numbers::pi / 180.0;
        const auto at = [&](double distance) {
            const double x = -std::sin(azimuth) * distance;
            const double y = -std::cos(azimuth) * distance;
            return lines[static_cast<std::size_t>(std::floor((24.0 - y) / 0.5))]
                        [static_cast<std::size_t>(std::floor((x + 20.0) / 0.5))];
        };
        const double length = 9.9 / std::tan(altitude);
        EXPECT_EQ(at(length), '0') << step;
        EXPECT_EQ(at(length + 4.0), '1') << step;
        EXPECT_EQ(at(-4.0), '1') << step;
    }
}

TEST_F(Profile, PlacesItsPicturesByWorldFiles) {
    run_well(profile("study"));
    std::istringstream file(read("study/hours.pgw"));
    double a = 0, d = 0, b = 0, e = 0, c = 0, f = 0;
    file >> a >> d >> b >> e >> c >> f;
    ASSERT_TRUE(file);
    EXPECT_NEAR(a, 0.5 / 15.0, 1e-12);  // 1200 pixels for 80 cells
    EXPECT_EQ(d, 0.0);
    EXPECT_EQ(b, 0.0);
    EXPECT_EQ(e, -a);
    // The upper left cell's upper left corner is 28 pixels from the left and 84 from above.
    EXPECT_NEAR(c + (28.0 - 0.5) * a, -20.0, 1e-9);
    EXPECT_NEAR(f + (84.0 - 0.5) * e, 24.0, 1e-9);
}

TEST_F(Profile, HasHoursThatAddUpItsMasks) {
    run_well(profile("study"));
    const nlohmann::json s = summary("study");
    std::vector<std::vector<std::string>> masks;
    for (const auto& step : s["steps"]) {
        masks.push_back(mask("study/" + step["mask"].get<std::string>(), 80, 80));
    }
    const auto open = mask("study/masks/open.npy", 80, 80);
    std::istringstream csv(read("study/hours.csv"));
    std::string line;
    for (std::size_t row = 0; row < 80; ++row) {
        ASSERT_TRUE(std::getline(csv, line));
        std::istringstream cells(line + ",");
        for (std::size_t column = 0; column < 80; ++column) {
            std::string cell;
            ASSERT_TRUE(std::getline(cells, cell, ','));
            if (open[row][column] == '0') {
                EXPECT_EQ(cell, "");
                continue;
            }
            double hours = 0.0;
            for (std::size_t i = 0; i < masks.size(); ++i) {
                if (masks[i][row][column] == '1') hours += s["steps"][i]["hours"].get<double>();
            }
            ASSERT_EQ(std::stod(cell), hours) << row << ", " << column;
        }
    }
}

TEST_F(Profile, TurnsWithNorthAndTheModelsAxes) {
    // At nine the sun is in the south-east: above on the right, where north lies to the left.
    run_well(profile("turned", {"--north", "-90"}));
    const auto lines = mask("turned/masks/2026-03-21T0900.npy", 80, 80);
    EXPECT_EQ(lines[58][34], '0');  // (-3, -5): in the tower's shadow
    EXPECT_EQ(lines[38][46], '1');
    // The same tower in a model that is +Z up and in centimetres.
    write("site.scene.json", R"({"primitives": [
        {"shape": "box", "name": "tower", "size": [400, 400, 1000], "translation": [0, 0, 500]}]})");
    run_well(profile("up", {"--up", "z", "--unit", "cm"}));
    write("site.scene.json", R"({"primitives": [
        {"shape": "box", "name": "tower", "size": [4, 10, 4], "translation": [0, 5, 0]}]})");
    run_well(profile("plain"));
    EXPECT_EQ(read("up/hours.csv"), read("plain/hours.csv"));
}

TEST_F(Profile, LetsOnlyThoseCastThatAreNamed) {
    run_well(profile("all"));
    run_well(profile("one", {"--casters", "tow*"}));
    run_well(profile("part", {"--casters", "tower#0"}));
    EXPECT_EQ(summary("one")["open_cells"], 80 * 80 - 64);
    EXPECT_LT(summary("all")["hours"]["mean"], summary("one")["hours"]["mean"]);
    EXPECT_EQ(read("part/hours.csv"), read("one/hours.csv"));
    expect_refused(profile("none", {"--casters", "castle"}), {"--casters", "castle"});
}

TEST_F(Profile, ComparesWithAModelBefore) {
    write("before.scene.json", R"({"primitives": [
        {"shape": "box", "name": "shed", "size": [2, 2, 2], "translation": [8, 1, 6]}]})");
    run_well(profile("alone"));
    run_well(profile("change", {"--before", "before.scene.json"}));
    EXPECT_EQ(read("change/hours.csv"), read("alone/hours.csv"));
    const nlohmann::json s = summary("change");
    EXPECT_EQ(s["before"]["open_cells"], 80 * 80 - 16);
    EXPECT_GT(s["before"]["hours"]["mean"], s["hours"]["mean"]);
    EXPECT_TRUE(std::filesystem::exists(path("change/difference.png")));
    EXPECT_TRUE(std::filesystem::exists(path("change/difference.pgw")));
    // A tower takes and gives nothing; where it stands there is no answer.
    std::istringstream csv(read("change/difference.csv"));
    std::string cell;
    std::size_t lost = 0;
    while (std::getline(csv, cell, ',')) {
        if (cell.empty() || cell == "\n") continue;
        EXPECT_LE(std::atof(cell.c_str()), 0.0);
        lost += std::atof(cell.c_str()) < 0.0 ? 1 : 0;
    }
    EXPECT_GT(lost, 300U);
}

TEST_F(Profile, AsksAboutSurfacesToo) {
    run_well(profile("study", {"--receivers", "shed", "--spacing", "0.25m"}));
    const nlohmann::json s = summary("study")["surfaces"];
    EXPECT_NEAR(s["area_m2"].get<double>(), 5.0 * 4.0, 1e-9);
    EXPECT_TRUE(std::filesystem::exists(path("study/surfaces.png")));
    std::istringstream csv(read("study/surfaces.csv"));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, "x_m,y_m,height_m,nx,ny,nz,area_m2,hours");
    std::size_t points = 0;
    double roof_h = 0.0;
    double north_h = 0.0;
    while (std::getline(csv, line)) {
        double v[8] = {};
        ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &v[0], &v[1], &v[2],
                              &v[3], &v[4], &v[5], &v[6], &v[7]),
                  8);
        if (v[5] > 0.9) roof_h = std::max(roof_h, v[7]);
        if (v[4] > 0.9) north_h = std::max(north_h, v[7]);
        ++points;
    }
    EXPECT_EQ(points, s["points"]);
    EXPECT_EQ(roof_h, 6.0);
    EXPECT_EQ(north_h, 0.0);
    // In parts as well, and joined without the model.
    run_well(profile("part1", {"--receivers", "shed", "--spacing", "0.25m", "--shard", "1/2"}));
    run_well(profile("part2", {"--receivers", "shed", "--spacing", "0.25m", "--shard", "2/2"}));
    run_well({"profile", "--quiet", "--out", "merged", "--merge", "part1", "part2"});
    expect_same_files("study", "merged");
    expect_refused(profile("x", {"--receivers", "castle"}), {"--receivers", "castle"});
    expect_refused(profile("x", {"--receivers", "shed", "--spacing", "0.001"}), {"points"});
}

TEST_F(Profile, GoesOnWhereItWas) {
    run_well(profile("study"));
    const std::string whole = read("study/hours.csv");
    // A mask that is there is taken over, whatever is in it; one that was cut off is drawn again.
    const std::string noon = read("study/masks/2026-03-21T1200.npy");
    write("study/masks/2026-03-21T1100.npy", noon);
    write("study/masks/2026-03-21T1300.npy", noon.substr(0, noon.size() / 2));
    std::filesystem::remove(path("study/masks/2026-03-21T1400.npy"));
    const std::string one = read("study/masks/2026-03-21T1000.npy");
    run_well(profile("study"));
    EXPECT_EQ(read("study/masks/2026-03-21T1100.npy"), noon);
    EXPECT_NE(read("study/masks/2026-03-21T1300.npy"), noon);
    EXPECT_NE(read("study/hours.csv"), whole);
    // Another study takes over nothing.
    run_well(profile("study", {"--casters", "shed"}));
    EXPECT_NE(read("study/masks/2026-03-21T1000.npy"), one);
    run_well(profile("study"));
    EXPECT_EQ(read("study/hours.csv"), whole);
}

TEST_F(Profile, IsTheSameInAnyParts) {
    Arguments whole = profile("whole");
    std::replace(whole.begin(), whole.end(), std::string("1h"), std::string("2h"));
    std::replace(whole.begin(), whole.end(), std::string("2026-03-21"),
                 std::string("2026-03-21,2026-06-21"));
    run_well(whole);
    Arguments merge{"profile", "--quiet", "--out", "merged", "--merge"};
    for (const std::string part : {"3", "1", "2"}) {
        Arguments shard = whole;
        std::replace(shard.begin(), shard.end(), std::string("whole"), "part" + part);
        run_well(joined(shard, {"--shard", part + "/3"}));
        EXPECT_FALSE(std::filesystem::exists(path("part" + part + "/report.html")));
        if (part != "2") merge.push_back("part" + part);
    }
    expect_refused(merge, {"--merge", "masks are in none of the folders"});
    merge.push_back("part2");
    run_well(merge);
    EXPECT_TRUE(std::filesystem::exists(path("merged/2026-06-21/hours.png")));
    expect_same_files("whole", "merged");
    run_well(profile("other"));
    expect_refused({"profile", "--merge", "part1", "other", "--out", "x"}, {"\"dates\" differs"});
}

// Receivers need not cast: what tells a study with them from another is their own shape and place.
TEST_F(Profile, BeginsAnewWhereReceiversMoved) {
    const Arguments more{"--casters", "tower", "--receivers", "shed"};
    run_well(profile("study", more));
    write("site.scene.json", R"({"primitives": [
        {"shape": "box", "name": "tower", "size": [4, 10, 4], "translation": [0, 5, 0]},
        {"shape": "box", "name": "shed", "size": [2, 2, 2], "translation": [-1, 1, -6]}]})");
    run_well(profile("study", more));
    run_well(profile("fresh", more));
    EXPECT_EQ(read("study/surfaces.csv"), read("fresh/surfaces.csv"));
    expect_same_files("fresh", "study");
}

TEST_F(Profile, RefusesAStudyThatItDidNotWrite) {
    run_well(profile("part", {"--shard", "1/1", "--receivers", "shed"}));
    const nlohmann::json good = nlohmann::json::parse(read("part/study.json"));
    const Arguments merge{"profile", "--quiet", "--out", "x", "--merge", "part"};
    const auto expect_bad = [&](const std::string& pointer, const nlohmann::json& value,
                                const std::string& key) {
        nlohmann::json bad = good;
        bad[nlohmann::json::json_pointer(pointer)] = value;
        write("part/study.json", bad.dump());
        expect_refused(merge, {"part/study.json", key});
    };
    expect_bad("/from_min", -1, "from_min");
    expect_bad("/from_min", 900, "to_min");
    expect_bad("/to_min", 1441, "to_min");
    expect_bad("/step_s", 0, "step_s");
    expect_bad("/step_s", 86401, "step_s");
    expect_bad("/step_s", 1e300, "step_s");
    expect_bad("/step_s", 60.5, "step_s");
    expect_bad("/utc_offset_min", 841, "utc_offset_min");
    expect_bad("/latitude_deg", 90.5, "latitude_deg");
    expect_bad("/longitude_deg", "14", "longitude_deg");
    expect_bad("/surface_points", 4000000000U, "surface_points");
    expect_bad("/surface_points", -1, "surface_points");
    expect_bad("/grid/cell_m", 0.0, "cell_m");
    expect_bad("/grid/columns", 0, "columns");
    expect_bad("/grid/rows", 1 << 21, "rows");
    expect_bad("/grid/min_m", {1.0}, "min_m");
    expect_bad("/grid", nullptr, "min_m");
    expect_bad("/dates", nlohmann::json::array(), "dates");
    expect_bad("/dates", std::vector<std::string>(401, "2026-03-21"), "dates");
    expect_bad("/dates", {"2026-03-21", "2026-03-21"}, "dates");
    expect_bad("/model", 1, "model");
    expect_bad("/version", 1, "version");
    write("part/study.json", "[]");
    expect_refused(merge, {"part/study.json"});
    write("part/study.json", "{");
    expect_refused(merge, {"part/study.json", "no JSON"});
    write("part/study.json", good.dump());
    run_well(merge);
}

TEST_F(Profile, OutlinesSomeStepsWhereverItBegins) {
    const auto outlined = [&](const char* from, const char* step) {
        Arguments arguments = profile("study");
        std::replace(arguments.begin(), arguments.end(), std::string("09:00"), std::string(from));
        std::replace(arguments.begin(), arguments.end(), std::string("1h"), std::string(step));
        run_well(arguments);
        std::vector<std::string> clocks;
        const nlohmann::json s = summary("study");
        for (const auto& one : s["steps"]) {
            if (one["outlined"]) clocks.push_back(one["clock"]);
        }
        return clocks;
    };
    EXPECT_EQ(outlined("09:00", "1h").size(), 7U);
    // 19 steps: those of whole hours.
    EXPECT_EQ(outlined("09:00", "20m").size(), 7U);
    const std::vector<std::string> odd = outlined("09:07", "20m");  // 18 steps
    ASSERT_EQ(odd.size(), 9U);
    EXPECT_EQ(odd[1], "09:47");
}

// Of 23 days every second is drawn, the first and the last among them.
TEST_F(Profile, SpreadsSunPathsOverAllDates) {
    const auto path_of = [&](const char* out, const char* dates) {
        Arguments arguments = profile(out, {"--casters", "shed"});
        std::replace(arguments.begin(), arguments.end(), std::string("2026-03-21"),
                     std::string(dates));
        std::replace(arguments.begin(), arguments.end(), std::string("1h"), std::string("6h"));
        std::replace(arguments.begin(), arguments.end(), std::string("0.5m"), std::string("2m"));
        run_well(arguments);
        return read(std::string(out) + "/sun-path.png");
    };
    EXPECT_EQ(path_of("all", "2026-03-01..2026-03-23"),
              path_of("some", "2026-03-01..2026-03-23/2"));
}

TEST_F(Profile, SaysWhetherACriterionIsMetOnlyWhereItApplies) {
    const auto bre = [&](const Arguments& more) {
        Arguments day = profile("study", more);
        std::replace(day.begin(), day.end(), std::string("09:00"), std::string("05:00"));
        std::replace(day.begin(), day.end(), std::string("15:00"), std::string("20:00"));
        std::replace(day.begin(), day.end(), std::string("1h"), std::string("30m"));
        run_well(day);
        return summary("study")["criteria"][0];
    };
    EXPECT_TRUE(bre({})["applies"]);
    EXPECT_TRUE(bre({})["met"]);
    const nlohmann::json low = bre({"--min-altitude", "10"});
    EXPECT_FALSE(low["applies"]);
    EXPECT_FALSE(low.contains("met"));
}

TEST_F(Profile, RefusesNamesThatJsonCannotHold) {
    expect_refused(profile("x", {"--casters", "t\xfcr*"}), {"--casters", "not UTF-8"});
    std::filesystem::copy_file(path("site.scene.json"), path("h\xe4us.scene.json"));
    Arguments odd = profile("x");
    odd[1] = "h\xe4us.scene.json";
    expect_refused(odd, {"MODEL", "not UTF-8"});
    EXPECT_FALSE(std::filesystem::exists(path("x")));
}

TEST_F(Profile, RemovesHalvesOfKilledRuns) {
    run_well(profile("study"));
    // No process has this number: it is beyond what Linux gives.
    const std::string dead = "study/masks/2026-03-21T1200.npy.4194399.part";
    const std::string fresh = "study/masks/2026-03-21T1300.npy.4194399.part";
    const std::string foreign = "study/masks/holiday.npy.4194399.part";
    const std::string alive =
        "study/masks/2026-03-21T1400.npy." + std::to_string(::getpid()) + ".part";
    for (const std::string& name : {dead, fresh, foreign, alive}) {
        write(name, "half");
        if (name == fresh) continue;
        std::filesystem::last_write_time(
            path(name), std::filesystem::file_time_type::clock::now() - std::chrono::hours(2));
    }
    run_well(profile("study"));
    EXPECT_FALSE(std::filesystem::exists(path(dead)));
    for (const std::string& name : {fresh, foreign, alive}) {
        EXPECT_TRUE(std::filesystem::exists(path(name))) << name;
    }
}

TEST_F(Profile, MergesWithoutASayOfOtherOptions) {
    run_well(profile("part", {"--shard", "1/1"}));
    const Arguments merge{"profile", "--quiet", "--out", "x", "--merge", "part"};
    expect_refused(joined(merge, {"--grid", "2m"}), {"--merge", "--grid"});
    expect_refused(joined(merge, {"--min-altitude", "5"}), {"--merge", "--min-altitude"});
    expect_refused({"profile", "site.scene.json", "--out", "x", "--merge", "part"},
                   {"--merge", "MODEL"});
    run_well(merge);
}

TEST_F(Profile, LeavesAloneWhatItHasNotMade) {
    std::filesystem::create_directories(path("mine/masks"));
    write("mine/masks/holiday.npy", "mine");
    expect_refused(profile("mine"), {"--out", "mine", "no study.json"});
    EXPECT_EQ(read("mine/masks/holiday.npy"), "mine");
    EXPECT_FALSE(std::filesystem::exists(path("mine/study.json")));
    // Among another study's files, too.
    run_well(profile("study"));
    write("study/masks/holiday.npy", "mine");
    write("study/notes.txt", "mine");
    Arguments later = profile("study", {"--shard", "1/2"});
    std::replace(later.begin(), later.end(), std::string("2026-03-21"), std::string("2026-04-21"));
    run_well(later);
    EXPECT_EQ(read("study/masks/holiday.npy"), "mine");
    EXPECT_EQ(read("study/notes.txt"), "mine");
    // What was the other study's is gone, with all that was made of it.
    EXPECT_FALSE(std::filesystem::exists(path("study/masks/2026-03-21T1200.npy")));
    for (const char* name : {"report.html", "sun-path.png", "hours.png", "hours.pgw", "hours.csv",
                             "profile.png", "profile.pgw", "summary.json"}) {
        EXPECT_FALSE(std::filesystem::exists(path(std::string("study/") + name))) << name;
    }
    std::filesystem::create_directories(path("odd"));
    write("odd/study.json", "{\"version\": 0}");
    expect_refused(profile("odd"), {"odd/study.json", "no study"});
}

TEST_F(Profile, KeepsWhatIsThereUntilTheNewIsKnownToWork) {
    run_well(profile("study", {"--shard", "1/1"}));
    run_well(profile("study"));
    run_well(profile("copy"));
    const auto expect_whole = [&](const std::string& when) {
        SCOPED_TRACE(when);
        expect_same_files("copy", "study");
    };
    expect_refused(profile("study", {"--casters", "tower", "--backend", "null"}),
                   {"--backend", "nothing would cast"});
    expect_whole("no backend that draws");
    Arguments covered = profile("study");
    std::replace(covered.begin(), covered.end(), std::string("-20,-16,20,24"),
                 std::string("-1,-1,1,1"));
    expect_refused(covered, {"--plane", "above every cell"});
    expect_whole("all under a roof");
    run_well(profile("part1", {"--casters", "tower", "--shard", "1/2"}));
    expect_refused({"profile", "--quiet", "--out", "study", "--merge", "part1"},
                   {"--merge", "masks are in none of the folders"});
    expect_whole("a part is missing");
}

TEST_F(Profile, SaysWhichFileCannotBeRemoved) {
    run_well(profile("study"));
    // A folder that is not empty is in the way.
    std::filesystem::remove(path("study/hours.csv"));
    std::filesystem::create_directories(path("study/hours.csv/kept"));
    const Outcome outcome = run(profile("study", {"--casters", "tower"}));
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_NE(outcome.errors.find("hours.csv cannot be removed"), std::string::npos)
        << outcome.errors;
}

TEST_F(Profile, RunsUnderGnuParallel) {
    if (std::system("parallel --version > /dev/null 2>&1") != 0) {
        GTEST_SKIP() << "GNU parallel is not installed";
    }
    run_well(profile("whole"));
    std::string command =
        "cd '" + path("").string() + "' && parallel --will-cite -j2 " + std::string(GNOMON_PROGRAM);
    for (const std::string& word : profile("part{}", {"--shard", "{}/4", "--threads", "1"}))
        command += " " + word;
    command += " ::: 1 2 3 4 2> parallel.log";
    ASSERT_EQ(std::system(command.c_str()), 0) << read("parallel.log");
    run_well(
        {"profile", "--quiet", "--out", "merged", "--merge", "part1", "part2", "part3", "part4"});
    expect_same_files("whole", "merged");
}

TEST_F(Profile, SaysWhatIsWrongInOneSentence) {
    const auto with = [](const std::string& option, const std::string& value) {
        Arguments arguments = profile("x");
        const auto at = std::find(arguments.begin(), arguments.end(), option);
        if (at == arguments.end()) return joined(arguments, {option, value});
        *(at + 1) = value;
        return arguments;
    };
    expect_refused(with("--date", "2026-02-30"), {"2026-02-30", "does not exist"});
    expect_refused(with("--date", "2026-03-21,2026-03-21"), {"twice"});
    expect_refused(with("--from", "16:00"), {"16:00 to 15:00", "empty"});
    expect_refused(with("--to", "25:00"), {"25:00"});
    expect_refused(with("--tz", "CET"), {"CET"});
    expect_refused(with("--lat", "91"), {"--lat", "91"});
    expect_refused(with("--step", "0m"), {"0m"});
    expect_refused(with("--step", "7h"), {"does not fit"});
    expect_refused(with("--grid", "-1"), {"--grid"});
    expect_refused(with("--area", "0,0,10"), {"--area", "four numbers"});
    expect_refused(with("--area", "0,0,-10,5"), {"--area", "empty"});
    expect_refused(with("--shard", "4/3"), {"--shard", "4/3"});
    expect_refused(with("--backend", "null"), {"--backend", "nothing would cast"});
    expect_refused(with("--area", "-1,-1,1,1"), {"--plane", "above every cell"});
    expect_refused(with("--grid", "0.0001"), {"--grid"});
    expect_refused(with("--target", "1,2,3"), {"--target", "--eye", "--receivers"});
    expect_refused(joined(profile("x"), {"--method", "scan", "--backend", "null"}),
                   {"--backend", "scan"});
    expect_refused(with("--method", "magic"), {"--method", "magic"});
    expect_refused(with("--area", "0,0,15000,15000"), {"30000 x 30000 cells", "64000000"});
    expect_refused(with("--min-altitude", "80"), {"no sun counts"});
    Arguments night = with("--lat", "80");
    std::replace(night.begin(), night.end(), std::string("2026-03-21"), std::string("2026-12-21"));
    expect_refused(night, {"2026-12-21", "below the horizon"});
    expect_refused({"profile", "site.scene.json", "--out", "x"}, {"--lat"});
    expect_refused({"profile", "--out", "x"}, {"MODEL"});
    expect_refused({"profile", "site.scene.json"}, {"--out"});
    expect_refused({"profile", "--merge", "nowhere", "--out", "x"}, {"nowhere"});
    expect_refused({"profile", "missing.glb", "--lat", "1", "--lon", "1", "--date", "2026-03-21",
                    "--from", "09:00", "--to", "15:00", "--out", "x"},
                   {"missing.glb"});
}

}  // namespace
}  // namespace gnomon::cli::test
