// SPDX-License-Identifier: MIT
//
// --stats: every member of the contract, and that work follows what changed. On the null backend:
// nothing of this depends on a driver.
#include <gmock/gmock.h>

#include "tests/cli/program.hpp"

namespace gnomon::cli::test {
namespace {

class Stats : public ProgramTest {
protected:
    [[nodiscard]] nlohmann::json moving(const std::string& motion) const {
        return stats_of("builtin:still-life",
                        {"--backend", "null", "--frames", "4", "--animate", motion});
    }
};

constexpr std::uint64_t pairs = 15;  // five casters, three lights

TEST_F(Stats, every_member_is_there) {
    for (const char* backend : {"gl", "vk", "null"}) {
        if (std::string(backend) != "null" && !draws(backend)) continue;
        SCOPED_TRACE(backend);
        const auto stats = stats_of("builtin:still-life", {"--backend", backend, "--frames", "2"});
        EXPECT_EQ(stats["backend"], backend);
        EXPECT_FALSE(stats["adapter"].get<std::string>().empty());
        EXPECT_FALSE(stats["stencil_path"].get<std::string>().empty());
        EXPECT_EQ(stats["width"], 160);
        EXPECT_EQ(stats["height"], 120);
        EXPECT_EQ(stats["casters"], 5);
        EXPECT_EQ(stats["lights"], 3);
        EXPECT_GT(stats["triangles"].get<int>(), 1000);
        ASSERT_EQ(stats["frames"].size(), 2U);
        for (const auto& frame : stats["frames"]) {
            for (const char* time :
                 {"frame_ms", "detect_ms", "build_ms", "record_ms", "submit_ms"}) {
                ASSERT_TRUE(frame[time].is_number()) << time;
                EXPECT_GE(frame[time].get<double>(), 0.0) << time;
                EXPECT_LE(frame[time].get<double>(), frame["frame_ms"].get<double>()) << time;
            }
            EXPECT_GT(frame["frame_ms"].get<double>(), 0.0);
            EXPECT_EQ(frame["pairs"], pairs);
            EXPECT_EQ(frame["pairs_culled"], 0);
            EXPECT_EQ(frame["zpass_pairs"].get<std::uint64_t>() +
                          frame["zfail_pairs"].get<std::uint64_t>(),
                      pairs);
            EXPECT_EQ(frame["pairs_redetected"].get<std::uint64_t>() +
                          frame["pairs_reused"].get<std::uint64_t>(),
                      pairs);
            EXPECT_GT(frame["silhouette_edges"].get<int>(), 15);
            EXPECT_EQ(frame["stencil_batches"], 3) << "one a light";
            EXPECT_EQ(frame["split_lights"], 0);
            EXPECT_EQ(frame["quad_pairs"], 0);
            EXPECT_GT(frame["upload_bytes"].get<int>(), 0);
            EXPECT_GT(frame["draw_calls"].get<int>(), 15);
            const auto in_double = frame["double_tests"].get<std::uint64_t>();
            EXPECT_LE(in_double, frame["faces_tested"].get<std::uint64_t>());
            EXPECT_LE(frame["exact_tests"].get<std::uint64_t>(), in_double);
            const auto& fragments = frame["stencil_fragments"];
            EXPECT_TRUE(frame.contains("stencil_fragments") &&
                        (fragments.is_null() || fragments.is_number_unsigned()));
            EXPECT_FALSE(frame["silhouette"].get<std::string>().empty());
            std::uint64_t reasons = 0;
            for (const auto& count : frame["reasons"]) reasons += count.get<std::uint64_t>();
            EXPECT_EQ(reasons, pairs);
        }
        EXPECT_EQ(stats["frames"][0]["reasons"]["new"], pairs);
        // Those that no box settles; all of them by the plain way.
        EXPECT_GT(stats["frames"][0]["faces_tested"].get<std::uint64_t>(), 0U);
        EXPECT_LE(stats["frames"][0]["faces_tested"].get<std::uint64_t>(),
                  3 * stats["triangles"].get<std::uint64_t>());
    }
}

TEST_F(Stats, nothing_moves_nothing_is_done) {
    for (const char* motion : {"static", "camera", "light:0", "casters:0"}) {
        SCOPED_TRACE(motion);
        const auto frames = moving(motion)["frames"];
        EXPECT_EQ(frames[0]["pairs_redetected"], pairs);
        for (std::size_t i = 1; i < 4; ++i) {
            EXPECT_EQ(frames[i]["pairs_redetected"], 0);
            EXPECT_EQ(frames[i]["pairs_reused"], pairs);
            EXPECT_EQ(frames[i]["faces_tested"], 0);
            EXPECT_EQ(frames[i]["reasons"]["unchanged"], pairs);
            // Matrices and lights alone: at most a slot of 256 bytes a draw and light, no index.
            EXPECT_EQ(frames[i]["upload_bytes"], frames[1]["upload_bytes"]);
            EXPECT_LE(frames[i]["upload_bytes"].get<std::uint64_t>(), 256 * (5 + 1 + 3 + pairs));
            EXPECT_EQ(frames[i]["silhouette_edges"], frames[0]["silhouette_edges"]);
        }
    }
}

TEST_F(Stats, a_light_that_moves_is_detected_again_each_frame) {
    const auto frames = moving("light:10")["frames"];
    for (std::size_t i = 1; i < 4; ++i) {
        EXPECT_GT(frames[i]["pairs_redetected"].get<std::uint64_t>(), 0U);
        EXPECT_GT(frames[i]["faces_tested"].get<std::uint64_t>(), 0U);
        EXPECT_GT(frames[i]["reasons"]["light moved"].get<std::uint64_t>(), 0U);
        EXPECT_FALSE(frames[i]["reasons"].contains("unchanged"));
        EXPECT_GT(frames[i]["upload_bytes"].get<std::uint64_t>(), 256 * (5 + 1 + 3 + pairs));
    }
}

TEST_F(Stats, casters_that_move_cost_their_own_pairs_alone) {
    const auto frames = moving("casters:2")["frames"];
    for (std::size_t i = 1; i < 4; ++i) {
        EXPECT_EQ(frames[i]["reasons"]["unchanged"], 9) << "three casters at three lights";
        EXPECT_LE(frames[i]["pairs_redetected"].get<std::uint64_t>(), 6U);
        EXPECT_GT(frames[i]["pairs_redetected"].get<std::uint64_t>(), 0U);
    }
    const auto all = moving("casters:100")["frames"];
    for (std::size_t i = 1; i < 4; ++i)
        EXPECT_FALSE(all[i]["reasons"].contains("unchanged")) << all[i];
}

TEST_F(Stats, reading_masks_back_is_not_counted) {
    const Arguments plain{"--backend", "null", "--samples", "4"};
    const auto without = stats_of("builtin:still-life", plain)["frames"][0];
    const auto with =
        stats_of("builtin:still-life", joined(plain, {"--stencil", "mask"}))["frames"][0];
    for (const char* member : {"draw_calls", "upload_bytes"})
        EXPECT_EQ(with[member], without[member]);
}

TEST_F(Stats, fragments_are_counted_where_the_backend_can_and_when_asked) {
    for (const char* backend : {"gl", "vk", "null"}) {
        if (std::string(backend) != "null" && !draws(backend)) continue;
        SCOPED_TRACE(backend);
        const Arguments plain{"--backend", backend, "--frames", "2"};
        const auto without = stats_of("builtin:still-life", plain)["frames"];
        const auto with = stats_of("builtin:still-life", joined(plain, {"--meter"}))["frames"];
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_TRUE(without[i]["stencil_fragments"].is_null());
            EXPECT_TRUE(without[i]["stencil_fragments_counted"].is_null());
            for (const char* member : {"draw_calls", "upload_bytes"})
                EXPECT_EQ(with[i][member], without[i][member]) << "counting is not counted";
            if (std::string(backend) == "null") {
                EXPECT_TRUE(with[i]["stencil_fragments"].is_null()) << "it draws nothing";
                continue;
            }
            const auto fragments = with[i]["stencil_fragments"].get<std::uint64_t>();
            const auto counted = with[i]["stencil_fragments_counted"].get<std::uint64_t>();
            EXPECT_GT(fragments, 160U * 120U);
            EXPECT_GT(counted, 0U);
            EXPECT_LT(counted, fragments);
            EXPECT_EQ(with[i]["stencil_fragments"], with[0]["stencil_fragments"]);
        }
    }
    expect_refused(render("builtin:knot", {"--meter"}), {"--meter", "--stats"});
}

TEST_F(Stats, at_most_so_many_lights_cast_shadows) {
    const Arguments plain{"--backend", "null"};
    for (const std::uint64_t most : {0U, 1U, 2U, 3U, 9U}) {
        const auto stats = stats_of("builtin:still-life",
                                    joined(plain, {"--max-shadowed-lights", std::to_string(most)}));
        EXPECT_EQ(stats["lights"], std::min<std::uint64_t>(most, 3));
        EXPECT_EQ(stats["frames"][0]["pairs"], 5 * std::min<std::uint64_t>(most, 3));
    }
    expect_refused(render("builtin:knot", {"--max-shadowed-lights", "-1"}),
                   {"--max-shadowed-lights"});
}

TEST_F(Stats, casters_beyond_a_lights_range_are_culled) {
    const auto frame = stats_of("builtin:still-life", {"--backend", "null", "--light",
                                                       "point:0,100,0,range=1"})["frames"][0];
    EXPECT_EQ(frame["pairs"], 5);
    EXPECT_EQ(frame["pairs_culled"], 5);
    EXPECT_EQ(frame["reasons"]["out of range"], 5);
    EXPECT_EQ(frame["silhouette_edges"], 0);
}

TEST_F(Stats, a_forced_technique_is_every_pairs) {
    for (const auto& [name, member] :
         {std::pair{"zpass", "zpass_pairs"}, std::pair{"zfail", "zfail_pairs"}}) {
        const auto frame =
            stats_of("builtin:still-life", {"--backend", "null", "--technique", name})["frames"][0];
        EXPECT_EQ(frame[member], pairs) << name;
    }
}

TEST_F(Stats, triangles_are_those_that_are_drawn) {
    EXPECT_EQ(
        stats_of("builtin:still-life", {"--backend", "null", "--receivers", "box"})["triangles"],
        12);
    const auto none = stats_of("builtin:still-life", {"--backend", "null", "--casters", "x"});
    EXPECT_EQ(none["casters"], 0);
    EXPECT_EQ(none["frames"][0]["pairs"], 0);
}

}  // namespace
}  // namespace gnomon::cli::test
