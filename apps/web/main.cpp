// SPDX-License-Identifier: MIT
//
// What the page calls: one function, an order in JSON in, an answer in JSON out, which is good
// until the next call.
#include <string>

#include <emscripten/emscripten.h>

#include "viewer.hpp"

extern "C" EMSCRIPTEN_KEEPALIVE const char* gnomon_web_obey(const char* order);

const char* gnomon_web_obey(const char* text) {
    using gnomon::web::Viewer;
    static Viewer viewer;
    static std::string answer;
    const auto order = Viewer::Json::parse(text, nullptr, false);
    const auto json = order.is_object()
                          ? viewer.obey(order)
                          : Viewer::Json{{"error", "The order is no object in JSON."}};
    answer = json.dump(-1, ' ', false, Viewer::Json::error_handler_t::replace);
    return answer.c_str();
}
