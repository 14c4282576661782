// SPDX-License-Identifier: MIT
//
// gnomon report as a user runs it: files, resumption, refusals.
#include <set>

#include <gmock/gmock.h>

#include "tests/cli/program.hpp"

namespace gnomon::cli::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class ReportCommand : public ProgramTest {
protected:
    static Arguments small(const Arguments& more = {}) {
        return joined({"report", "builtin:knot", "--quick", "--quiet", "--size", "96x54",
                       "--rounds", "1", "--technique", "shadow map, sloped 512", "--out", "r"},
                      more);
    }
    [[nodiscard]] bool draws_at_all() const { return draws("gl") || draws("vk"); }
    [[nodiscard]] std::vector<std::filesystem::path> kept() const {
        std::vector<std::filesystem::path> paths;
        for (const auto& entry : std::filesystem::directory_iterator(path("r/cells"))) {
            paths.push_back(entry.path());
        }
        return paths;
    }
};

TEST_F(ReportCommand, WritesAPageTablesAndData) {
    if (!draws_at_all()) GTEST_SKIP() << "no backend draws here";
    run_well(small());
    const std::string page = read("r/report.html");
    EXPECT_THAT(page, HasSubstr("<svg"));
    EXPECT_THAT(page, HasSubstr("shadow map, sloped 512"));
    const auto json = nlohmann::json::parse(read("r/report.json"));
    const auto& rows = json.at("cells").at(0).at("rows");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].at("technique"), "auto");
    EXPECT_EQ(rows[0].at("errors").at("wrong_worst"), 0);
    EXPECT_GT(rows[1].at("errors").at("wrong_at_all_worst"), 0);
    EXPECT_THAT(json.at("command"), HasSubstr("'shadow map, sloped 512'"));
    EXPECT_THAT(read("r/report.csv"), HasSubstr("knot,hero,"));
}

TEST_F(ReportCommand, ARepeatedRunMeasuresNothingAndAnInterruptedOneGoesOn) {
    if (!draws_at_all()) GTEST_SKIP() << "no backend draws here";
    run_well(small({"builtin:pillars"}));
    const std::string csv = read("r/report.csv");  // times and all
    ASSERT_EQ(kept().size(), 2U);
    run_well(small({"builtin:pillars"}));
    EXPECT_EQ(read("r/report.csv"), csv);
    Arguments loud = small({"builtin:pillars"});
    std::erase(loud, "--quiet");
    EXPECT_THAT(run(loud).errors, HasSubstr("2 of 2 measurements were taken over"));

    // As if it had been stopped within the second scene, or while it wrote the first.
    for (const auto& path : kept()) {
        std::filesystem::resize_file(path, 100);
        break;
    }
    run_well(small({"builtin:pillars"}));
    const std::string again = read("r/report.csv");
    EXPECT_NE(again, csv);
    std::size_t same = 0;  // lines of the scene that was kept
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        if (again.find(line + "\n") != std::string::npos) ++same;
    }
    EXPECT_GE(same, 3U);  // the head, and two techniques

    // Other arguments are another measurement.
    run_well(small({"builtin:pillars", "--technique", "planar"}));
    EXPECT_EQ(kept().size(), 4U);
}

// A table with the columns of errors alone: whose names tell of pixels, of the band, of edges.
std::vector<std::string> errors_in(const std::string& csv) {
    const auto cells_of = [](const std::string& line) {
        std::vector<std::string> cells(1);
        bool quoted = false;
        for (const char c : line) {
            if (c == '"') quoted = !quoted;
            if (c == ',' && !quoted) {
                cells.emplace_back();
            } else {
                cells.back() += c;
            }
        }
        return cells;
    };
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);
    const auto names = cells_of(line);
    std::vector<std::string> rows;
    while (std::getline(lines, line)) {
        const auto cells = cells_of(line);
        std::string& row = rows.emplace_back();
        for (std::size_t i = 0; i < names.size(); ++i) {
            for (const char* part : {"scene", "technique", "wrong", "false", "band", "displacement",
                                     "iou", "layers"}) {
                if (names[i].find(part) != std::string::npos) row += cells.at(i) + ",";
            }
        }
    }
    return rows;
}

TEST_F(ReportCommand, TwoRunsHaveTheSameErrorsToTheLastDigit) {
    if (!draws_at_all()) GTEST_SKIP() << "no backend draws here";
    Arguments run_once{"report", "builtin:room", "builtin:knot", "--quick", "--quiet",
                       "--size", "96x54",        "--rounds",     "1",       "--frames",
                       "3"};
    run_well(joined(run_once, {"--out", "first"}));
    run_well(joined(run_once, {"--out", "second"}));
    const auto first = errors_in(read("first/report.csv"));
    EXPECT_GT(first.size(), 20U);
    EXPECT_GT(std::set<std::string>(first.begin(), first.end()).size(), 15U);
    EXPECT_EQ(errors_in(read("second/report.csv")), first);
    EXPECT_NE(read("second/report.csv"), read("first/report.csv"));  // the clock's are not
}

TEST_F(ReportCommand, BothBackendsHaveTheSameErrorsOfVolumes) {
    if (!draws("gl") || !draws("vk")) GTEST_SKIP() << "one of the backends does not draw";
    Arguments run_both{"report", "builtin:still-life", "--quiet", "--size",    "96x54", "--rounds",
                       "1",      "--frames",           "3",       "--backend", "gl,vk", "--out",
                       "r"};
    for (const char* technique : {"depth-fail", "depth-pass", "silhouette simd",
                                  "silhouette every 3 frames", "tolerance 5 deg"}) {
        run_both.insert(run_both.end(), {"--technique", technique});
    }
    run_well(run_both);
    const auto rows = errors_in(read("r/report.csv"));
    ASSERT_EQ(rows.size(), 12U);
    const auto half = rows.begin() + 6;
    EXPECT_EQ(std::vector<std::string>(rows.begin(), half),
              std::vector<std::string>(half, rows.end()));
    EXPECT_THAT(read("r/report.html"), HasSubstr("of 6 pairs of measurements, all have the same"));
}

TEST_F(ReportCommand, SaysWhichScenesOfTheStandardSetAreNotThere) {
    if (!draws_at_all()) GTEST_SKIP() << "no backend draws here";
    const auto standard = [&](const Arguments& more) {
        return joined({"report", "--out", "r", "--size", "32x18", "--frames", "2", "--rounds", "1",
                       "--technique", "auto"},
                      more);
    };
    const Outcome outcome = run(standard({}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    const std::string note = outcome.errors.substr(0, outcome.errors.find('\n'));
    EXPECT_THAT(note, testing::StartsWith("Left out of the standard set, since neither"));
    EXPECT_THAT(note, HasSubstr("duplex-house (scenes/duplex-house.glb)"));
    const auto scene_names = [](const nlohmann::json& list) {
        std::set<std::string> names;
        for (const auto& entry : list) names.insert(entry.at("scene"));
        return names;
    };
    const auto json = nlohmann::json::parse(read("r/report.json"));
    const auto left_out = scene_names(json.at("left_out"));
    const auto measured = scene_names(json.at("cells"));
    EXPECT_TRUE(left_out.contains("duplex-house"));
    EXPECT_TRUE(measured.contains("room"));
    EXPECT_EQ(left_out.size() + measured.size(), 10U);
    EXPECT_THAT(read("r/report.html"), HasSubstr("<code>scenes/duplex-house.glb</code>"));

    // A first look is asked for, and says nothing; its page does.
    run_well(standard({"--quick", "--quiet"}));
    const auto quick = nlohmann::json::parse(read("r/report.json"));
    EXPECT_EQ(scene_names(quick.at("cells")), (std::set<std::string>{"room", "pillars", "knot"}));
    EXPECT_THAT(quick.at("left_out").at(0).at("reason"), HasSubstr("--quick"));
}

TEST_F(ReportCommand, ListsTechniques) {
    const std::string list = run_well({"report", "--list-techniques"}).output;
    EXPECT_THAT(list, testing::StartsWith("auto\n"));
    EXPECT_THAT(list, HasSubstr("\nshadow map, 3x3 4096\n"));
    EXPECT_THAT(list, HasSubstr("\nplanar\n"));
}

TEST_F(ReportCommand, RefusesInOneSentence) {
    expect_refused({"report", "--backend", "dx"}, {"dx", "gl"});
    expect_refused({"report", "--backend", "gl,gl"}, {"\"gl\"", "twice"});
    expect_refused({"report", "--technique", "magic"}, {"magic", "--list-techniques"});
    expect_refused({"report", "--rounds", "0"}, {"rounds"});
    expect_refused({"report", "--frames", "1"}, {"frames"});
    expect_refused({"report", "--size", "12"}, {"size", "12"});
    expect_refused({"report", "--out", ""}, {"--out", "empty"});
    expect_refused({"report", "missing.glb"}, {"missing.glb"});
    expect_refused({"report", "builtin:nowhere"}, {"nowhere"});
    expect_refused({"report", "--backend", "null", "builtin:knot"}, {"null", "judged"});
    write("file", "in the way");
    expect_refused({"report", "--out", "file", "builtin:knot"}, {"file"});
}

}  // namespace
}  // namespace gnomon::cli::test
