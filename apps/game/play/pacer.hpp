// SPDX-License-Identifier: MIT
//
// Pacer: when the next frame begins. Motion looks even where every frame has the same number of
// ticks and frames come as evenly as ticks do. So a frame waits for the tick that is due, and not
// where the screen has set the pace already; input makes a frame in between, in which only the
// camera turns. It reads no clock and does not sleep.
#pragma once

namespace gnomon::game {

/// A frame that is early by no more than this is on time: the screen, which presenting waited for,
/// trembles, and whoever waits on would miss its next picture.
inline constexpr double ready_s = 0.0015;
/// No two frames come faster, however often a mouse reports: 250 a second.
inline constexpr double least_frame_s = 0.004;

/// How long to sleep, `since_s` after the last frame began, where the next one is due `due_s` after
/// that; 0: it begins. Input is looked at between naps. The last nap ends when the frame is due,
/// and not `ready_s` before, which would add up.
[[nodiscard]] inline double nap_s(double since_s, double due_s) {
    constexpr double plain_nap_s = 0.004;
    const double rest_s = due_s - since_s;
    if (!(rest_s > ready_s)) return 0.0;
    return rest_s < plain_nap_s + 2.0 * ready_s ? rest_s : plain_nap_s;
}

}  // namespace gnomon::game
