// SPDX-License-Identifier: MIT
//
// What pages call of their programs: one function, an order in JSON in, an answer in JSON out.
#pragma once

#include <new>
#include <string>

namespace gnomon::web {

/// A program's answer, which is good until its next one.
template <class Program>
const char* answer_of(Program& program, const char* text) {
    using Json = typename Program::Json;
    static std::string answer;
    Json json;
    try {
        const auto order = Json::parse(text, nullptr, false);
        json = order.is_object() ? program.obey(order)
                                 : Json{{"error", "The order is no object in JSON."}};
    } catch (const std::bad_alloc&) {
        json = {{"error", "There is not enough memory for this in the browser."}};
    } catch (const typename Json::exception& exception) {
        json = {{"error", std::string("The order cannot be read: ") + exception.what() + "."}};
    }
    answer = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return answer.c_str();
}

}  // namespace gnomon::web
