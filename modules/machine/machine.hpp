// SPDX-License-Identifier: MIT
//
// Where something was measured: processor, caches, system. For the programs that publish numbers;
// no library depends on it. It names no machine and nobody.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::machine {

/// What the system does not say is empty or 0.
struct Machine {
    std::string processor;
    std::uint32_t cores = 0;  ///< usable_cores()
    std::uint64_t l2_bytes = 0;
    std::uint64_t l3_bytes = 0;
    std::string system;  ///< the distribution and its version
};
/// Cost: some small files are read.
[[nodiscard]] Machine this_machine();

/// Threads that can run at once: of the processors that this process may use, as many as a
/// container's quota pays for, rounded up. At least 1. The processors of a large host say little
/// within a small container. Cost: a small file is read.
[[nodiscard]] std::uint32_t usable_cores();

/// From a control group's `cpu.max`: microseconds of quota and of period, as in "1600000 100000".
/// Empty for "max 100000" and for what is neither.
[[nodiscard]] std::optional<std::uint32_t> cores_of_quota(std::string_view cpu_max);

}  // namespace gnomon::machine
