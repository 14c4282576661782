// SPDX-License-Identifier: MIT
#include "machine.hpp"

#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace gnomon::bench {

namespace {

// What follows the first line that begins with `key`, without separators and quotes.
std::string value_in(const char* path, const std::string& key) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with(key)) continue;
        const std::size_t first = line.find_first_not_of(" \t:=\"", key.size());
        if (first == std::string::npos) return {};
        return line.substr(first, line.find_last_not_of(" \t\"") + 1 - first);
    }
    return {};
}

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
    nlohmann::ordered_json machine;
    const auto add = [&](const char* name, const std::string& value) {
        if (!value.empty()) machine[name] = value;
    };
    add("processor", value_in("/proc/cpuinfo", "model name"));
    machine["cores"] = std::thread::hardware_concurrency();
#if defined(_SC_LEVEL2_CACHE_SIZE)
    if (const long bytes = sysconf(_SC_LEVEL2_CACHE_SIZE); bytes > 0) machine["l2_bytes"] = bytes;
    if (const long bytes = sysconf(_SC_LEVEL3_CACHE_SIZE); bytes > 0) machine["l3_bytes"] = bytes;
#endif
    add("system", value_in("/etc/os-release", "PRETTY_NAME"));
#if defined(__clang__)
    add("compiler", "clang " __clang_version__);
#elif defined(__GNUC__)
    add("compiler", "GCC " __VERSION__);
#endif
    add("flags", GNOMON_BENCH_FLAGS);
    add("date", today());
    return machine;
}

}  // namespace gnomon::bench
