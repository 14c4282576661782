// SPDX-License-Identifier: MIT
//
// Reads glTF 2.0 (.glb and .gltf) into a Scene: complete for geometry, as far as shadows need for
// the rest.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <gnomon/core/result.hpp>
#include <gnomon/scene/scene.hpp>

#pragma GCC visibility push(default)
namespace gnomon::scene {

/// What of a file is read.
struct GltfOptions {
    int scene = -1;  ///< which of the file's scenes; -1: its default, else the first
};

/// Every mesh node becomes a Caster and a Receiver; lights and cameras become components. What is
/// skipped (points, lines, images that cannot be decoded) is named in Scene::messages; extensions
/// that the file requires and this reader does not know are refused. Skins, morph targets and
/// animations become components and Scene::animations; skinned and morphed meshes are deformed as
/// the nodes stand and the file's weights say (deform.hpp), until something is played. A skinned
/// mesh is an entity of its own at the top of the scene, since glTF ignores the transform of its
/// node. Files beside this one are read only
/// from its folder and below. Fails with ErrorCode::InvalidInput or Io and one sentence that names
/// the file, the place in it, the value and the limit.
[[nodiscard]] Result<Scene> load_gltf(const std::filesystem::path& path,
                                      const GltfOptions& options = {});

/// The same from memory; external buffers are then refused. `name` stands for the file in messages.
[[nodiscard]] Result<Scene> load_glb(std::span<const std::byte> bytes, const std::string& name,
                                     const GltfOptions& options = {});

}  // namespace gnomon::scene
#pragma GCC visibility pop
