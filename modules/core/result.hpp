// SPDX-License-Identifier: MIT
//
// Error and Result: how every function of gnomon that can fail says so.
//
// Bad data (a file, a mesh, a descriptor) and a broken environment (a driver, memory) come back as
// a Result whose Error holds one sentence that names the value, the place and the limit. A caller's
// bug is an assertion instead (expects.hpp). Nothing is thrown across a public border, nothing
// prints, nothing exits.
#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

#pragma GCC visibility push(default)
namespace gnomon {

/// What went wrong, for code that has to act on it. People read Error::message.
enum class ErrorCode {
    InvalidInput,  ///< bad data: a file, a mesh, an argument
    Validation,    ///< a GPU call that the interface's rules forbid
    Unsupported,   ///< valid, but this adapter or build cannot do it
    OutOfMemory,   ///< of the device or of the process
    DeviceLost,    ///< the device is gone: make a new one
    Io,            ///< a file could not be read or written
    Internal,      ///< the environment broke a promise (driver failure)
};

/// Why something failed.
struct Error {
    ErrorCode code = ErrorCode::Internal;  ///< for code that has to act
    std::string message;                   ///< one full sentence
};

/// A value or the reason why there is none.
template <class T>
using Result = tl::expected<T, Error>;

/// Success or the reason why not.
using Status = Result<void>;

/// `return fail(ErrorCode::Io, "…");` in any function that returns a Result.
[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string message) {
    return tl::unexpected<Error>(Error{code, std::move(message)});
}

/// Hands on another Result's error: `if (!x) return forward_error(x);`
template <class T>
[[nodiscard]] tl::unexpected<Error> forward_error(const Result<T>& failed) {
    return tl::unexpected<Error>(failed.error());
}

}  // namespace gnomon
#pragma GCC visibility pop
