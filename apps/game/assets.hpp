// SPDX-License-Identifier: MIT
//
// Levels and recordings as files, and where they lie: beside the program, in share/gnomon/game,
// both where it was built and where it was installed, wherever that has been moved to. What is in
// them is level.hpp's and recording.hpp's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>

#include "level.hpp"
#include "recording.hpp"

namespace gnomon::game {

/// Fails as read_level(), and with ErrorCode::Io where the file cannot be read or has more than a
/// mebibyte.
[[nodiscard]] Result<Level> load_level(const std::filesystem::path& path);

/// Fails as read_recording(), and with ErrorCode::Io where the file cannot be read or has more than
/// eight mebibytes.
[[nodiscard]] Result<Recording> load_recording(const std::filesystem::path& path);

/// The folder that holds levels/; may be missing.
[[nodiscard]] std::filesystem::path assets_folder();

/// Names of all levels in a folder of assets, in the order in which they are played: of the files
/// levels/NAME.json whose names recordings can hold (is_level_name()). Fails with ErrorCode::Io
/// where the folder cannot be read.
[[nodiscard]] Result<std::vector<std::string>> level_names(const std::filesystem::path& assets);

/// A level by its name. Fails as level_names() and load_level(), and with ErrorCode::InvalidInput
/// where there is none of that name.
[[nodiscard]] Result<Level> load_named_level(const std::filesystem::path& assets,
                                             const std::string& name);

}  // namespace gnomon::game
