// SPDX-License-Identifier: MIT
//
// gnomon profile: the ways to draw plans, dates without sun, limits, and the perspective picture.
#include "tests/cli/profile.hpp"

#include <algorithm>

namespace gnomon::cli::test {
namespace {

TEST_F(Profile, DrawsTheSameByAnyMethodButForEdges) {
    if (!draws("gl") && !draws("vk")) GTEST_SKIP() << "nothing draws here";
    run_well(profile("scan"));
    for (const char* method : {"projection", "volumes"}) {
        run_well(profile(method, {"--method", method}));
        std::size_t differing = 0;
        std::size_t dark = 0;
        const nlohmann::json s = summary("scan");
        for (const auto& step : s["steps"]) {
            const auto name = step["mask"].get<std::string>();
            const auto scanned = mask("scan/" + name, 80, 80);
            const auto drawn = mask(std::string(method) + "/" + name, 80, 80);
            for (std::size_t row = 0; row < 80; ++row) {
                for (std::size_t column = 0; column < 80; ++column) {
                    differing += scanned[row][column] != drawn[row][column] ? 1 : 0;
                    dark += scanned[row][column] == '0' ? 1 : 0;
                }
            }
        }
        EXPECT_LE(differing, 7U) << method;
        EXPECT_GT(dark, 7U * 300U);
    }
    EXPECT_EQ(summary("volumes")["study"]["method"]["name"], "volumes");
    EXPECT_FALSE(summary("volumes")["study"]["method"]["backend"].get<std::string>().empty());
    EXPECT_EQ(summary("scan")["study"]["method"], nlohmann::json({{"name", "scan"}}));
    expect_refused({"profile", "--quiet", "--out", "x", "--merge", "scan", "projection"},
                   {"--merge", "\"method\" differs"});
    // A backend that is named draws.
    EXPECT_EQ(run(profile("x", {"--backend", "null"})).exit_code, 2);
}

// Masks by another method are another study's, though all else is the same.
TEST_F(Profile, MixesNoMethods) {
    run_well(profile("scan"));
    const std::string noon = read("scan/masks/2026-03-21T1200.npy");
    const std::string before_noon = read("scan/masks/2026-03-21T1100.npy");
    const nlohmann::json good = nlohmann::json::parse(read("scan/study.json"));
    const auto by = [&](const nlohmann::json& method) {
        nlohmann::json study = good;
        study["method"] = method;
        return study.dump();
    };
    const std::string volumes = by({{"name", "volumes"}, {"backend", "gl"}});
    // A run goes on where masks are by its own method, and begins anew where they are not.
    for (const bool same : {true, false}) {
        write("scan/masks/2026-03-21T1100.npy", noon);
        if (!same) write("scan/study.json", volumes);
        run_well(profile("scan", {"--method", "scan"}));
        EXPECT_EQ(read("scan/masks/2026-03-21T1100.npy"), same ? noon : before_noon);
    }
    EXPECT_EQ(nlohmann::json::parse(read("scan/study.json")), good);
    run_well(profile("part"));
    const Arguments merge{"profile", "--quiet", "--out", "x", "--merge", "scan", "part"};
    write("part/study.json", volumes);
    expect_refused(merge, {"--merge", "\"method\" differs"});
    write("scan/study.json", by({{"name", "volumes"}, {"backend", "vk"}}));
    expect_refused(merge, {"--merge", "\"method\" differs"});
    write("scan/study.json", by({{"name", "rays"}}));
    expect_refused(merge, {"scan/study.json", "\"name\""});
    write("scan/study.json", by({{"name", "volumes"}}));
    expect_refused(merge, {"scan/study.json", "\"backend\""});
}

// North of the polar circle a year has days without sun: they have no hours, and it is said.
TEST_F(Profile, HasDaysWithoutSunAmongOthers) {
    Arguments arguments = profile("study", {"--before", "site.scene.json", "--receivers", "tower"});
    const auto set = [&](const char* option, const char* value) {
        *(std::find(arguments.begin(), arguments.end(), option) + 1) = value;
    };
    set("--lat", "69.65");
    set("--date", "2026-12-21,2026-03-21");
    std::erase(arguments, std::string("--quiet"));
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_NE(outcome.errors.find("On 2026-12-21 the sun stays below the horizon"),
              std::string::npos)
        << outcome.errors;
    const nlohmann::json dark = summary("study/2026-12-21");
    EXPECT_EQ(dark["hours"]["possible"], 0.0);
    EXPECT_EQ(dark["hours"]["max"], 0.0);
    EXPECT_NE(dark["no_sun"].get<std::string>().find("below the horizon"), std::string::npos);
    EXPECT_FALSE(summary("study/2026-03-21").contains("no_sun"));
    EXPECT_EQ(summary("study/2026-03-21")["hours"]["possible"], 6.0);
    EXPECT_TRUE(std::filesystem::is_regular_file(path("study/2026-12-21/hours.png")));
    EXPECT_NE(read("study/report.html").find("stays below the horizon"), std::string::npos);

    // Of parts, where they are joined.
    set("--out", "part");
    const auto part = run(joined(arguments, {"--shard", "1/1", "--threads", "1"}));
    EXPECT_EQ(part.exit_code, 0) << part.errors;
    EXPECT_EQ(part.errors.find("2026-12-21"), std::string::npos) << part.errors;
    const auto merged = run({"profile", "--out", "merged", "--merge", "part"});
    EXPECT_EQ(merged.exit_code, 0) << merged.errors;
    EXPECT_NE(merged.errors.find("On 2026-12-21 the sun stays below the horizon"),
              std::string::npos)
        << merged.errors;
    expect_same_files("study", "merged");

    set("--date", "2026-12-20,2026-12-21");
    const auto refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.errors.find("on none of the 2 dates"), std::string::npos) << refused.errors;
}

TEST_F(Profile, RefusesMoreMasksThanAnybodyKeeps) {
    Arguments arguments = profile("study");
    const auto set = [&](const char* option, const char* value) {
        *(std::find(arguments.begin(), arguments.end(), option) + 1) = value;
    };
    set("--step", "1s");
    set("--date", "2025-01-01..2025-12-31");
    expect_refused(arguments, {"21601 steps on 365 dates", "1000000"});
    EXPECT_FALSE(std::filesystem::exists(path("study")));
}

TEST_F(Profile, ShowsTheWholeSceneInPerspective) {
    const Arguments eye{"--eye", "-30,-40,35"};
    run_well(profile("study", eye));
    EXPECT_TRUE(std::filesystem::is_regular_file(path("study/scene.png")));
    EXPECT_NE(read("study/report.html").find("scene.png"), std::string::npos);
    // Parts take what casts along.
    run_well(joined(profile("part1", {"--shard", "1/2"}), eye));
    run_well(profile("part2", {"--shard", "2/2"}));
    run_well(joined({"profile", "--quiet", "--out", "merged", "--merge", "part1", "part2"}, eye));
    expect_same_files("study", "merged");
    // One of their copies does, if it is whole.
    run_well(joined(profile("part2", {"--shard", "2/2"}), eye));
    const std::string casters = read("part1/masks/casters.npy");
    write("part1/masks/casters.npy", casters.substr(0, casters.size() / 2));
    const Arguments again = joined({"profile", "--quiet", "--merge", "part1", "part2"}, eye);
    run_well(joined(again, {"--out", "again"}));
    expect_same_files("study", "again");
    write("part2/masks/casters.npy", "");
    expect_refused(joined(again, {"--out", "x"}), {"--eye", "casters.npy"});
    EXPECT_FALSE(std::filesystem::exists(path("x")));
    // With receivers as well, of which a picture could be made.
    const Arguments walls{"--receivers", "shed"};
    run_well(profile("walls", walls));
    expect_refused(joined({"profile", "--quiet", "--out", "x", "--merge", "walls"}, eye),
                   {"--eye", "casters.npy"});
    // Another study takes it away again.
    Arguments other = profile("study");
    *(std::find(other.begin(), other.end(), std::string("--step")) + 1) = "2h";
    run_well(other);
    EXPECT_FALSE(std::filesystem::exists(path("study/masks/casters.npy")));
    EXPECT_FALSE(std::filesystem::exists(path("study/scene.png")));
}

}  // namespace
}  // namespace gnomon::cli::test
