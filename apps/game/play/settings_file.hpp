// SPDX-License-Identifier: MIT
//
// The file that the window's game keeps its settings in.
#pragma once

#include <filesystem>
#include <string>

#include <gnomon/core/result.hpp>

#include "play/settings.hpp"

namespace gnomon::game {

/// $XDG_CONFIG_HOME/gnomon/game.json, or in ~/.config; empty where there is neither.
[[nodiscard]] std::filesystem::path settings_path();

struct LoadedSettings {
    Settings settings;
    std::string complaint;  ///< one sentence where the file cannot be used; then all are defaults
};
/// Of no file, or an empty path, the defaults.
[[nodiscard]] LoadedSettings load_settings(const std::filesystem::path& path);

/// Under another name first, then renamed; folders are made. Fails with ErrorCode::Io; an empty
/// path is nothing to do.
[[nodiscard]] Status save_settings(const std::filesystem::path& path, const Settings& settings);

}  // namespace gnomon::game
