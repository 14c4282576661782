// SPDX-License-Identifier: MIT
//
// A context that counts the GL objects made and deleted through it: glGen*, glCreate* and
// glDelete* are wrapped on their way to the backend. It shows a leak that GL itself would not.
#pragma once

#include <map>
#include <memory>
#include <string>

#include <gnomon/gl/context.hpp>

namespace gnomon::gl_tests {

struct ObjectCounts {
    std::map<std::string, int> made;   ///< by kind: "Buffers", "Textures", …
    std::map<std::string, int> alive;  ///< made less deleted
};

/// One such context may exist at a time, since GL's functions carry no context. `counts` outlives
/// it. `missing_function`, if not empty, is not to be found.
[[nodiscard]] std::unique_ptr<gl::Context> make_counting_context(std::unique_ptr<gl::Context> inner,
                                                                 ObjectCounts& counts,
                                                                 std::string missing_function = {});

}  // namespace gnomon::gl_tests
