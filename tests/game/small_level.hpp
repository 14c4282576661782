// SPDX-License-Identifier: MIT
//
// A level for tests of rules: bare ground, sixteen by twelve metres, no light.
#pragma once

#include "level.hpp"

namespace gnomon::game {

inline Level bare_level() {
    Level level;
    level.name = "bare";
    level.size_m = {16.0, 12.0};
    level.start = {-5.0, 0.0};
    level.exit = {6.0, 0.0};
    return level;
}

/// As high as `lux` everywhere but in shadows: straight from above.
inline Sun noon(double lux) {
    return {.from_rad = {0.0, 1.5707}, .to_rad = {0.0, 1.5707}, .lux = lux};
}

}  // namespace gnomon::game
