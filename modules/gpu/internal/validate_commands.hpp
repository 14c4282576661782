// SPDX-License-Identifier: MIT
//
// The rules of what an encoder recorded, checked once at finish(), and of what may have happened
// between finish() and submit().
#pragma once

#include <vector>

#include "internal/device_state.hpp"

namespace gnomon::gpu {

/// All violations in `commands`, one a line, and before them those that `misuse` holds already.
/// Cost: linear in the number of commands; no text is built where nothing is wrong.
[[nodiscard]] Status validate_commands(const DeviceState& device, const CommandBuffer& commands,
                                       const std::vector<std::string>& misuse);

/// Everything that valid commands name is still alive, also what their bind groups name.
[[nodiscard]] Status validate_submit(const DeviceState& device, const CommandBuffer& commands);

}  // namespace gnomon::gpu
