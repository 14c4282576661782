// SPDX-License-Identifier: MIT
//
// What the page calls: one function, an order in JSON in, an answer in JSON out, which is good
// until the next call.
#include <new>
#include <string>

#include <emscripten/emscripten.h>

#include "viewer.hpp"

extern "C" EMSCRIPTEN_KEEPALIVE const char* gnomon_web_obey(const char* order);

const char* gnomon_web_obey(const char* text) {
    using gnomon::web::Viewer;
    static Viewer viewer;
    static std::string answer;
    Viewer::Json json;
    try {
        const auto order = Viewer::Json::parse(text, nullptr, false);
        json = order.is_object() ? viewer.obey(order)
                                 : Viewer::Json{{"error", "The order is no object in JSON."}};
    } catch (const std::bad_alloc&) {
        json = {{"error", "There is not enough memory for this in the browser."}};
    } catch (const Viewer::Json::exception& exception) {
        json = {{"error", std::string("The order cannot be read: ") + exception.what() + "."}};
    }
    answer = json.dump(-1, ' ', false, Viewer::Json::error_handler_t::replace);
    return answer.c_str();
}
