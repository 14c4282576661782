// SPDX-License-Identifier: MIT
#include "devices.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gnomon/gpu/null_backend.hpp>
#if GNOMON_HAS_GL
#include <gnomon/gl/backend.hpp>
#endif
#if GNOMON_HAS_VK
#include <gnomon/vk/backend.hpp>
#endif

namespace gnomon::cli {

namespace {

#if GNOMON_HAS_GL || GNOMON_HAS_VK
Result<gpu::Device> device_of(Result<std::unique_ptr<gpu::Backend>> backend) {
    if (!backend) return forward_error(backend);
    return gpu::Device(std::move(*backend));
}
#endif

#if GNOMON_HAS_GL
Result<gpu::Device> create_gl(const DeviceRequest& request) {
    gl::BackendOptions options;
    options.message_sink = request.message_sink;
    if (request.gl_stencil == "two-side") options.stencil_path = gl::StencilPath::TwoSide;
    if (request.gl_stencil == "separate") options.stencil_path = gl::StencilPath::Separate;
    if (request.gl_stencil == "two-pass") options.stencil_path = gl::StencilPath::TwoPass;
    auto context = gl::create_headless_context();
    if (!context) return forward_error(context);
    return device_of(gl::create_backend(std::move(*context), options));
}
#endif

#if GNOMON_HAS_VK
Result<gpu::Device> create_vk(const DeviceRequest& request) {
    vk::BackendOptions options;
    options.message_sink = request.message_sink;
    return device_of(vk::create_backend(options));
}
#endif

}  // namespace

std::vector<std::string> backend_names() {
    std::vector<std::string> names;
#if GNOMON_HAS_GL
    names.emplace_back("gl");
#endif
#if GNOMON_HAS_VK
    names.emplace_back("vk");
#endif
    names.emplace_back("null");
    return names;
}

namespace {

Result<gpu::Device> create_named(const std::string& backend, const DeviceRequest& request) {
    if (!request.gl_stencil.empty() && backend != "gl") {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("--gl-stencil {} needs --backend gl, not {}.", request.gl_stencil,
                                backend));
    }
#if GNOMON_HAS_GL
    if (backend == "gl") return create_gl(request);
#endif
#if GNOMON_HAS_VK
    if (backend == "vk") return create_vk(request);
#endif
    if (backend == "null") return gpu::Device(gpu::create_null_backend());
    return fail(ErrorCode::InvalidInput,
                fmt::format("--backend: \"{}\" is not in this build; there are {}.", backend,
                            fmt::join(backend_names(), ", ")));
}

}  // namespace

Result<gpu::Device> create_device(const DeviceRequest& request) {
    if (!request.backend.empty()) return create_named(request.backend, request);
    const auto names = backend_names();
    // Whoever asks for one of OpenGL's paths asks for OpenGL.
    if (!request.gl_stencil.empty()) return create_named(names.front(), request);
    // The null backend, which is last, draws nothing: it is no stand-in for one that does.
    std::string reasons;
    for (const std::string& name : names) {
        if (name == "null" && names.size() > 1) break;
        auto device = create_named(name, request);
        if (device) return device;
        reasons += fmt::format(" {}: {}", name, device.error().message);
    }
    return fail(ErrorCode::Unsupported, "No backend works here." + reasons);
}

}  // namespace gnomon::cli
