// SPDX-License-Identifier: MIT
//
// Head-up display: what whoever plays has to know: how well they are seen, how alarmed the others
// are, where the exit is, and what the level has to say.
#pragma once

#include <gnomon/shadows/view.hpp>

#include "play/canvas.hpp"
#include "play/session.hpp"

namespace gnomon::game {

struct HudState {
    double shown_s = 0.0;  ///< since the level began, restarts included
    bool watches = false;  ///< a recording plays
    bool waits = false;    ///< for the first step
};

void draw_hud(const Canvas& canvas, const Session& session, const shadows::View& view,
              const HudState& state);

}  // namespace gnomon::game
