// SPDX-License-Identifier: MIT
#include <array>
#include <cstring>

#include "internal/renderer_state.hpp"

namespace gnomon::render {

namespace {

// Overlay colours, in the order of their places in the uniform buffer. From `first_count` on:
// counts 1, 2, 3, …, and fill of 1, 2 and 3, 4 to 7, ….
enum OverlayColor : std::uint32_t { Volumes, Silhouettes, Caps, Wireframe, first_count };
constexpr std::array<glm::vec4, 12> overlay_colors{{{1.1F, 0.85F, 0.05F, 0.16F},
                                                    {2.2F, 0.12F, 0.9F, 1.0F},
                                                    {0.05F, 0.9F, 0.8F, 0.55F},
                                                    {0.02F, 0.02F, 0.03F, 0.8F},
                                                    {0.05F, 0.15F, 0.75F, 0.75F},
                                                    {0.0F, 0.55F, 0.75F, 0.75F},
                                                    {0.0F, 0.6F, 0.2F, 0.75F},
                                                    {0.55F, 0.75F, 0.0F, 0.75F},
                                                    {0.95F, 0.65F, 0.0F, 0.75F},
                                                    {1.0F, 0.3F, 0.0F, 0.75F},
                                                    {1.0F, 0.05F, 0.02F, 0.8F},
                                                    {1.6F, 0.9F, 1.6F, 0.85F}}};

}  // namespace

Status Renderer::State::create_overlays() {
    std::vector<std::byte> colors(overlay_colors.size() * internal::uniform_alignment);
    for (std::size_t i = 0; i < overlay_colors.size(); ++i) {
        std::memcpy(colors.data() + i * internal::uniform_alignment, &overlay_colors[i],
                    sizeof(glm::vec4));
    }
    return write(overlay, "overlay colours", pipelines.overlay_layout, 4, sizeof(glm::vec4),
                 colors);
}

// What the stencil counts was drawn with the mask, of whose format volumes' pipelines are.
void Renderer::State::record_counts() {
    for (std::size_t light = 0; light < light_count; ++light) {
        {
            auto pass = encoder.begin_render_pass(
                mask_pass("count", gpu::LoadOp::Load, gpu::LoadOp::Clear));
            shadows->record(pass, light);
        }
        auto pass = encoder.begin_render_pass(picture_pass("count overlay", gpu::LoadOp::Load));
        pass.set_pipeline(pipelines.count);
        pass.set_bind_group(0, draws.group, std::array<std::uint32_t, 1>{0});
        for (std::uint32_t count = 1; first_count + count <= overlay_colors.size(); ++count) {
            const std::uint32_t offset = (first_count + count - 1) * internal::uniform_alignment;
            pass.set_bind_group(1, overlay.group, std::span(&offset, 1));
            pass.set_stencil_reference(count);
            pass.draw(3);
        }
    }
}

void Renderer::State::record_fill() {
    {
        auto pass =
            encoder.begin_render_pass(mask_pass("fill", gpu::LoadOp::Load, gpu::LoadOp::Clear));
        for (const internal::FrameLight& light : lights) {
            if (light.draws) {
                shadows->record_fill(pass, *light.draws, shadow_pass::Fill::PerPixel);
            }
        }
    }
    auto pass = encoder.begin_render_pass(picture_pass("fill overlay", gpu::LoadOp::Load));
    for (std::uint32_t band = 0; band < internal::fill_bands; ++band) {
        const std::uint32_t offset = (first_count + band) * internal::uniform_alignment;
        pass.set_pipeline(pipelines.fill[band]);
        pass.set_bind_group(0, draws.group, std::array<std::uint32_t, 1>{0});
        pass.set_bind_group(1, overlay.group, std::span(&offset, 1));
        pass.set_stencil_reference(1U << band);
        pass.draw(3);
    }
}

Status Renderer::State::record_overlays() {
    const Overlays& show = desc.overlays;
    if (!show.any()) return {};
    if (show.count && !instances.empty()) record_counts();
    if (show.fill && !instances.empty()) record_fill();
    if (show.wireframe) {
        for (const internal::Instance& instance : instances) {
            if (const Status made = gpu_scene.ensure_lines(*instance.mesh); !made) return made;
        }
    }
    auto pass = encoder.begin_render_pass(picture_pass("overlays", gpu::LoadOp::Load));
    const auto color = [&](OverlayColor which) {
        const std::uint32_t offset = which * internal::uniform_alignment;
        pass.set_bind_group(1, overlay.group, std::span(&offset, 1));
    };
    if (show.wireframe) {
        pass.set_pipeline(pipelines.wireframe);
        color(Wireframe);
        for (const internal::Instance& instance : instances) {
            draw_instance(pass, instance);
            pass.set_index_buffer(instance.mesh->line_indices, gpu::IndexFormat::Uint32);
            pass.draw_indexed(static_cast<std::uint32_t>(instance.mesh->mesh->indices.size() * 2));
        }
    }
    for (std::size_t light = 0; light < light_count; ++light) {
        using shadow_pass::Part;
        if (show.caps) {
            color(Caps);
            shadows->record_part(pass, light, Part::Caps, pipelines.volume_triangles);
        }
        if (show.volumes) {
            color(Volumes);
            shadows->record_part(pass, light, Part::Sides, pipelines.volume_triangles);
        }
        if (show.silhouettes) {
            color(Silhouettes);
            shadows->record_part(pass, light, Part::Silhouettes, pipelines.volume_lines);
        }
    }
    return {};
}

}  // namespace gnomon::render
