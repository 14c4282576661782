// SPDX-License-Identifier: MIT
//
// Hard cases: scenes that stencil shadows are known to fail on, one line of story each, numbered as
// in the literature's list (docs/hard-cases.md). Each is drawn on every device and held against
// ray-traced truth: outside the band of 1/16 pixel no pixel may be wrong.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {

struct HardCase {
    /// The number first: "03_book_of_nine_pages".
    std::string name;
    /// What goes wrong elsewhere, in one line.
    std::string story;
    /// The scene of one frame; most cases have one. A sweep has many, and is judged as a whole.
    std::function<Setting(int frame)> make;
    int frames = 1;
    PictureOptions options = {};
    /// Otherwise at least 5 % of the judged pixels must be lit and 5 % in shadow: a case that is
    /// all light proves nothing. The reason why it cannot be so here.
    std::string one_sided_because = {};
    /// The band's share of the pixels may be so high, where the scene is made of edges.
    double most_band = 0.10;
};

/// All of them, family by family.
[[nodiscard]] const std::vector<HardCase>& hard_cases();

/// Adds the case, and the same once more with every volume drawn by depth-fail, also where
/// depth-pass is valid.
void add_by_both(std::vector<HardCase>& cases, HardCase hard_case);

// The families, one file each.
[[nodiscard]] std::vector<HardCase> topology_cases();    ///< what a mesh may be
[[nodiscard]] std::vector<HardCase> dirty_mesh_cases();  ///< what exporters write
[[nodiscard]] std::vector<HardCase> adjoining_cases();   ///< faces and casters side by side
[[nodiscard]] std::vector<HardCase> caster_cases();      ///< what is drawn, and how large it is
[[nodiscard]] std::vector<HardCase> light_cases();       ///< where a light may be
[[nodiscard]] std::vector<HardCase> camera_cases();      ///< from where it may be seen
[[nodiscard]] std::vector<HardCase> pose_cases();        ///< where things may stand, and how askew
[[nodiscard]] std::vector<HardCase> layer_cases();       ///< how many volumes may lie over a pixel

/// Google's rasteriser, to which other limits apply (docs/hard-cases.md).
[[nodiscard]] inline bool on_swiftshader(const TestDevice& device) {
    return device.device.caps().adapter.find("SwiftShader") != std::string::npos;
}

inline void PrintTo(const HardCase& hard_case, std::ostream* out) { *out << hard_case.name; }

}  // namespace gnomon::test
