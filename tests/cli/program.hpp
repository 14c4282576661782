// SPDX-License-Identifier: MIT
//
// Runs the gnomon program as a user does: arguments in; exit code, both streams and files out.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace gnomon::cli::test {

using Arguments = std::vector<std::string>;

struct Outcome {
    int exit_code = -1;  ///< -1 where a signal ended it
    std::string output;
    std::string errors;
};

/// PGM as `--stencil` writes it, taken apart.
struct Mask {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::string bytes;

    [[nodiscard]] std::uint8_t at(std::uint32_t x, std::uint32_t y) const {
        return static_cast<std::uint8_t>(bytes[std::size_t{y} * width + x]);
    }
    [[nodiscard]] std::size_t covered() const;  ///< pixels that are not 0
};

/// A folder of the test's own, empty at the start, and the program run in it.
class ProgramTest : public testing::Test {
protected:
    void SetUp() override;

    [[nodiscard]] Outcome run(const Arguments& arguments) const;
    /// The same; fails the test unless it ends with 0 and says nothing on stderr.
    Outcome run_well(const Arguments& arguments) const;
    /// Fails the test unless it ends with 2 and one line on stderr that has all `parts` in it.
    void expect_refused(const Arguments& arguments, const std::vector<std::string>& parts) const;

    /// render SCENE --size 160x120 and more.
    [[nodiscard]] static Arguments render(const std::string& scene, const Arguments& more = {});
    /// Draws with `more` and reads light0's mask.
    [[nodiscard]] Mask mask_of(const std::string& scene, const Arguments& more) const;
    /// Draws with `more` and reads the stats.
    [[nodiscard]] nlohmann::json stats_of(const std::string& scene, const Arguments& more) const;

    [[nodiscard]] std::filesystem::path path(const std::string& name) const {
        return folder_ / name;
    }
    /// Writes a file into the folder; gives its name back.
    std::string write(const std::string& name, std::string_view text) const;
    std::string write(const std::string& name, std::span<const std::byte> bytes) const;
    [[nodiscard]] std::string read(const std::string& name) const;
    [[nodiscard]] Mask read_mask(const std::string& name) const;
    /// Names of all files in the folder, sorted.
    [[nodiscard]] std::vector<std::string> files() const;

    /// Whether the backend draws here; says why not.
    [[nodiscard]] bool draws(const std::string& backend) const;

    /// After so many seconds a run is killed.
    unsigned longest_run_s_ = 120;

private:
    std::filesystem::path folder_;
};

/// A wall that fills the view, and a block before it whose shadow falls to the right of the middle
/// and above it: straight behind the block, as the light travels with the view.
[[nodiscard]] std::string wall_and_block();
[[nodiscard]] Arguments facing_the_wall(const Arguments& more = {});

[[nodiscard]] Arguments joined(Arguments first, const Arguments& second);

}  // namespace gnomon::cli::test
