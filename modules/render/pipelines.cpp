// SPDX-License-Identifier: MIT
#include "internal/pipelines.hpp"

#include <gnomon_shaders/render.hpp>

#include "internal/targets.hpp"

namespace gnomon::render::internal {

namespace {

using gpu::BlendFactor;
using gpu::Compare;

constexpr gpu::BlendState add_blend{.color = {.dst_factor = BlendFactor::One},
                                    .alpha = {.dst_factor = BlendFactor::One}};
constexpr gpu::BlendState over_blend{
    .color = {.src_factor = BlendFactor::SrcAlpha, .dst_factor = BlendFactor::OneMinusSrcAlpha},
    .alpha = {.src_factor = BlendFactor::Zero, .dst_factor = BlendFactor::One}};

class Maker {
public:
    Maker(gpu::Device& device, const RendererDesc& desc) : device_(&device), desc_(desc) {}

    void layout(const char* label, gpu::BindGroupLayoutEntry entry, gpu::BindGroupLayout& out) {
        keep(device_->create_bind_group_layout({.label = label, .entries = {entry}}), out);
    }
    void shader(const char* label, gpu::ShaderStage stage, const gpu::ShaderSource& source,
                gpu::Shader& out) {
        keep(device_->create_shader({.label = label, .stage = stage, .source = source}), out);
    }
    void pipeline(gpu::RenderPipelineDesc desc, gpu::RenderPipeline& out) {
        keep(device_->create_render_pipeline(desc), out);
    }
    [[nodiscard]] gpu::DepthStencilState depth(Compare compare, bool write = false) const {
        return {.format = desc_.depth_stencil_format,
                .depth_write_enabled = write,
                .depth_compare = compare};
    }
    [[nodiscard]] const Status& status() const { return status_; }

private:
    template <class T>
    void keep(Result<T> made, T& out) {
        if (!status_) return;
        if (made) {
            out = std::move(*made);
        } else {
            status_ = forward_error(made);
        }
    }

    gpu::Device* device_;
    RendererDesc desc_;
    Status status_;
};

gpu::PrimitiveState culling(Culling kind) {
    return {.front_face = kind == Culling::BackMirrored ? gpu::FrontFace::Cw : gpu::FrontFace::Ccw,
            .cull_mode = kind == Culling::None ? gpu::CullMode::None : gpu::CullMode::Back};
}

}  // namespace

Result<Pipelines> create_pipelines(gpu::Device& device, const RendererDesc& desc,
                                   gpu::BindGroupLayoutId material_layout,
                                   const shadow_pass::ShadowPass& shadows) {
    using gpu::ShaderStage;
    Pipelines p;
    Maker make(device, desc);
    make.layout("draw",
                {.binding = 1, .visibility = ShaderStage::Vertex, .has_dynamic_offset = true},
                p.draw_layout);
    make.layout("frame",
                {.binding = 0, .visibility = ShaderStage::Fragment, .has_dynamic_offset = true},
                p.frame_layout);
    make.layout("overlay",
                {.binding = 4, .visibility = ShaderStage::Fragment, .has_dynamic_offset = true},
                p.overlay_layout);
    make.layout("tone map",
                {.binding = 0,
                 .visibility = ShaderStage::Fragment,
                 .type = gpu::BindingType::SampledTexture},
                p.tone_map_layout);

    gpu::Shader geometry;
    gpu::Shader wireframe;
    gpu::Shader ambient;
    gpu::Shader light;
    gpu::Shader overlay;
    gpu::Shader full_screen;
    gpu::Shader tone_map;
    make.shader("geometry", ShaderStage::Vertex, shaders::geometry_vert, geometry);
    make.shader("wireframe", ShaderStage::Vertex, shaders::wireframe_vert, wireframe);
    make.shader("ambient", ShaderStage::Fragment, shaders::ambient_frag, ambient);
    make.shader("light", ShaderStage::Fragment, shaders::light_frag, light);
    make.shader("overlay", ShaderStage::Fragment, shaders::overlay_frag, overlay);
    make.shader("full screen", ShaderStage::Vertex, shaders::full_screen_vert, full_screen);
    make.shader("tone map", ShaderStage::Fragment, shaders::tone_map_frag, tone_map);
    if (!make.status()) return forward_error(make.status());

    gpu::RenderPipelineDesc d;
    d.sample_count = desc.sample_count;
    d.vertex = geometry;
    d.vertex_buffers = {
        {.array_stride = 12, .attributes = {{.shader_location = 0}}},
        {.array_stride = 20,
         .attributes = {
             {.shader_location = 1},
             {.format = gpu::VertexFormat::Float32x2, .offset = 12, .shader_location = 2}}}};
    d.bind_group_layouts = {p.draw_layout, p.frame_layout, material_layout};
    for (std::size_t i = 0; i < 6; ++i) {
        const auto kind = static_cast<Culling>(i % 3);
        const bool unclipped = i >= 3;
        if (unclipped && !device.caps().features.unclipped_depth) continue;
        const auto place = [&](GeometryPipelines& pipelines) -> gpu::RenderPipeline& {
            return (unclipped ? pipelines.unclipped : pipelines.clipped)[i % 3];
        };
        d.primitive = culling(kind);
        d.primitive.unclipped_depth = unclipped;

        d.label = "ambient";
        d.fragment = ambient;
        d.depth_stencil = make.depth(Compare::Greater, true);
        d.targets = {{.format = radiance_format}};
        make.pipeline(d, place(p.ambient));

        d.label = "light";
        d.fragment = light;
        d.depth_stencil = make.depth(Compare::Equal);
        d.depth_stencil->stencil_front.compare =
            Compare::Equal;  // lit where no volume covers the surface
        d.depth_stencil->stencil_back.compare = Compare::Equal;
        d.targets = {{.format = radiance_format, .blend = add_blend}};
        make.pipeline(d, place(p.light));
    }

    d.fragment = overlay;
    d.targets = {{.format = radiance_format, .blend = over_blend}};
    d.label = "wireframe";
    d.vertex = wireframe;
    d.vertex_buffers = {{.array_stride = 12, .attributes = {{.shader_location = 0}}}};
    d.primitive = {.topology = gpu::PrimitiveTopology::LineList};
    d.bind_group_layouts = {p.draw_layout, p.overlay_layout};
    d.depth_stencil = make.depth(Compare::GreaterEqual);
    make.pipeline(d, p.wireframe);

    d.vertex = shadows.vertex_shader();
    d.vertex_buffers = {shadows.vertex_layout()};
    d.bind_group_layouts = {shadows.bind_group_layout(), p.overlay_layout};
    d.label = "silhouette overlay";
    make.pipeline(d, p.volume_lines);
    d.label = "volume overlay";
    d.primitive = {};
    make.pipeline(d, p.volume_triangles);

    d.label = "count overlay";
    d.vertex = full_screen;
    d.vertex_buffers = {};
    d.bind_group_layouts = {p.draw_layout, p.overlay_layout};
    d.depth_stencil = make.depth(Compare::Always);
    d.depth_stencil->stencil_front.compare = Compare::Equal;
    d.depth_stencil->stencil_back.compare = Compare::Equal;
    make.pipeline(d, p.count);
    d.label = "fill overlay";
    for (std::uint32_t band = 0; band < fill_bands && desc.overlays.fill; ++band) {
        d.depth_stencil->stencil_read_mask = 0xFFU << band & 0xFFU;
        make.pipeline(d, p.fill[band]);
    }

    d.label = "tone map";
    d.fragment = tone_map;
    d.bind_group_layouts = {p.tone_map_layout};
    d.depth_stencil.reset();
    d.targets = {{.format = picture_format}};
    d.sample_count = 1;
    make.pipeline(d, p.tone_map);
    if (!make.status()) return forward_error(make.status());
    return p;
}

}  // namespace gnomon::render::internal
