// SPDX-License-Identifier: MIT
//
// LightMasks: shadows of many lights at once, in textures that the host samples where it shades:
// for deferred and forward+ renderers, which shade each pixel once and cannot stop at a stencil
// test for every light. Volumes are counted in the host's stencil one light after the other, and
// after each the count becomes that light's part of the mask. GuestPass is for hosts that add light
// by light.
//
//     auto masks = LightMasks::create(device, {.host = {.target = *depth, …}, .masks = {*mask}});
//     every frame, after the host's depth:
//         auto view = shadows::view_of_host(view_matrix, projection, conventions);
//         masks->prepare(std::move(frame).finish(view->view), *view);
//         masks->resolve();
//         …the host shades: uint bits = texelFetch(mask, ivec2(gl_FragCoord.xy), 0).r;
//           light l arrives where (bits >> l & 1u) == 0u
//
// As everywhere in gnomon 0 is light. Texel (x, y) is pixel (x, y) of the host's depth, whichever
// way is up.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadow_pass/guest_pass.hpp>
#include <gnomon/shadows/host_view.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadow_pass {

/// What volumes are counted against, and where the masks go.
struct LightMasksDesc {
    /// Where volumes are counted: depth, which is read, and a stencil, which is 0 afterwards. On
    /// OpenGL a texture, a renderbuffer or a framebuffer object that has one, not the window's; on
    /// Vulkan an image (vk::HostImage), not a render pass.
    GuestPassDesc host = {};
    /// Of the size of the host's depth, with TextureUsage::RenderAttachment, imported or the
    /// device's own. Either one texture of R32Uint, in which bit l is set where light l does not
    /// arrive, with as many samples as the depth: each sample has bits of its own. Or up to 32 of
    /// R8Unorm, one a light in the order of the list: with as many samples as the depth, 1 where
    /// the light does not arrive at the sample, else 0; with one sample and depth of four, the
    /// share of a pixel's samples that it does not arrive at, to be taken from 1 (as the device
    /// resolves: 128 of 255 may be 127). Bits of one sample beside depth of four there are none.
    std::vector<gpu::TextureId> masks = {};
};

/// Puts the shadows of many lights into textures that the host samples. One thread at a time.
class LightMasks {
public:
    /// In one resolve().
    static constexpr std::size_t max_lights = 32;

    /// The device must outlive it. Fails as GuestPass::create() does, with
    /// ErrorCode::InvalidInput for masks that are not as LightMasksDesc::masks says, and with
    /// Unsupported where no colours can be drawn beside the host's depth (LightMasksDesc::host), or
    /// for bits of four samples without Features::sample_shading (there are none at all without
    /// Features::multisample_32bit). Makes a texture of its own: four
    /// bytes a sample for bits, one a sample for shares.
    [[nodiscard]] static Result<LightMasks> create(gpu::Device& device, const LightMasksDesc& desc);
    LightMasks(LightMasks&&) noexcept;
    LightMasks& operator=(LightMasks&&) noexcept;
    ~LightMasks();

    /// As GuestPass::prepare(), once a frame.
    [[nodiscard]] Status prepare(const shadows::DrawList& list, const shadows::HostView& view);

    /// Counts all of the list's lights and writes the masks: light l of the list, whose lights are
    /// sorted by key, is bit l or texture l; masks of no light are 0. One submission of two render
    /// passes for bits, of one a light for bytes. ErrorCode::InvalidInput where there are more
    /// lights than max_lights, or than textures.
    [[nodiscard]] Status resolve();
    /// The same for lights first to first + count - 1 of the list, from bit or texture 0 on: for
    /// more lights than masks hold, in rounds. Both fail with ErrorCode::InvalidInput for lights
    /// beyond the list, and where prepare() has not succeeded.
    [[nodiscard]] Status resolve(std::size_t first, std::size_t count);

    /// Of the last prepare().
    [[nodiscard]] const PassStats& stats() const;

private:
    struct State;
    explicit LightMasks(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::shadow_pass
#pragma GCC visibility pop
