// SPDX-License-Identifier: MIT
//
// The kinds of hosts' render passes that were imported. Pipelines are made for a kind, once,
// however many textures were imported for it.
#pragma once

#include <cstdint>
#include <vector>

#include <gnomon/gpu/types.hpp>
#include <gnomon/vk/host_device.hpp>

namespace gnomon::vk {

/// Names a kind; 0 names none. Never given twice, as handles of render passes are.
using HostPassKind = std::uint32_t;

struct HostPass {
    HostPassKind kind = 0;
    HostRenderPass pass;
    gpu::Format depth_stencil = gpu::Format::Undefined;
    std::uint32_t samples = 1;
    std::size_t imports = 0;  ///< textures that are alive
};

class HostPasses {
public:
    /// For a texture that is imported; remove() is called for each once.
    HostPassKind add(const HostRenderPass& pass, gpu::Format depth_stencil, std::uint32_t samples);
    void remove(HostPassKind kind);
    /// Those that a pipeline may come to be used in.
    [[nodiscard]] std::vector<HostPass> of(gpu::Format depth_stencil, std::uint32_t samples) const;

private:
    std::vector<HostPass> passes_;
    HostPassKind last_ = 0;
};

}  // namespace gnomon::vk
