// SPDX-License-Identifier: MIT
#include "machine.hpp"

#include <ctime>
#include <string>

#include <gnomon/machine/machine.hpp>

namespace gnomon::bench {

namespace {

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[16];
    const std::size_t length = std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
    return std::string(text, length);
}

}  // namespace

nlohmann::ordered_json describe_machine() {
    nlohmann::ordered_json description;
    const auto add = [&](const char* name, const std::string& value) {
        if (!value.empty()) description[name] = value;
    };
    const machine::Machine found = machine::this_machine();
    add("processor", found.processor);
    description["cores"] = found.cores;
    if (found.l2_bytes > 0) description["l2_bytes"] = found.l2_bytes;
    if (found.l3_bytes > 0) description["l3_bytes"] = found.l3_bytes;
    add("system", found.system);
#if defined(__clang__)
    add("compiler", "clang " __clang_version__);
#elif defined(__GNUC__)
    add("compiler", "GCC " __VERSION__);
#endif
    add("flags", GNOMON_BENCH_FLAGS);
    add("date", today());
    return description;
}

}  // namespace gnomon::bench
