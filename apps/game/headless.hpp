// SPDX-License-Identifier: MIT
//
// Games without a window: a recording is played as fast as it goes, and pictures of it are kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <gnomon/core/result.hpp>

#include "level.hpp"
#include "recording.hpp"
#include "world.hpp"

namespace gnomon::game {

struct CaptureOptions {
    std::filesystem::path folder;  ///< made where it is missing; empty: no pictures
    std::uint32_t every = 60;  ///< ticks from picture to picture; the first and the last are kept
    std::string backend;       ///< empty: the first that works
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint32_t samples = 4;
};

struct Ended {
    Outcome outcome = Outcome::Playing;
    Tick ticks = 0;          ///< of the game, since its last restart
    std::uint64_t hash = 0;  ///< World::hash() at the end
    std::uint32_t pictures = 0;
};

/// Pictures are named by the place of their input in the recording: tick_000120.png.
[[nodiscard]] Result<Ended> play(const Level& level, const Recording& recording,
                                 const CaptureOptions& capture = {});

}  // namespace gnomon::game
