// SPDX-License-Identifier: MIT
#include <fstream>
#include <thread>

#include <gnomon/report/report.hpp>

namespace gnomon::report {

namespace {

// What follows the first line that begins with `key`, without separators and quotes.
std::string value_after(const char* path, const std::string& key) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with(key)) continue;
        const std::size_t first = line.find_first_not_of(" \t:=\"", key.size());
        if (first == std::string::npos) return {};
        return line.substr(first, line.find_last_not_of(" \t\"") + 1 - first);
    }
    return {};
}

}  // namespace

Machine this_machine() {
    return {value_after("/proc/cpuinfo", "model name"), std::thread::hardware_concurrency(),
            value_after("/etc/os-release", "PRETTY_NAME")};
}

}  // namespace gnomon::report
