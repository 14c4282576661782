// SPDX-License-Identifier: MIT
//
// gnomon::webgpu: the GPU interface on the browser's own WebGPU, for programs compiled by
// Emscripten. This half writes descriptors and command lists down as plain data; bridge.js, which
// the page runs, makes WebGPU's calls of them. The page makes the device too, since that takes
// turns of its event loop, and puts the bridge into Module.gnomonBridge before anything here is
// called. A device and textures of a host's are adopted the same way.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/backend.hpp>
#include <gnomon/gpu/message_sink.hpp>

namespace gnomon::webgpu {

/// What a backend is made with.
struct BackendOptions {
    /// What the device complains of arrives later than the call that caused it: with the next
    /// submit(), wait_idle() or reading.
    gpu::MessageSink message_sink = {};
    /// Treated as absent, for tests of fallbacks: "depth-clip-control", "timestamp-query",
    /// "multisample", "sampled-stencil".
    std::vector<std::string> disabled_features = {};
};

/// On the bridge of this module. Fails with ErrorCode::Unsupported, naming what is missing, or with
/// ErrorCode::InvalidInput when a disabled feature is none of those above. wait_idle() and what
/// reads back wait for the device, which only calls can that the page makes through
/// Bridge.waiting(); others get ErrorCode::Unsupported.
[[nodiscard]] Result<std::unique_ptr<gpu::Backend>> create_backend(
    const BackendOptions& options = {});

/// What Device::import_texture() takes: a GPUTexture that the page has given to Bridge.adopt() of
/// bridge.js, which answers this number. The TextureDesc says its format, size, samples and levels,
/// which are checked, and usages that it has, of which RenderAttachment and TextureBinding matter.
/// destroy() leaves it alone; it may be forgotten by Bridge.release() once it is imported.
struct HostTexture {
    std::uint32_t number = 0;  ///< as Bridge.adopt() answered
};

}  // namespace gnomon::webgpu
