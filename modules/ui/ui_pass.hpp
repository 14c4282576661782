// SPDX-License-Identifier: MIT
//
// UiPass: what Dear ImGui wants drawn, turned into commands of the GPU interface, so that a panel
// looks the same to the bit on every backend and a program needs no other road to its device. The
// host makes the widgets (context.hpp, or a Dear ImGui context of its own); this draws them.
#pragma once

#include <cstdint>
#include <memory>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>

struct ImDrawData;
struct ImFontAtlas;

namespace gnomon::ui {

struct UiPassDesc {
    /// What is drawn to holds bytes as the screen shows them: Rgba8Unorm, already sRGB-encoded, as
    /// render::Renderer::picture() is. Blending is done with those bytes, as Dear ImGui expects.
    gpu::Format target_format = gpu::Format::Rgba8Unorm;
};

class UiPass {
public:
    /// Uploads the atlas, building it where nobody has; fonts added to it later are not drawn. The
    /// device must outlive the pass, the atlas need not.
    [[nodiscard]] static Result<UiPass> create(gpu::Device& device, ImFontAtlas& atlas,
                                               const UiPassDesc& desc = {});
    UiPass(UiPass&&) noexcept;
    UiPass& operator=(UiPass&&) noexcept;
    ~UiPass();

    /// Uploads this frame's vertices and indices, one buffer each, which grow as they must. Call it
    /// once a frame, before record(), which draws nothing where it failed.
    [[nodiscard]] Status prepare(const ImDrawData& draw_data);
    /// Into a pass with one colour target of UiPassDesc::target_format and this size, no depth, one
    /// sample. Leaves pipeline, bind group 0, vertex and index buffer and scissor changed. Blending
    /// is premultiplied: target * (1 - alpha) + colour * alpha, alpha likewise. Callbacks among the
    /// draw commands and images that are not the atlas's are left out.
    void record(gpu::RenderPassEncoder& pass, std::uint32_t width, std::uint32_t height) const;

    /// Both, over what `target` holds, in a pass of its own, submitted.
    [[nodiscard]] Status draw(const ImDrawData& draw_data, gpu::TextureId target,
                              std::uint32_t width, std::uint32_t height);

private:
    struct State;
    explicit UiPass(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::ui
