// SPDX-License-Identifier: MIT
//
// What a game in a window was asked for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>

#include "headless.hpp"
#include "recording.hpp"

namespace gnomon::game {

struct PlayOptions {
    std::filesystem::path assets = {};
    std::string level = {};  ///< begins with it; empty: with the title
    std::optional<Recording> watched =
        std::nullopt;                       ///< plays this instead of what somebody presses
    double speed = 1.0;                     ///< of `watched`
    std::filesystem::path record = {};      ///< what is pressed in the level that was played last
    std::filesystem::path capture = {};     ///< a folder for pictures; empty: none
    bool masks = false;                     ///< and the stencil counts of each
    std::uint32_t every = 60;               ///< ticks from picture to picture
    std::filesystem::path screenshot = {};  ///< of what the window showed last
    std::filesystem::path script = {};      ///< input instead of keyboard, mouse and gamepad
    std::optional<std::uint32_t> frames = std::nullopt;
    std::optional<glm::uvec2> size_px = std::nullopt;
    // Instead of what the settings say:
    std::optional<std::string> backend = std::nullopt;
    std::optional<std::uint32_t> samples = std::nullopt;
    std::filesystem::path settings = {};  ///< their file; empty: nothing is remembered
};

/// Opens the window; returns when it was closed, with how `watched` ended where that was played to
/// its end. Sentences that are no reason to stop go to stderr. Fails with ErrorCode::Unsupported
/// where no window opens.
[[nodiscard]] Result<std::optional<Ended>> play_in_window(const PlayOptions& options);

}  // namespace gnomon::game
