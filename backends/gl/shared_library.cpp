// SPDX-License-Identifier: MIT
#include "internal/shared_library.hpp"

#include <dlfcn.h>

namespace gnomon::gl {

Result<SharedLibrary> SharedLibrary::open(const char* file, const std::string& purpose) {
    void* handle = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
        const char* reason = dlerror();
        return fail(ErrorCode::Unsupported,
                    std::string("The library ") + file + ", which is needed for " + purpose +
                        ", cannot be opened (" + (reason != nullptr ? reason : "no reason given") +
                        ").");
    }
    return SharedLibrary(handle, file);
}

void* SharedLibrary::symbol(const char* name) const { return dlsym(handle_, name); }

}  // namespace gnomon::gl
