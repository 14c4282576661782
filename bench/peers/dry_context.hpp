// SPDX-License-Identifier: MIT
//
// An OpenGL context of gnomon's whose draws and clears do nothing: what a frame takes on it is the
// processor's part.
#pragma once

#include <memory>

#include <gnomon/gl/context.hpp>

namespace gnomon::peers {

[[nodiscard]] std::unique_ptr<gl::Context> make_dry(std::unique_ptr<gl::Context> context);

}  // namespace gnomon::peers
