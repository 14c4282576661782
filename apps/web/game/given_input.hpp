// SPDX-License-Identifier: MIT
//
// What the page has heard of keyboard, pointers and gamepads, as the input that the game reads in
// its window, too: so keys, dead zones and menus are the same in both.
#pragma once

#include <nlohmann/json.hpp>

#include <gnomon/input/input.hpp>

#include "play/screens.hpp"

namespace gnomon::web {

/// One frame's. `given` may have
///   keys     [[name, pressed], ...]   names as input::name_of() has them, in the order of events
///   turn     [right, down]            by which a pointer was dragged, pixels of the page
///   scroll   notches                  away from the user
///   gamepad  {left: [x, y], right: [x, y], triggers: [left, right], buttons: [place, ...]}
///   lost     true                     the keyboard is another window's, or the gamepad is gone
/// What is of another kind is nothing.
void take(const nlohmann::json& given, input::Input& input);

/// Beside what keys and gamepad choose: {point: place, accept, step}, of the menu's lines.
void take_choice(const nlohmann::json& given, game::MenuPress& press);

}  // namespace gnomon::web
