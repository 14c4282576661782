// SPDX-License-Identifier: MIT
//
// GuestPass: shadow volumes counted in the stencil of somebody else's renderer. The host draws its
// scene as ever; the guest clears the stencil, reads the host's depth, and where it has left a 0
// the light arrives. It is a ShadowPass with what a host would have to get right around it.
//
//     auto target = device.import_texture(desc, gl::HostTarget{.name = framebuffer});
//     auto guest = GuestPass::create(device, {.target = *target, …});
//     every frame, after the host's depth:
//         auto view = shadows::view_of_host(view_matrix, projection, conventions);
//         guest->prepare(std::move(frame).finish(view->view), *view);
//         for (std::size_t light = 0; light < lights; ++light) {
//             guest->count(light);
//             …the host adds this light, stencil func Equal to 0
//         }
//
// The host's viewport is the whole of its target, its depth range 0 .. 1.
#pragma once

#include <memory>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>
#include <gnomon/shadows/host_view.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadow_pass {

/// What the guest draws into, and by whose conventions.
struct GuestPassDesc {
    gpu::TextureId target = {};  ///< the host's depth-stencil, by Device::import_texture()
    TargetSize size = {};        ///< of the target, as it was imported
    gpu::Format format = gpu::Format::Depth24UnormStencil8;  ///< of the target
    std::uint32_t sample_count = 1;                          ///< of the target, 1 or 4
    shadows::HostConventions conventions = {};               ///< depth as the target is drawn to
    /// For depth that came from shaders of the host's own. None only where they compute positions
    /// by gnomon's function, from a matrix multiplied as it is here (docs/conventions.md, "One
    /// position function").
    CapBias cap_bias = usual_cap_bias;
};

/// Counts shadow volumes in a host's stencil.
class GuestPass {
public:
    /// The device must outlive the pass. Fails as ShadowPass::create() does, with
    /// ErrorCode::InvalidInput where there is no target, where its size, format or samples are not
    /// those that it was imported with, or HostConventions::depth is not Device::clip_depth_of() it
    /// (on OpenGL what glClipControl() said then, on Vulkan always from 0 to 1), and with
    /// Unsupported for logarithmic depth.
    [[nodiscard]] static Result<GuestPass> create(gpu::Device& device, const GuestPassDesc& desc);
    GuestPass(GuestPass&&) noexcept;
    GuestPass& operator=(GuestPass&&) noexcept;
    ~GuestPass();

    /// As ShadowPass::prepare(), once a frame: `list` is what a system made of view.view. Fails
    /// with ErrorCode::InvalidInput where the view's conventions are not the pass's, and with
    /// Unsupported where a caster can be drawn neither by depth-pass nor with caps.
    [[nodiscard]] Status prepare(const shadows::DrawList& list, const shadows::HostView& view);

    /// Clears the target's stencil to 0, counts the volumes of list.lights[light] in it and submits
    /// that; into a render pass of a Vulkan host's (vk::HostRenderPass) it is recorded, within
    /// that. Depth is read and left alone, and so are colours. ErrorCode::InvalidInput for a light
    /// beyond the list, and where prepare() has not succeeded.
    [[nodiscard]] Status count(std::size_t light);

    /// Of the last prepare().
    [[nodiscard]] const PassStats& stats() const;

private:
    struct State;
    explicit GuestPass(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::shadow_pass
#pragma GCC visibility pop
