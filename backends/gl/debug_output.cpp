// SPDX-License-Identifier: MIT
#include "internal/debug_output.hpp"

#include <fmt/format.h>

#include <initializer_list>

namespace gnomon::gl {
namespace {

// A context in a broken state may return errors for ever; nobody needs more than a few.
constexpr int max_errors = 32;

gpu::Severity severity_of(GLenum type, GLenum severity) {
    switch (type) {
        case GL_DEBUG_TYPE_ERROR: return gpu::Severity::Error;
        case GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR:
        case GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR: return gpu::Severity::Warning;
        case GL_DEBUG_TYPE_PERFORMANCE: return gpu::Severity::Info;
        default: break;
    }
    return severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM
               ? gpu::Severity::Warning
               : gpu::Severity::Info;
}

void APIENTRY on_message(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum severity,
                         GLsizei length, const GLchar* text, const void* user) {
    const auto& sink = *static_cast<const gpu::MessageSink*>(user);
    const std::string_view message = length < 0
                                         ? std::string_view(text)
                                         : std::string_view(text, static_cast<std::size_t>(length));
    sink(severity_of(type, severity), message);
}

const char* error_name(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM: return "GL_INVALID_ENUM";
        case GL_INVALID_VALUE: return "GL_INVALID_VALUE";
        case GL_INVALID_OPERATION: return "GL_INVALID_OPERATION";
        case GL_INVALID_FRAMEBUFFER_OPERATION: return "GL_INVALID_FRAMEBUFFER_OPERATION";
        case GL_OUT_OF_MEMORY: return "GL_OUT_OF_MEMORY";
        case GL_CONTEXT_LOST: return "GL_CONTEXT_LOST";
        default: return "an unknown error";
    }
}

ErrorCode code_of(GLenum error) {
    switch (error) {
        case GL_OUT_OF_MEMORY: return ErrorCode::OutOfMemory;
        case GL_CONTEXT_LOST: return ErrorCode::DeviceLost;
        default: return ErrorCode::Internal;
    }
}

}  // namespace

void install_debug_output(const GlFunctions& gl, const gpu::MessageSink& sink) {
    if (!sink) return;
    gl.Enable(GL_DEBUG_OUTPUT);
    gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl.DebugMessageCallback(&on_message, &sink);
    // Our own groups would only echo.
    for (const GLenum type :
         std::initializer_list<GLenum>{GL_DEBUG_TYPE_PUSH_GROUP, GL_DEBUG_TYPE_POP_GROUP}) {
        gl.DebugMessageControl(GL_DONT_CARE, type, GL_DONT_CARE, 0, nullptr, GL_FALSE);
    }
}

void uninstall_debug_output(const GlFunctions& gl) { gl.DebugMessageCallback(nullptr, nullptr); }

void set_label(const GlFunctions& gl, GLenum kind, GLuint name, std::string_view label) {
    label = label.substr(0, max_label_length);
    gl.ObjectLabel(kind, name, static_cast<GLsizei>(label.size()), label.data());
}

Status check_errors(const GlFunctions& gl, const std::string& action) {
    if (gl.GetGraphicsResetStatus != nullptr && gl.GetGraphicsResetStatus() != GL_NO_ERROR) {
        return fail(ErrorCode::DeviceLost,
                    fmt::format("{} failed: the OpenGL context was lost by a reset.", action));
    }
    const GLenum first = gl.GetError();
    if (first == GL_NO_ERROR) return {};
    drop_errors(gl);
    return fail(code_of(first), fmt::format("{} failed: the OpenGL driver reports {} (0x{:04X}).",
                                            action, error_name(first), first));
}

void drop_errors(const GlFunctions& gl) {
    for (int i = 0; i < max_errors && gl.GetError() != GL_NO_ERROR; ++i) {
    }
}

}  // namespace gnomon::gl
