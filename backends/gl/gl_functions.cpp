// SPDX-License-Identifier: MIT
#include "internal/gl_functions.hpp"

namespace gnomon::gl {

Status load_required_functions(const Context& context, GlFunctions& gl) {
#define GNOMON_GL_LOAD(name)                                                          \
    if (const Status loaded = load_function(context, gl.name, "gl" #name); !loaded) { \
        return loaded;                                                                \
    }
    GNOMON_GL_REQUIRED_FUNCTIONS(GNOMON_GL_LOAD)
#undef GNOMON_GL_LOAD
    return {};
}

}  // namespace gnomon::gl
