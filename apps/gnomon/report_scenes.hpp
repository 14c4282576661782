// SPDX-License-Identifier: MIT
//
// Scenes of a report: the standard set, or those that are given.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gnomon/report/report.hpp>

#include "arguments.hpp"

namespace gnomon::cli {

/// From where a file is looked at, and by which light. Without: as `gnomon render` would.
struct Look {
    glm::dvec3 eye{0.0};
    glm::dvec3 target{0.0};
    double fovy_deg = 0.0;
    LightArgument light = {};
};

struct WantedScene {
    std::string name;
    std::string source;
    report::Kind kind = report::Kind::Other;
    std::optional<Look> look = std::nullopt;
    bool ground = false;  ///< is put below
};

/// What there is of the standard set, with `quick` of a few of it; the rest goes into `left_out`.
[[nodiscard]] std::vector<WantedScene> standard_scenes(bool quick,
                                                       std::vector<report::LeftOut>& left_out);

/// Files and built-in scenes as `gnomon render` takes them; each has a name of its own.
[[nodiscard]] std::vector<WantedScene> given_scenes(const std::vector<std::string>& sources);

/// Fails as reading a scene does. Of many lights the few that matter most are left, and the notes
/// say so.
[[nodiscard]] Result<report::Subject> load_subject(const WantedScene& wanted,
                                                   const report::Options& options);

}  // namespace gnomon::cli
