// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <gnomon_shaders/report.hpp>

#include "internal/baselines.hpp"
#include "internal/light_projector.hpp"

namespace gnomon::report::internal {

namespace {

struct MapUniforms {  // std140, as in mapped.frag
    glm::vec4 size;
    glm::vec4 bias;
};
constexpr std::uint32_t uniform_stride = 256;

// Biases, tuned for the fewest wrong pixels of the built-in scenes at 1024 texels. Constant: in
// texels' widths, as Projector::texel has them. One that knows no slopes has to be as large as
// those that occur; beside the other there is only rounding to cover.
double constant_bias(MapFilter filter) { return filter == MapFilter::Plain ? 10.0 : 0.5; }
// Of the depth's slope in a texel: what is asked lies up to half a texel aside in both directions,
// and with 3x3 texels one more.
float slope_bias(MapFilter filter) {
    switch (filter) {
        case MapFilter::Plain: return 0.0F;
        case MapFilter::Sloped: return 2.5F;
        case MapFilter::Pcf: break;
    }
    return 3.0F;
}

class ShadowMap final : public DrawnTechnique {
public:
    ShadowMap(const Setup& setup, std::uint32_t size, MapFilter filter)
        : DrawnTechnique(setup.stage),
          scale_m_(setup.bounds.diagonal()),
          size_(size),
          filter_(filter) {}

    Status create();
    Result<FrameCost> frame(const Moment& moment, bool look) override;

private:
    struct CasterDraw {
        const StageInstance* instance = nullptr;
        std::uint32_t offset = 0;
    };
    struct OfLight {
        Projector projector;
        std::vector<std::vector<CasterDraw>> casters;  // by face
        std::vector<std::uint32_t> receivers;          // offsets by instance
        gpu::BindGroupId group = {};
        gpu::TextureId map = {};
    };
    Result<gpu::BindGroupId> map_group(gpu::TextureId map);
    Status write_uniforms();
    void project(const Moment& moment, std::span<const StageInstance> instances,
                 const glm::dmat4& clip_from_world);
    void record(gpu::CommandEncoder& encoder, gpu::TextureId depth,
                std::span<const StageInstance> instances, std::size_t light) const;

    double scale_m_;
    std::uint32_t size_;
    MapFilter filter_;
    gpu::Shader vertex_;
    gpu::Shader fragment_;
    gpu::BindGroupLayout layout_;
    gpu::Sampler sampler_;
    gpu::RenderPipeline map_pipeline_;
    gpu::RenderPipeline mask_pipeline_;
    gpu::Buffer uniforms_;
    std::uint64_t uniform_bytes_ = 0;
    std::vector<std::pair<gpu::TextureId, gpu::BindGroup>> groups_;
    DrawMatrices matrices_;
    std::vector<OfLight> lights_;
};

Status ShadowMap::create() {
    gpu::Device& device = stage_.device();
    auto vertex = device.create_shader(
        {.label = "mapped", .stage = gpu::ShaderStage::Vertex, .source = shaders::mapped_vert});
    if (!vertex) return forward_error(vertex);
    vertex_ = std::move(*vertex);
    auto fragment = device.create_shader(
        {.label = "mapped", .stage = gpu::ShaderStage::Fragment, .source = shaders::mapped_frag});
    if (!fragment) return forward_error(fragment);
    fragment_ = std::move(*fragment);
    auto layout =
        device.create_bind_group_layout({.label = "map",
                                         .entries = {{.binding = 0,
                                                      .visibility = gpu::ShaderStage::Fragment,
                                                      .has_dynamic_offset = true,
                                                      .min_binding_size = sizeof(MapUniforms)},
                                                     {.binding = 2,
                                                      .visibility = gpu::ShaderStage::Fragment,
                                                      .type = gpu::BindingType::SampledTexture,
                                                      .sample_type = gpu::SampleType::Depth}}});
    if (!layout) return forward_error(layout);
    layout_ = std::move(*layout);
    auto sampler = device.create_sampler({.label = "map"});
    if (!sampler) return forward_error(sampler);
    sampler_ = std::move(*sampler);
    auto map = device.create_render_pipeline(
        {.label = "shadow map",
         .bind_group_layouts = {stage_.draw_layout()},
         .vertex = stage_.positions(),
         .vertex_buffers = {Stage::position_layout()},
         .depth_stencil = gpu::DepthStencilState{.format = gpu::Format::Depth32Float,
                                                 .depth_write_enabled = true,
                                                 .depth_compare = gpu::Compare::Greater,
                                                 // Away from the light: depth is reversed.
                                                 .depth_bias_slope_scale = -slope_bias(filter_)}});
    if (!map) return forward_error(map);
    map_pipeline_ = std::move(*map);
    auto mask = device.create_render_pipeline(
        {.label = "mapped mask",
         .bind_group_layouts = {stage_.draw_layout(), layout_},
         .vertex = vertex_,
         .fragment = fragment_,
         .vertex_buffers = {Stage::position_layout()},
         .depth_stencil = gpu::DepthStencilState{.format = gpu::Format::Depth32FloatStencil8,
                                                 .depth_compare = gpu::Compare::Equal},
         .targets = {{.format = mask_format}}});
    if (!mask) return forward_error(mask);
    mask_pipeline_ = std::move(*mask);
    const std::uint32_t limit = device.caps().limits.max_texture_dimension_2d;
    if (size_ > limit) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("A map of {} texels is larger than this adapter's limit of {}.",
                                size_, limit));
    }
    return {};
}

Result<gpu::BindGroupId> ShadowMap::map_group(gpu::TextureId map) {
    for (const auto& [of, group] : groups_) {
        if (of == map) return group.id();
    }
    auto group = stage_.device().create_bind_group(
        {.label = "map",
         .layout = layout_,
         .entries = {{.binding = 0, .buffer = uniforms_, .size = sizeof(MapUniforms)},
                     {.binding = 2,
                      .texture = map,
                      .sampler = sampler_,
                      .aspect = gpu::Aspect::DepthOnly}}});
    if (!group) return forward_error(group);
    return groups_.emplace_back(map, std::move(*group)).second.id();
}

Status ShadowMap::write_uniforms() {
    std::vector<std::byte> bytes(lights_.size() * uniform_stride);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const Projector& p = lights_[i].projector;
        const auto bias = static_cast<float>(p.texel * constant_bias(filter_));
        const MapUniforms u{{static_cast<float>(size_), p.cube ? 1.0F : 0.0F,
                             static_cast<float>(p.near_m), filter_ == MapFilter::Pcf ? 1.0F : 0.0F},
                            p.cube || p.near_m > 0.0 ? glm::vec4(0.0F, bias, 0.0F, 0.0F)
                                                     : glm::vec4(bias, 0.0F, 0.0F, 0.0F)};
        std::memcpy(bytes.data() + i * uniform_stride, &u, sizeof u);
    }
    if (bytes.size() > uniform_bytes_) {
        groups_.clear();
        auto buffer = stage_.device().create_buffer(
            {.label = "map uniforms",
             .size = bytes.size(),
             .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
        if (!buffer) return forward_error(buffer);
        uniforms_ = std::move(*buffer);
        uniform_bytes_ = bytes.size();
    }
    if (bytes.empty()) return {};
    return stage_.device().write_buffer(uniforms_, 0, bytes);
}

void ShadowMap::record(gpu::CommandEncoder& encoder, gpu::TextureId depth,
                       std::span<const StageInstance> instances, std::size_t index) const {
    const OfLight& light = lights_[index];
    const bool lit = light.projector.clip_from_world.empty();  // all that is seen
    if (!lit) {
        auto pass = encoder.begin_render_pass(
            {.label = "shadow map",
             .depth_stencil = gpu::DepthStencilAttachment{.texture = light.map,
                                                          .depth_load_op = gpu::LoadOp::Clear}});
        pass.set_pipeline(map_pipeline_);
        const auto side = static_cast<float>(size_);
        for (std::size_t face = 0; face < light.casters.size(); ++face) {
            if (light.casters[face].empty()) continue;
            pass.set_viewport(static_cast<float>(face % 3) * side,
                              static_cast<float>(face / 3) * side, side, side);
            for (const CasterDraw& caster : light.casters[face]) {
                Stage::draw(pass, *caster.instance, matrices_.group(), caster.offset);
            }
        }
    }
    auto pass = encoder.begin_render_pass(
        {.label = "mapped mask",
         .color_attachments = {{.texture = stage_.mask(index), .load_op = gpu::LoadOp::Clear}},
         .depth_stencil = gpu::DepthStencilAttachment{.texture = depth}});
    if (lit) return;
    pass.set_pipeline(mask_pipeline_);
    const auto offset = static_cast<std::uint32_t>(index) * uniform_stride;
    pass.set_bind_group(1, light.group, std::span(&offset, 1));
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!instances[i].receives) continue;
        Stage::draw(pass, instances[i], matrices_.group(), light.receivers[i]);
    }
}

void ShadowMap::project(const Moment& moment, std::span<const StageInstance> instances,
                        const glm::dmat4& clip_from_world) {
    scene::Bounds casters;
    scene::Bounds receivers;
    std::vector<std::array<glm::dvec3, 8>> corners;
    for (const StageInstance& instance : instances) {
        corners.push_back(corners_of(instance.geometry->bounds, instance.world_from_local));
        for (const glm::dvec3& corner : corners.back()) {
            if (instance.casts) casters.include(corner);
            if (instance.receives) receivers.include(corner);
        }
    }
    const std::vector<glm::dvec3> seen = seen_part(receivers, moment.view);
    const glm::dvec3 forward = -glm::dvec3(glm::transpose(moment.view.view_from_world)[2]);
    lights_.clear();
    for (const shadows::Light& of : moment.lights) {
        OfLight& light = lights_.emplace_back();
        light.projector = fit_projector(of, {seen, casters, forward, scale_m_, size_});
        const Projector& p = light.projector;
        for (std::size_t face = 0; face < p.clip_from_world.size(); ++face) {
            std::vector<CasterDraw>& draws = light.casters.emplace_back();
            for (std::size_t i = 0; i < instances.size(); ++i) {
                if (!instances[i].casts || p.is_needed[face] == 0 ||
                    is_outside(corners[i], p.clip_from_world[face])) {
                    continue;
                }
                const glm::dmat4 clip = p.clip_from_world[face] * instances[i].world_from_local;
                draws.push_back({&instances[i], matrices_.add(glm::mat4(clip), glm::mat4(1.0F))});
            }
        }
        for (const StageInstance& instance : instances) {
            light.receivers.push_back(
                matrices_.add(glm::mat4(clip_from_world * instance.world_from_local),
                              glm::mat4(p.receiver_from_world * instance.world_from_local)));
        }
    }
}

Result<FrameCost> ShadowMap::frame(const Moment& moment, bool /*look*/) {
    gpu::Device& device = stage_.device();
    const auto start = Clock::now();
    const std::uint64_t uploaded = device.counters().uploaded_bytes;
    const auto instances = stage_.instances(*moment.scene);
    const glm::dmat4 clip_from_world = moment.view.clip_from_world();
    matrices_.clear();
    std::vector<std::uint32_t> offsets;
    for (const StageInstance& instance : instances) {
        offsets.push_back(
            matrices_.add(glm::mat4(clip_from_world * instance.world_from_local), glm::mat4(1.0F)));
    }
    project(moment, instances, clip_from_world);
    if (const Status done = matrices_.upload(device, stage_.draw_layout()); !done) {
        return forward_error(done);
    }
    if (const Status done = write_uniforms(); !done) return forward_error(done);
    for (OfLight& light : lights_) {
        const std::uint32_t columns = light.projector.cube ? 3 : 1;
        const std::uint32_t rows = light.projector.cube ? 2 : 1;
        if (columns * size_ > device.caps().limits.max_texture_dimension_2d) {
            return fail(ErrorCode::Unsupported,
                        fmt::format("Six maps of {} texels are larger together than this "
                                    "adapter's limit of {}.",
                                    size_, device.caps().limits.max_texture_dimension_2d));
        }
        auto map = stage_.shadow_map(columns * size_, rows * size_);
        if (!map) return forward_error(map);
        light.map = *map;
        auto group = map_group(*map);
        if (!group) return forward_error(group);
        light.group = *group;
    }
    constexpr gpu::Format format = gpu::Format::Depth32FloatStencil8;
    auto depth = stage_.depth_stencil(format);
    if (!depth) return forward_error(depth);
    auto pipeline = stage_.depth_pipeline(format, DepthRange::Reversed);
    if (!pipeline) return forward_error(pipeline);
    auto encoder = device.create_command_encoder("frame");
    stage_.record_depth(encoder, *pipeline, *depth, DepthRange::Reversed, instances, matrices_,
                        offsets);
    for (std::size_t light = 0; light < lights_.size(); ++light) {
        record(encoder, *depth, instances, light);
    }
    return draw_and_wait(device, encoder, start, uploaded);
}

}  // namespace

Result<std::unique_ptr<Technique>> create_shadow_map(const Setup& setup, std::uint32_t size,
                                                     MapFilter filter) {
    auto technique = std::make_unique<ShadowMap>(setup, size, filter);
    if (const Status created = technique->create(); !created) return forward_error(created);
    return technique;
}

}  // namespace gnomon::report::internal
