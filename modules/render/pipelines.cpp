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

    void layout(const char* label, std::vector<gpu::BindGroupLayoutEntry> entries,
                gpu::BindGroupLayout& out) {
        keep(device_->create_bind_group_layout({.label = label, .entries = std::move(entries)}),
             out);
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

// What a geometry pipeline draws with, whichever triangles it leaves out.
void make_each(Maker& make, gpu::Device& device, const RendererDesc& desc,
               gpu::RenderPipelineDesc pipeline, GeometryPipelines& out) {
    for (const Culling kind : {Culling::None, Culling::Back, Culling::BackMirrored}) {
        if ((kind == Culling::None) == desc.cull_back_faces) continue;
        const auto place = static_cast<std::size_t>(kind);
        pipeline.primitive = culling(kind);
        make.pipeline(pipeline, out.clipped[place]);
        if (!device.caps().features.unclipped_depth) continue;
        pipeline.primitive.unclipped_depth = true;
        make.pipeline(pipeline, out.unclipped[place]);
    }
}

void make_geometry(Maker& make, gpu::Device& device, const RendererDesc& desc,
                   gpu::BindGroupLayoutId material_layout, Pipelines& p) {
    using gpu::ShaderStage;
    const bool multisampled = desc.sample_count > 1;
    gpu::Shader geometry;
    gpu::Shader positions;
    gpu::Shader depth;
    gpu::Shader forward;
    gpu::Shader fragment_depth;
    make.shader("geometry", ShaderStage::Vertex, shaders::geometry_vert, geometry);
    make.shader("positions", ShaderStage::Vertex, shaders::positions_vert, positions);
    make.shader("depth", ShaderStage::Fragment,
                multisampled ? shaders::depth_multisampled_frag : shaders::depth_frag, depth);
    make.shader("forward", ShaderStage::Fragment,
                multisampled ? shaders::forward_multisampled_frag : shaders::forward_frag, forward);
    if (multisampled) {
        make.shader("fragment depth", ShaderStage::Fragment, shaders::fragment_depth_frag,
                    fragment_depth);
    }

    const gpu::VertexBufferLayout position_layout{.array_stride = 12,
                                                  .attributes = {{.shader_location = 0}}};
    gpu::RenderPipelineDesc d;
    d.sample_count = desc.sample_count;
    d.label = "depth of what is opaque";
    d.bind_group_layouts = {p.draw_layout};
    d.vertex = positions;
    d.vertex_buffers = {position_layout};
    d.depth_stencil = make.depth(Compare::Greater, true);
    if (multisampled) {
        d.fragment = fragment_depth;
        d.targets = {{.format = fragment_depth_format}};
    }
    make_each(make, device, desc, d, p.depth_of_opaque);

    d.label = "depth";
    d.bind_group_layouts = {p.draw_layout, p.round_layout, material_layout};
    d.vertex = geometry;
    d.vertex_buffers = {
        position_layout,
        {.array_stride = 20,
         .attributes = {
             {.shader_location = 1},
             {.format = gpu::VertexFormat::Float32x2, .offset = 12, .shader_location = 2}}}};
    d.fragment = depth;
    make_each(make, device, desc, d, p.depth);

    d.bind_group_layouts = {p.draw_layout, p.round_layout, material_layout, p.mask_layout};
    d.depth_stencil = make.depth(Compare::Equal);
    d.label = "forward";
    d.fragment = forward;
    d.targets = {{.format = radiance_format}};
    make_each(make, device, desc, d, p.forward[0]);
    d.label = "forward, later rounds";
    d.targets[0].blend = add_blend;
    make_each(make, device, desc, d, p.forward[1]);
}

void make_masks(Maker& make, const RendererDesc& desc, Pipelines& p) {
    using gpu::ShaderStage;
    gpu::Shader full_screen;
    gpu::Shader bit;
    make.shader("full screen", ShaderStage::Vertex, shaders::full_screen_vert, full_screen);
    make.shader("light mask", ShaderStage::Fragment, shaders::light_mask_frag, bit);
    gpu::RenderPipelineDesc d;
    d.sample_count = desc.sample_count;
    d.vertex = full_screen;
    d.fragment = bit;
    const gpu::BlendComponent add_constant{.src_factor = BlendFactor::Constant,
                                           .dst_factor = BlendFactor::One};
    d.targets = {{.format = mask_format,
                  .blend = gpu::BlendState{.color = add_constant, .alpha = add_constant}}};
    gpu::StencilFaceState face{.compare = Compare::NotEqual};
    const auto stencil = [&](gpu::StencilOp op) {
        face.pass_op = op;
        d.depth_stencil = make.depth(Compare::Always);
        d.depth_stencil->stencil_front = face;
        d.depth_stencil->stencil_back = face;
    };
    d.label = "light mask";
    stencil(gpu::StencilOp::Zero);
    make.pipeline(d, p.mask);
    d.label = "light mask, the count kept";
    stencil(gpu::StencilOp::Keep);
    make.pipeline(d, p.mask_kept);
}

void make_overlays(Maker& make, const RendererDesc& desc, const shadow_pass::ShadowPass& shadows,
                   Pipelines& p) {
    using gpu::ShaderStage;
    gpu::Shader positions;
    gpu::Shader color;
    gpu::Shader full_screen;
    make.shader("positions", ShaderStage::Vertex, shaders::positions_vert, positions);
    make.shader("overlay", ShaderStage::Fragment, shaders::overlay_frag, color);
    make.shader("full screen", ShaderStage::Vertex, shaders::full_screen_vert, full_screen);
    gpu::RenderPipelineDesc d;
    d.sample_count = desc.sample_count;
    d.fragment = color;
    d.targets = {{.format = radiance_format, .blend = over_blend}};
    d.label = "wireframe";
    d.vertex = positions;
    d.vertex_buffers = {{.array_stride = 12, .attributes = {{.shader_location = 0}}}};
    d.primitive = {.topology = gpu::PrimitiveTopology::LineList};
    d.bind_group_layouts = {p.draw_layout, p.overlay_layout};
    d.depth_stencil = make.depth(Compare::GreaterEqual);
    make.pipeline(d, p.wireframe);

    d.vertex = shadows.vertex_shader();
    d.vertex_buffers = shadows.vertex_layouts();
    d.bind_group_layouts = {p.empty_layout, p.overlay_layout};
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
}

}  // namespace

Result<Pipelines> create_pipelines(gpu::Device& device, const RendererDesc& desc,
                                   gpu::BindGroupLayoutId material_layout,
                                   const shadow_pass::ShadowPass& shadows) {
    using gpu::ShaderStage;
    Pipelines p;
    Maker make(device, desc);
    const bool multisampled = desc.sample_count > 1;
    make.layout("draw",
                {{.binding = 1, .visibility = ShaderStage::Vertex, .has_dynamic_offset = true}},
                p.draw_layout);
    make.layout("round",
                {{.binding = 0, .visibility = ShaderStage::Fragment, .has_dynamic_offset = true}},
                p.round_layout);
    make.layout("empty", {}, p.empty_layout);
    make.layout("overlay",
                {{.binding = 4, .visibility = ShaderStage::Fragment, .has_dynamic_offset = true}},
                p.overlay_layout);
    gpu::BindGroupLayoutEntry mask{.binding = 5,
                                   .visibility = ShaderStage::Fragment,
                                   .type = gpu::BindingType::SampledTexture,
                                   .multisampled = multisampled};
    std::vector<gpu::BindGroupLayoutEntry> masks{mask};
    if (multisampled) {
        mask.binding = 6;
        masks.push_back(mask);
    }
    make.layout("light mask", masks, p.mask_layout);
    make.layout("tone map",
                {{.binding = 0,
                  .visibility = ShaderStage::Fragment,
                  .type = gpu::BindingType::SampledTexture}},
                p.tone_map_layout);
    make_geometry(make, device, desc, material_layout, p);
    make_masks(make, desc, p);
    make_overlays(make, desc, shadows, p);

    gpu::Shader full_screen;
    gpu::Shader tone_map;
    make.shader("full screen", ShaderStage::Vertex, shaders::full_screen_vert, full_screen);
    make.shader("tone map", ShaderStage::Fragment, shaders::tone_map_frag, tone_map);
    make.pipeline({.label = "tone map",
                   .bind_group_layouts = {p.tone_map_layout},
                   .vertex = full_screen,
                   .fragment = tone_map,
                   .targets = {{.format = picture_format}}},
                  p.tone_map);
    if (!make.status()) return forward_error(make.status());
    return p;
}

}  // namespace gnomon::render::internal
