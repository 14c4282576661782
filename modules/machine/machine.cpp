// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <fstream>
#include <thread>

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

#include <gnomon/machine/machine.hpp>

namespace gnomon::machine {

namespace {

// What follows the first line that begins with `key`, without separators and quotes.
std::string value_after(const char* path, std::string_view key) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with(key)) continue;
        const std::size_t first = line.find_first_not_of(" \t:=\"", key.size());
        if (first == std::string::npos) return {};
        return line.substr(first, line.find_last_not_of(" \t\"") + 1 - first);
    }
    return {};
}

#if defined(_SC_LEVEL2_CACHE_SIZE)
std::uint64_t cache_bytes(int which) {
    const long bytes = sysconf(which);
    return bytes > 0 ? static_cast<std::uint64_t>(bytes) : 0;
}
#endif

}  // namespace

std::optional<std::uint32_t> cores_of_quota(std::string_view cpu_max) {
    std::uint64_t quota = 0;
    std::uint64_t period = 0;
    const char* const end = cpu_max.data() + cpu_max.size();
    const auto first = std::from_chars(cpu_max.data(), end, quota);
    if (first.ec != std::errc{} || first.ptr == end || *first.ptr != ' ') return std::nullopt;
    const auto second = std::from_chars(first.ptr + 1, end, period);
    if (second.ec != std::errc{} || period == 0) return std::nullopt;
    const std::uint64_t cores = quota / period + (quota % period != 0 ? 1 : 0);
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(cores, 1, 1U << 20U));
}

std::uint32_t usable_cores() {
    const std::uint32_t processors = std::max(1U, std::thread::hardware_concurrency());
    std::ifstream file("/sys/fs/cgroup/cpu.max");
    std::string line;
    if (!std::getline(file, line)) return processors;
    return std::min(processors, cores_of_quota(line).value_or(processors));
}

Machine this_machine() {
    Machine machine;
    machine.processor = value_after("/proc/cpuinfo", "model name");
    machine.cores = usable_cores();
#if defined(_SC_LEVEL2_CACHE_SIZE)
    machine.l2_bytes = cache_bytes(_SC_LEVEL2_CACHE_SIZE);
    machine.l3_bytes = cache_bytes(_SC_LEVEL3_CACHE_SIZE);
#endif
    machine.system = value_after("/etc/os-release", "PRETTY_NAME");
    return machine;
}

}  // namespace gnomon::machine
