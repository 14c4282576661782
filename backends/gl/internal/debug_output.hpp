// SPDX-License-Identifier: MIT
//
// What the driver says, outside of return values: KHR_debug messages into the message sink, and
// glGetError into a Status.
#pragma once

#include <string>
#include <string_view>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/message_sink.hpp>

#include "internal/gl_functions.hpp"

namespace gnomon::gl {

/// What every driver takes for a label or a debug group, less the terminating zero.
inline constexpr std::size_t max_label_length = 255;

/// The sink has to stay where it is until uninstall_debug_output.
void install_debug_output(const GlFunctions& gl, const gpu::MessageSink& sink);
void uninstall_debug_output(const GlFunctions& gl);

/// Names a GL object for debuggers; a label that is too long is cut.
void set_label(const GlFunctions& gl, GLenum kind, GLuint name, std::string_view label);

/// Takes all errors that GL holds; `action` begins the sentence: "Creating [Buffer \"x\"]".
[[nodiscard]] Status check_errors(const GlFunctions& gl, const std::string& action);

/// Forgets the errors that GL holds.
void drop_errors(const GlFunctions& gl);

}  // namespace gnomon::gl
