// SPDX-License-Identifier: MIT
//
// Rows: small scenes with lights and a camera, each with one trait that stencil shadows are known
// to stumble over. The parity suite draws them on every device, the truth suite holds them against
// traced shadows.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/view.hpp>

namespace gnomon::test {

struct Setting {
    scene::Scene scene;  ///< world transforms up to date
    shadows::View view;
};

struct Row {
    std::string name;
    std::function<Setting()> make;
    bool cull_back_faces = false;
};

inline constexpr std::uint32_t row_width = 320;
inline constexpr std::uint32_t row_height = 240;

[[nodiscard]] const std::vector<Row>& rows();

inline void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

}  // namespace gnomon::test
