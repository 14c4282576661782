// SPDX-License-Identifier: MIT
//
// A library opened at run time with its symbols kept to itself. OSMesa exports the core gl symbols
// too, so it must never be linked nor opened globally beside libGL. It is never unloaded: drivers
// leave threads and exit handlers behind that would then run into a hole.
#pragma once

#include <string>

#include <gnomon/core/result.hpp>

namespace gnomon::gl {

class SharedLibrary {
public:
    /// `purpose` completes the sentence "…, which is needed for <purpose>".
    [[nodiscard]] static Result<SharedLibrary> open(const char* file, const std::string& purpose);

    [[nodiscard]] void* symbol(const char* name) const;

    /// Sets a function pointer; the error names the function and the library.
    template <class Function>
    [[nodiscard]] Status load(Function& function, const char* name) const {
        void* address = symbol(name);
        if (address == nullptr) {
            return fail(ErrorCode::Unsupported,
                        "The library " + file_ + " has no function " + name + ".");
        }
        function = reinterpret_cast<Function>(address);
        return {};
    }

private:
    SharedLibrary(void* handle, const char* file) : handle_(handle), file_(file) {}

    void* handle_;
    std::string file_;
};

}  // namespace gnomon::gl
