// SPDX-License-Identifier: MIT
//
// What the paired runs run on: meshes by name, made or loaded when they are asked for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/scene/mesh.hpp>

namespace gnomon::bench {

struct Subject {
    std::string name;
    std::string family;  ///< sphere, knot, noise, CAD, scan, prop, stand-in
    std::function<Result<scene::Mesh>()> make;
    double share = 1.0;  ///< of the time to measure in: large meshes need more for as many frames
};

/// Spheres and torus knots of 1k to 4M triangles, a bumpy noise sphere, a part as CAD writes them;
/// and those of the known scans and props that are in `models`, which may not exist. `quick`: a few
/// small ones of them.
[[nodiscard]] std::vector<Subject> subjects(const std::filesystem::path& models, bool quick);

/// Blocks and towers with tessellated walls, of the sizes of the scenes that papers on silhouettes
/// were measured on: 11k, 13.6k, 147k and 182k triangles. `quick`: the smallest.
[[nodiscard]] std::vector<Subject> stand_ins(bool quick);

}  // namespace gnomon::bench
