// SPDX-License-Identifier: MIT
//
// What the viewer's page calls.
#include <emscripten/emscripten.h>

#include "answer.hpp"
#include "viewer.hpp"

extern "C" EMSCRIPTEN_KEEPALIVE const char* gnomon_web_obey(const char* order);

const char* gnomon_web_obey(const char* order) {
    static gnomon::web::Viewer viewer;
    return gnomon::web::answer_of(viewer, order);
}
