// SPDX-License-Identifier: MIT
//
// What the game's page calls.
#include <emscripten/emscripten.h>

#include "answer.hpp"
#include "game/game.hpp"

extern "C" EMSCRIPTEN_KEEPALIVE const char* gnomon_web_obey(const char* order);

const char* gnomon_web_obey(const char* order) {
    static gnomon::web::Game game;
    return gnomon::web::answer_of(game, order);
}
