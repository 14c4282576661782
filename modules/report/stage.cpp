// SPDX-License-Identifier: MIT
#include "internal/stage.hpp"

#include <cstring>

#include <gnomon_shaders/report.hpp>

namespace gnomon::report::internal {

namespace {

constexpr std::size_t matrix_stride = 256;  // WebGPU's largest alignment

struct Matrices {  // std140, as in shaders/draw.glsl
    glm::mat4 clip_from_local;
    glm::mat4 light_from_local;
};

Result<gpu::Buffer> filled_buffer(gpu::Device& device, const char* label, gpu::BufferUsage usage,
                                  std::span<const std::byte> bytes) {
    auto buffer = device.create_buffer(
        {.label = label, .size = bytes.size(), .usage = usage | gpu::BufferUsage::CopyDst});
    if (!buffer) return buffer;
    if (const Status written = device.write_buffer(*buffer, 0, bytes); !written) {
        return forward_error(written);
    }
    return buffer;
}

}  // namespace

std::uint32_t DrawMatrices::add(const glm::mat4& clip_from_local,
                                const glm::mat4& light_from_local) {
    const std::size_t offset = bytes_.size();
    bytes_.resize(offset + matrix_stride);
    const Matrices matrices{clip_from_local, light_from_local};
    std::memcpy(bytes_.data() + offset, &matrices, sizeof matrices);
    return static_cast<std::uint32_t>(offset);
}

Status DrawMatrices::upload(gpu::Device& device, gpu::BindGroupLayoutId layout) {
    if (bytes_.empty()) return {};
    if (bytes_.size() > size_) {
        auto buffer =
            device.create_buffer({.label = "matrices",
                                  .size = bytes_.size(),
                                  .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
        if (!buffer) return forward_error(buffer);
        auto group = device.create_bind_group(
            {.label = "matrices",
             .layout = layout,
             .entries = {{.binding = 1, .buffer = *buffer, .size = sizeof(Matrices)}}});
        if (!group) return forward_error(group);
        group_ = std::move(*group);
        buffer_ = std::move(*buffer);
        size_ = bytes_.size();
    }
    return device.write_buffer(buffer_, 0, bytes_);
}

Result<std::unique_ptr<Stage>> Stage::create(gpu::Device& device, std::uint32_t width,
                                             std::uint32_t height) {
    auto stage = std::make_unique<Stage>();
    stage->device_ = &device;
    stage->width_ = width;
    stage->height_ = height;
    auto layout =
        device.create_bind_group_layout({.label = "draw",
                                         .entries = {{.binding = 1,
                                                      .visibility = gpu::ShaderStage::Vertex,
                                                      .has_dynamic_offset = true,
                                                      .min_binding_size = sizeof(Matrices)}}});
    if (!layout) return forward_error(layout);
    stage->draw_layout_ = std::move(*layout);
    const auto shader = [&](const char* label, gpu::ShaderStage kind,
                            const gpu::ShaderSource& source, gpu::Shader& out) -> Status {
        auto made = device.create_shader({.label = label, .stage = kind, .source = source});
        if (!made) return forward_error(made);
        out = std::move(*made);
        return {};
    };
    for (const Status& made :
         {shader("positions", gpu::ShaderStage::Vertex, shaders::positions_vert, stage->positions_),
          shader("full screen", gpu::ShaderStage::Vertex, shaders::full_screen_vert,
                 stage->full_screen_),
          shader("white", gpu::ShaderStage::Fragment, shaders::white_frag, stage->white_)}) {
        if (!made) return forward_error(made);
    }
    return stage;
}

Status Stage::upload(const scene::Scene& scene) {
    Status status;
    geometry_.clear();
    scene.registry.each<scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::MeshInstance& instance,
            const scene::WorldTransform& world) {
            if (!status || instance.mesh->indices.empty()) return;
            const auto geometry = scene::geometry_of(scene.registry, entity, instance, world);
            auto positions = filled_buffer(*device_, "positions", gpu::BufferUsage::Vertex,
                                           std::as_bytes(geometry.positions));
            auto indices = filled_buffer(*device_, "indices", gpu::BufferUsage::Index,
                                         std::as_bytes(std::span(instance.mesh->indices)));
            if (!positions) status = forward_error(positions);
            if (!indices) status = forward_error(indices);
            if (!status) return;
            scene::Bounds box;
            for (const glm::vec3& p : geometry.positions) box.include(glm::dvec3(p));
            geometry_.emplace(
                entity.key(),
                GpuGeometry{std::move(*positions), std::move(*indices),
                            static_cast<std::uint32_t>(instance.mesh->indices.size()), box});
        });
    return status;
}

std::vector<StageInstance> Stage::instances(const scene::Scene& scene) const {
    std::vector<StageInstance> all;
    scene.registry.each<scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::MeshInstance& instance,
            const scene::WorldTransform& world) {
            const auto found = geometry_.find(entity.key());
            if (found == geometry_.end()) return;
            const auto geometry = scene::geometry_of(scene.registry, entity, instance, world);
            all.push_back({&found->second, geometry.world_from_positions,
                           scene.registry.has<scene::Caster>(entity),
                           scene.registry.has<scene::Receiver>(entity)});
        });
    return all;
}

Status Stage::ensure_masks(std::size_t lights) {
    while (masks_.size() < lights) {
        auto mask = device_->create_texture(
            {.label = "mask",
             .width = width_,
             .height = height_,
             .format = mask_format,
             .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc});
        if (!mask) return forward_error(mask);
        masks_.push_back(std::move(*mask));
    }
    return {};
}

Result<gpu::TextureId> Stage::depth_stencil(gpu::Format format) {
    if (const auto found = depth_.find(format); found != depth_.end()) return found->second.id();
    auto made = device_->create_texture(
        {.label = "depth-stencil",
         .width = width_,
         .height = height_,
         .format = format,
         .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc});
    if (!made) return forward_error(made);
    return depth_.emplace(format, std::move(*made)).first->second.id();
}

Result<gpu::TextureId> Stage::shadow_map(std::uint32_t width, std::uint32_t height) {
    const std::pair size(width, height);
    if (const auto found = maps_.find(size); found != maps_.end()) return found->second.id();
    auto made = device_->create_texture(
        {.label = "shadow map",
         .width = width,
         .height = height,
         .format = gpu::Format::Depth32Float,
         .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::TextureBinding});
    if (!made) return forward_error(made);
    return maps_.emplace(size, std::move(*made)).first->second.id();
}

Result<gpu::RenderPipelineId> Stage::depth_pipeline(gpu::Format format, DepthRange range) {
    const std::pair kind(format, range);
    if (const auto found = depth_pipelines_.find(kind); found != depth_pipelines_.end()) {
        return found->second.id();
    }
    auto made = device_->create_render_pipeline(
        {.label = "depth",
         .bind_group_layouts = {draw_layout_},
         .vertex = positions_,
         .vertex_buffers = {position_layout()},
         .depth_stencil = gpu::DepthStencilState{.format = format,
                                                 .depth_write_enabled = true,
                                                 .depth_compare = range == DepthRange::Reversed
                                                                      ? gpu::Compare::Greater
                                                                      : gpu::Compare::Less}});
    if (!made) return forward_error(made);
    return depth_pipelines_.emplace(kind, std::move(*made)).first->second.id();
}

void Stage::draw(gpu::RenderPassEncoder& pass, const StageInstance& instance,
                 gpu::BindGroupId group, std::uint32_t offset) {
    pass.set_bind_group(0, group, std::span(&offset, 1));
    pass.set_vertex_buffer(0, instance.geometry->positions);
    pass.set_index_buffer(instance.geometry->indices, gpu::IndexFormat::Uint32);
    pass.draw_indexed(instance.geometry->index_count);
}

void Stage::record_depth(gpu::CommandEncoder& encoder, gpu::RenderPipelineId pipeline,
                         gpu::TextureId depth_stencil, DepthRange range,
                         std::span<const StageInstance> instances, const DrawMatrices& matrices,
                         std::span<const std::uint32_t> offsets) const {
    auto pass = encoder.begin_render_pass(
        {.label = "depth",
         .depth_stencil = gpu::DepthStencilAttachment{
             .texture = depth_stencil,
             .depth_load_op = gpu::LoadOp::Clear,
             .depth_clear_value = range == DepthRange::Reversed ? 0.0F : 1.0F,
             .stencil_load_op = gpu::LoadOp::Clear}});
    pass.set_pipeline(pipeline);
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (instances[i].receives) draw(pass, instances[i], matrices.group(), offsets[i]);
    }
}

Status Stage::draw_nothing() {
    auto encoder = device_->create_command_encoder("nothing");
    {
        auto pass = encoder.begin_render_pass(
            {.label = "nothing",
             .color_attachments = {{.texture = masks_[0], .load_op = gpu::LoadOp::Clear}}});
    }
    auto commands = encoder.finish();
    if (!commands) return forward_error(commands);
    if (const Status done = device_->submit(*commands); !done) return done;
    return device_->wait_idle();
}

Result<std::vector<std::vector<std::uint8_t>>> Stage::read_masks(std::size_t lights) {
    std::vector<std::vector<std::uint8_t>> masks;
    for (std::size_t i = 0; i < lights; ++i) {
        auto bytes = device_->read_texture(masks_[i]);
        if (!bytes) return forward_error(bytes);
        masks.emplace_back(bytes->size());
        std::memcpy(masks.back().data(), bytes->data(), bytes->size());
    }
    return masks;
}

}  // namespace gnomon::report::internal
