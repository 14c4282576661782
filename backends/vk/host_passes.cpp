// SPDX-License-Identifier: MIT
#include "internal/host_passes.hpp"

#include <algorithm>

namespace gnomon::vk {

HostPassKind HostPasses::add(const HostRenderPass& pass, gpu::Format depth_stencil,
                             std::uint32_t samples) {
    const auto same = [&](const HostPass& known) {
        return known.depth_stencil == depth_stencil && known.samples == samples &&
               known.pass.render_pass == pass.render_pass && known.pass.subpass == pass.subpass &&
               known.pass.color_formats == pass.color_formats;
    };
    auto found = std::find_if(passes_.begin(), passes_.end(), same);
    if (found == passes_.end()) {
        found = passes_.insert(found, {++last_, pass, depth_stencil, samples});
    }
    ++found->imports;
    return found->kind;
}

void HostPasses::remove(HostPassKind kind) {
    std::erase_if(passes_,
                  [&](HostPass& known) { return known.kind == kind && --known.imports == 0; });
}

std::vector<HostPass> HostPasses::of(gpu::Format depth_stencil, std::uint32_t samples) const {
    std::vector<HostPass> result;
    for (const HostPass& known : passes_) {
        if (known.depth_stencil == depth_stencil && known.samples == samples) {
            result.push_back(known);
        }
    }
    return result;
}

}  // namespace gnomon::vk
