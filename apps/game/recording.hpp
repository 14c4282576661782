// SPDX-License-Identifier: MIT
//
// Recordings: the inputs of every tick of a game, as text that can be read and compared line by
// line (docs/game.md, "Recordings"):
//
//     gnomon-replay 1
//     level courtyard
//     ticks 312
//     120 0 -127 -
//     192 127 0 s
//     end
//
// A line of input is how many ticks it lasts, the axes east and south, and letters: s sneak, r run,
// n restart (anew), p pause, or - for none.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/result.hpp>

#include "player.hpp"

namespace gnomon::game {

struct Recording {
    std::string level;  ///< its name among the levels; is_level_name()
    std::vector<Input> inputs;

    bool operator==(const Recording&) const = default;
};

/// At most, of a recording: an hour.
inline constexpr std::size_t most_ticks = 216000;

/// 1 to 60 letters, digits, "-" or "_": a word of a line, and a file's name anywhere.
[[nodiscard]] bool is_level_name(std::string_view name);

/// The recording's level must be a name by is_level_name(), its inputs no more than `most_ticks`,
/// and their axes from -127 to 127.
[[nodiscard]] std::string to_text(const Recording& recording);

/// The inverse of to_text(). Fails with ErrorCode::InvalidInput, one sentence that names `file`,
/// line, value and limit; so does anything that follows the last line.
[[nodiscard]] Result<Recording> read_recording(std::string_view text, const std::string& file);

}  // namespace gnomon::game
