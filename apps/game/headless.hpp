// SPDX-License-Identifier: MIT
//
// Games without a window: a recording is played as fast as it goes, and pictures of it are kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <gnomon/core/result.hpp>

#include "frame_times.hpp"
#include "level.hpp"
#include "recording.hpp"
#include "world.hpp"

namespace gnomon::game {

struct CaptureOptions {
    std::filesystem::path folder;  ///< made where it is missing; empty: no pictures
    bool masks = false;            ///< with the pictures (Capture)
    bool times = false;            ///< measure frames; they are kept as pictures in `folder` alone
    std::uint32_t every = 60;      ///< ticks from frame to frame; the first and the last are drawn
    std::string backend;           ///< empty: the first that works
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint32_t samples = 4;
};

struct Ended {
    Outcome outcome = Outcome::Playing;
    Tick ticks = 0;          ///< of the game, since its last restart
    std::uint64_t hash = 0;  ///< World::hash() at the end
    std::uint32_t pictures = 0;
    std::string adapter = {};  ///< what drew; empty: nothing did
    FrameTimes times = {};  ///< without the first frame, which uploads; empty where not asked for
};

/// What is drawn is kept as Capture has it.
[[nodiscard]] Result<Ended> play(const Level& level, const Recording& recording,
                                 const CaptureOptions& capture = {});

}  // namespace gnomon::game
