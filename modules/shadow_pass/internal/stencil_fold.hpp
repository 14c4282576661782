// SPDX-License-Identifier: MIT
//
// Counting in batches, in place: batches count in the low seven bits of the stencil; after each, a
// fold sets the eighth bit where the count is not zero and clears the count. The last step makes
// the whole byte 0 or 255. Nothing but stencil tests: it works inside any render pass, sample by
// sample, reads no texture and needs no target.
#pragma once

#include <cstdint>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>

namespace gnomon::shadow_pass::internal {

class StencilFold {
public:
    /// What a batch may write, and the most layers that it can count.
    static constexpr std::uint32_t count_mask = 0x7F;

    [[nodiscard]] static Result<StencilFold> create(gpu::Device& device,
                                                    const ShadowPassDesc& desc);

    /// After each batch. One draw; changes pipeline and stencil reference.
    void fold(gpu::RenderPassEncoder& encoder) const;
    /// After the last fold. One draw.
    void finish(gpu::RenderPassEncoder& encoder) const;

private:
    gpu::RenderPipeline fold_;
    gpu::RenderPipeline finish_;
};

}  // namespace gnomon::shadow_pass::internal
