// SPDX-License-Identifier: MIT
//
// A glTF file taken apart: its JSON and its binary chunk. Nothing of the JSON is trusted yet
// (gltf_check.hpp).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace gnomon::scene::internal {

/// Offsets of larger files would not fit where tinygltf keeps them.
constexpr std::uint64_t largest_file = 0x7FFF'FFFF;

struct GltfFile {
    std::string name;                             ///< as messages call it
    std::optional<std::filesystem::path> folder;  ///< where other files are looked for, if anywhere
    nlohmann::json json;
    std::optional<std::vector<std::byte>> binary_chunk;
};

/// The whole file; throws InputError (Io) when it cannot be read, naming `asked_by` as the file at
/// fault.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& path,
                                               const std::string& asked_by);

/// A .glb (recognised by its first four bytes) or .gltf in memory. Throws InputError.
[[nodiscard]] GltfFile take_apart(std::span<const std::byte> bytes, const std::string& name);

}  // namespace gnomon::scene::internal
