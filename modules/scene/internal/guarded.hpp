// SPDX-License-Identifier: MIT
//
// The border of the readers: what is thrown inside becomes a Result.
#pragma once

#include <new>
#include <string>

#include <gnomon/core/result.hpp>

#include "internal/json_place.hpp"

namespace gnomon::scene::internal {

template <class Read>
auto guarded(const std::string& name, const Read& read) -> Result<decltype(read())> {
    try {
        return read();
    } catch (const InputError& error) {
        return tl::unexpected<Error>(error.error);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::OutOfMemory, name + ": there is not enough memory to read it.");
    } catch (const std::exception& error) {
        return fail(ErrorCode::Internal, name + ": reading failed: " + error.what() + ".");
    }
}

}  // namespace gnomon::scene::internal
