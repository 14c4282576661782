// SPDX-License-Identifier: MIT
//
// Sets the stencil to 0 where no surface is: depth is what it was cleared to. Volumes that end
// behind the last receiver (shadows::LightDraws::clear_background) leave counts there that mean
// nothing.
#pragma once

#include <cstdint>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>

namespace gnomon::shadow_pass::internal {

class BackgroundClear {
public:
    [[nodiscard]] static Result<BackgroundClear> create(gpu::Device& device,
                                                        const ShadowPassDesc& desc);

    /// One draw, within the scissor; changes the pipeline.
    void record(gpu::RenderPassEncoder& encoder) const;

private:
    gpu::RenderPipeline pipeline_;
    std::uint32_t first_vertex_ = 0;
};

}  // namespace gnomon::shadow_pass::internal
