// SPDX-License-Identifier: MIT
//
// The one outlet for what a device has to say outside of a Result: driver messages, validation
// layers, choices made at start-up. A library never prints; the host decides what becomes of a
// message.
#pragma once

#include <functional>
#include <string_view>

#pragma GCC visibility push(default)
namespace gnomon::gpu {

/// How bad what a driver says is.
enum class Severity {
    Info,     ///< nothing to do
    Warning,  ///< works, but perhaps not as meant, or slowly
    Error,    ///< a call failed or means nothing
};

/// Called on the thread that made the GPU call. May be empty: messages are then dropped.
using MessageSink = std::function<void(Severity, std::string_view message)>;

}  // namespace gnomon::gpu
#pragma GCC visibility pop
