// SPDX-License-Identifier: MIT
//
// Readout: what the head-up display shows, as numbers, for whatever draws it: letters over the
// window's picture (hud.cpp) or a page of the browser's.
#pragma once

#include <optional>

#include <glm/glm.hpp>

#include <gnomon/shadows/view.hpp>

#include "exposure.hpp"
#include "level.hpp"

namespace gnomon::game {

/// How far what a level has to say is to be seen: 0 not at all, 1 wholly.
struct Captions {
    double name = 0.0;        ///< of the level, large
    double hint = 0.0;        ///< until there was time to read it, and somebody has moved
    double first_step = 0.0;  ///< words::first_step, which pulses unless it is to keep still
};
/// `shown_s`: since the level began, restarts included. `waits`: for the first step.
[[nodiscard]] Captions captions_at(double shown_s, bool waits, bool keeps_still = false);

/// How alarmed the meter's colour is: 0 is the colour of `Meter::is_seen` or its opposite.
[[nodiscard]] double alarm_tint(const Meter& meter);

/// Where the exit is shown in a picture of `size`, both in the same unit.
struct ExitMark {
    glm::vec2 at{0.0F};
    /// Away from the middle, of length 1: where the exit is out of the picture, and `at` at its
    /// border. None: it is at `at`.
    std::optional<glm::vec2> way;
};
/// What is nearer to a border counts as out of the picture: other things are shown there.
struct Margins {
    float side = 64.0F;
    float above = 64.0F;
    float below = 96.0F;
};
/// None where the exit is straight behind the eye.
[[nodiscard]] std::optional<ExitMark> exit_mark(const Level& level, const shadows::View& view,
                                                const glm::vec2& size, const Margins& margins = {});

}  // namespace gnomon::game
