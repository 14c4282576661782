// SPDX-License-Identifier: MIT
//
// Scene descriptions: a small JSON file (*.scene.json) that places models and primitives, lights
// and a camera, and the scenes that are built in. The format is described in
// docs/scene-description.md.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/scene/scene.hpp>

#pragma GCC visibility push(default)
namespace gnomon::scene {

/// Reads a *.scene.json; models it names are looked up beside it. Errors as load_gltf.
[[nodiscard]] Result<Scene> load_scene_description(const std::filesystem::path& path);

/// Any scene gnomon can read: .glb, .gltf, .scene.json, or "builtin:NAME".
[[nodiscard]] Result<Scene> load_scene(const std::string& source);

/// As "builtin:NAME" takes them.
[[nodiscard]] std::vector<std::string> builtin_scene_names();
/// Fails with ErrorCode::InvalidInput for a name that is none of them.
[[nodiscard]] Result<Scene> make_builtin_scene(std::string_view name);

}  // namespace gnomon::scene
#pragma GCC visibility pop
