// SPDX-License-Identifier: MIT
//
// gnomon report: speed against error, of a set of scenes or of those that are given.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "arguments.hpp"

namespace gnomon::cli {

struct ReportOptions {
    std::vector<std::string> scenes = {};  ///< none: the standard set
    std::filesystem::path out = "report";
    std::vector<std::string> backends = {};  ///< none: one on a graphics chip, else any
    std::optional<Size> size = std::nullopt;
    std::optional<std::uint32_t> rounds = std::nullopt;
    std::optional<std::uint32_t> frames = std::nullopt;
    std::vector<std::string> techniques = {};  ///< none: all
    bool quick = false;
    bool quiet = false;
    std::string version = {};
    std::string command = {};  ///< as the user wrote it
};

/// Runs it. Every scene and backend is kept under the folder `cells` as soon as it is measured, and
/// taken over from there by a later run with the same arguments.
[[nodiscard]] Status run_report(const ReportOptions& options);

}  // namespace gnomon::cli
