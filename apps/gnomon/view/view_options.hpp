// SPDX-License-Identifier: MIT
//
// What `gnomon view` was asked for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>

#include "render_options.hpp"

namespace gnomon::cli {

struct ViewOptions {
    RenderOptions render = {};  ///< scene, camera, lights, how shadows are made; size of the window
    std::filesystem::path script = {};      ///< input to play instead of reading mouse and keyboard
    std::filesystem::path screenshot = {};  ///< written when it ends
    bool panel = true;                      ///< begins with panel, hints and probe
    bool ground = false;                    ///< a floor below the scene
    std::optional<std::uint32_t> frames = std::nullopt;  ///< ends after so many
};

[[nodiscard]] const CLI::App* add_view(CLI::App& app, ViewOptions& options);

/// Opens the window; returns when it was closed.
[[nodiscard]] Status run_view(const ViewOptions& asked);

}  // namespace gnomon::cli
