// SPDX-License-Identifier: MIT
#include <gnomon/render/renderer.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include <gnomon/core/expects.hpp>
#include <gnomon/shadow_pass/stencil_samples.hpp>

#include "internal/renderer_state.hpp"

namespace gnomon::render {

using internal::Culling;

namespace {

// std140, as in geometry.vert.
struct DrawUniforms {
    glm::mat4 clip_from_local;
    glm::mat4 view_from_local;
    glm::mat4 normal_matrix;
};

// Normals go with the cofactors of the matrix: the inverse transpose but for a factor, and there
// also where a scale is zero. The sign keeps them outward under a mirror.
glm::dmat3 cofactors(const glm::dmat3& m) {
    const glm::dmat3 c(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const double largest =
        std::max({glm::length(c[0]), glm::length(c[1]), glm::length(c[2]), 1e-300});
    return c * ((glm::determinant(m) < 0.0 ? -1.0 : 1.0) / largest);
}

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Of one round's uniforms.
constexpr std::uint32_t round_stride =
    (sizeof(internal::RoundUniforms) + internal::uniform_alignment - 1) /
    internal::uniform_alignment * internal::uniform_alignment;

}  // namespace

Status Renderer::State::create() {
    if (const Status made = gpu_scene.create(); !made) return made;
    auto made_sampler = device->create_sampler({.label = "texels"});
    if (!made_sampler) return forward_error(made_sampler);
    sampler = std::move(*made_sampler);
    if (const Status made = create_passes(); !made) return made;
    return create_targets();
}

// Whatever does not depend on the size.
Status Renderer::State::create_passes() {
    auto pass = shadow_pass::ShadowPass::create(
        *device,
        {.depth_stencil_format = desc.depth_stencil_format,
         .depth_compare = desc.volume_depth_compare,
         .sample_count = desc.sample_count,
         .color_formats = {internal::mask_format},
         .extrusion = desc.extrusion,
         .silhouette_lines = desc.overlays.silhouettes,
         .cap_parts = desc.overlays.caps,
         .expand_quads = desc.overlays.volumes || desc.overlays.silhouettes || desc.overlays.caps,
         .averted_faces = desc.averted_faces,
         .meter = desc.meter_fill || desc.overlays.fill});
    if (!pass) return forward_error(pass);
    shadows = std::move(*pass);
    auto made_pipelines =
        internal::create_pipelines(*device, desc, gpu_scene.material_layout(), *shadows);
    if (!made_pipelines) return forward_error(made_pipelines);
    pipelines = std::move(*made_pipelines);

    // Their bind groups are of the old layouts.
    overlay = {};
    draws = {};
    rounds = {};
    return create_overlays();
}

Status Renderer::State::create_targets() {
    auto made_targets = internal::create_targets(*device, desc);
    if (!made_targets) return forward_error(made_targets);
    targets = std::move(*made_targets);
    auto group = device->create_bind_group(
        {.label = "tone map",
         .layout = pipelines.tone_map_layout,
         .entries = {
             {.binding = 0, .texture = targets.single_sampled_radiance(), .sampler = sampler}}});
    if (!group) return forward_error(group);
    tone_map_group = std::move(*group);
    std::vector<gpu::BindGroupEntry> masks{
        {.binding = 5, .texture = targets.mask, .sampler = sampler}};
    if (targets.fragment_depth) {
        masks.push_back({.binding = 6, .texture = targets.fragment_depth, .sampler = sampler});
    }
    auto mask = device->create_bind_group(
        {.label = "light mask", .layout = pipelines.mask_layout, .entries = std::move(masks)});
    if (!mask) return forward_error(mask);
    mask_group = std::move(*mask);
    return {};
}

// Grows the buffer when it must, and its bind group with it.
Status Renderer::State::write(internal::Uniforms& uniforms, const char* label,
                              gpu::BindGroupLayoutId layout, std::uint32_t binding,
                              std::uint64_t size, std::span<const std::byte> bytes) {
    if (bytes.empty()) return {};
    if (bytes.size() > uniforms.size) {
        uniforms.group.reset();
        auto buffer =
            device->create_buffer({.label = label,
                                   .size = bytes.size(),
                                   .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
        if (!buffer) return forward_error(buffer);
        uniforms.buffer = std::move(*buffer);
        uniforms.size = bytes.size();
        auto group = device->create_bind_group(
            {.label = label,
             .layout = layout,
             .entries = {{.binding = binding, .buffer = uniforms.buffer, .size = size}}});
        if (!group) return forward_error(group);
        uniforms.group = std::move(*group);
    }
    return device->write_buffer(uniforms.buffer, 0, bytes);
}

Status Renderer::State::collect_instances(const FrameInput& input) {
    unclipped = device->caps().features.unclipped_depth &&
                input.view.projection != shadows::ProjectionKind::InfinitePerspective;
    instances.clear();
    std::vector<std::byte> bytes;
    const glm::dmat4 clip_from_world = input.view.clip_from_world();
    Status status;
    input.scene.registry.each<scene::Receiver, scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::Receiver&, const scene::MeshInstance& mesh,
            const scene::WorldTransform& transform) {
            internal::GpuMesh* gpu_mesh = gpu_scene.find(mesh.mesh.get());
            if (gpu_mesh == nullptr || !status) return;
            const scene::Geometry geometry =
                scene::geometry_of(input.scene.registry, entity, mesh, transform);
            const auto vertices = gpu_scene.vertices_of(entity, *gpu_mesh, geometry);
            if (!vertices) {
                status = forward_error(vertices);
                return;
            }
            const glm::dmat4& world = geometry.world_from_positions;
            internal::Instance instance;
            instance.mesh = gpu_mesh;
            instance.vertices = *vertices;
            instance.draw_offset = static_cast<std::uint32_t>(bytes.size());
            const glm::dmat3 linear(world);
            if (desc.cull_back_faces) {
                instance.culling =
                    glm::determinant(linear) < 0.0 ? Culling::BackMirrored : Culling::Back;
            }

            const glm::dmat4 view_from_local = input.view.view_from_world * world;
            const DrawUniforms u{glm::mat4(clip_from_world * world), glm::mat4(view_from_local),
                                 glm::mat4(glm::mat3(cofactors(glm::dmat3(view_from_local))))};
            bytes.resize(bytes.size() + internal::uniform_alignment);
            std::memcpy(bytes.data() + instance.draw_offset, &u, sizeof u);
            instances.push_back(instance);
        });
    if (!status) return status;
    // Changing a material costs some drivers far more than a draw.
    std::stable_sort(instances.begin(), instances.end(), [](const auto& a, const auto& b) {
        return std::pair(a.culling, a.mesh->mesh->sub_meshes[0].material) <
               std::pair(b.culling, b.mesh->mesh->sub_meshes[0].material);
    });
    return write(draws, "draws", pipelines.draw_layout, 1, sizeof(DrawUniforms), bytes);
}

Status Renderer::State::write_rounds(const FrameInput& input) {
    const std::size_t count = round_count();
    std::vector<std::byte> bytes(count * round_stride);
    for (std::size_t round = 0; round < count; ++round) {
        internal::RoundUniforms uniforms =
            internal::round_uniforms(input.view, lights_of(round), input.environment, round == 0);
        const bool fades = desc.averted_faces == shadow_pass::AvertedFaces::Shadowed;
        for (internal::LightUniforms& light : uniforms.lights) {
            light.spot_range.z = fades ? 1.0F : 0.0F;
        }
        std::memcpy(bytes.data() + round * round_stride, &uniforms, sizeof uniforms);
    }
    return write(rounds, "rounds of lights", pipelines.round_layout, 0,
                 sizeof(internal::RoundUniforms), bytes);
}

std::size_t Renderer::State::round_count() const {
    return std::max<std::size_t>(
        1, (lights.size() + internal::lights_a_round - 1) / internal::lights_a_round);
}

std::span<const internal::FrameLight> Renderer::State::lights_of(std::size_t round) const {
    const std::size_t first = round * internal::lights_a_round;
    return std::span(lights).subspan(first,
                                     std::min(internal::lights_a_round, lights.size() - first));
}

gpu::RenderPassDesc Renderer::State::mask_pass(std::string label, gpu::LoadOp mask,
                                               gpu::LoadOp stencil) const {
    return {.label = std::move(label),
            .color_attachments = {{.texture = targets.mask, .load_op = mask}},
            .depth_stencil = gpu::DepthStencilAttachment{.texture = targets.depth_stencil,
                                                         .stencil_load_op = stencil}};
}

gpu::RenderPassDesc Renderer::State::picture_pass(std::string label, gpu::LoadOp color) const {
    return {.label = std::move(label),
            .color_attachments = {{.texture = targets.radiance,
                                   .load_op = color,
                                   .clear_value = {background.r, background.g, background.b, 1.0}}},
            .depth_stencil = gpu::DepthStencilAttachment{.texture = targets.depth_stencil}};
}

void Renderer::State::draw_instance(gpu::RenderPassEncoder& pass,
                                    const internal::Instance& instance) const {
    pass.set_bind_group(0, draws.group, std::span(&instance.draw_offset, 1));
    pass.set_vertex_buffer(0, instance.vertices->positions);
    pass.set_vertex_buffer(1, instance.vertices->attributes);
    pass.set_index_buffer(instance.mesh->indices, gpu::IndexFormat::Uint32);
}

void Renderer::State::record_depth() {
    gpu::RenderPassDesc depth_pass{
        .label = "depth",
        .depth_stencil = gpu::DepthStencilAttachment{.texture = targets.depth_stencil,
                                                     .depth_load_op = gpu::LoadOp::Clear,
                                                     .stencil_load_op = gpu::LoadOp::Clear}};
    if (targets.fragment_depth) {
        depth_pass.color_attachments = {
            {.texture = targets.fragment_depth, .load_op = gpu::LoadOp::Clear}};
    }
    auto pass = encoder.begin_render_pass(std::move(depth_pass));
    std::optional<gpu::RenderPipelineId> current;
    const auto set_pipeline = [&](gpu::RenderPipelineId pipeline) {
        if (current == pipeline) return;
        pass.set_pipeline(pipeline);
        current = pipeline;
    };
    const std::uint32_t first_round = 0;
    pass.set_bind_group(1, rounds.group, std::span(&first_round, 1));
    for (const internal::Instance& instance : instances) {
        draw_instance(pass, instance);
        const auto& sub_meshes = instance.mesh->mesh->sub_meshes;
        const bool needs_fragments =
            unclipped || std::any_of(sub_meshes.begin(), sub_meshes.end(), [&](const auto& sub) {
                return gpu_scene.has_holes(sub.material);
            });
        if (!needs_fragments) {
            set_pipeline(pipelines.depth_of_opaque.get(instance.culling, false));
            pass.draw_indexed(static_cast<std::uint32_t>(instance.mesh->mesh->indices.size()));
            continue;
        }
        set_pipeline(pipelines.depth.get(instance.culling, unclipped));
        for (const scene::SubMesh& sub : sub_meshes) {
            pass.set_bind_group(2, gpu_scene.material(sub.material));
            pass.draw_indexed(sub.index_count, 1, sub.first_index);
        }
    }
}

// Each light's volumes into the stencil, from there into the light's bit of the mask, which leaves
// the stencil 0 as the depth pass did.
Status Renderer::State::record_masks(const FrameInput& input, std::size_t round) {
    const auto of_round = lights_of(round);
    std::optional<gpu::RenderPassEncoder> pass;
    pass.emplace(
        encoder.begin_render_pass(mask_pass("light masks", gpu::LoadOp::Clear, gpu::LoadOp::Load)));
    for (std::size_t i = 0; i < of_round.size(); ++i) {
        if (!of_round[i].draws) continue;
        const std::size_t light = *of_round[i].draws;
        // Nothing counts outside of what the light's volumes can change.
        const shadows::PixelRect changed =
            shadows::pixels_of(input.shadows.lights[light].bounds, desc.width, desc.height);
        const bool any = input.shadows.lights[light].count > 0 && changed.width > 0;
        if (any) shadows->record(*pass, light);
        if (input.after_light) {
            pass.reset();
            if (const Status done = submit(); !done) return done;
            const auto before = Clock::now();
            const Status done = input.after_light(light);
            called_back_ms += milliseconds_since(before);
            if (!done) return done;
            pass.emplace(encoder.begin_render_pass(
                mask_pass("light masks", gpu::LoadOp::Load, gpu::LoadOp::Load)));
        }
        if (!any) continue;
        const bool keep = light + 1 == input.shadows.lights.size();
        const double bit = static_cast<double>(1U << i) / 255.0;
        pass->set_pipeline(keep ? pipelines.mask_kept : pipelines.mask);
        pass->set_stencil_reference(0);
        pass->set_blend_constant({bit, bit, bit, bit});
        pass->set_scissor_rect(changed.x, changed.y, changed.width, changed.height);
        pass->draw(3);
        pass->set_scissor_rect(0, 0, desc.width, desc.height);
    }
    return {};
}

void Renderer::State::shade(gpu::RenderPassEncoder& pass,
                            const internal::GeometryPipelines& geometry,
                            std::uint32_t round_offset) const {
    std::optional<Culling> current;
    std::optional<std::uint32_t> material;
    for (const internal::Instance& instance : instances) {
        if (current != instance.culling) {
            current = instance.culling;
            pass.set_pipeline(geometry.get(instance.culling, unclipped));
            pass.set_bind_group(1, rounds.group, std::span(&round_offset, 1));
            pass.set_bind_group(3, mask_group);
        }
        draw_instance(pass, instance);
        for (const scene::SubMesh& sub : instance.mesh->mesh->sub_meshes) {
            if (material != sub.material) pass.set_bind_group(2, gpu_scene.material(sub.material));
            material = sub.material;
            pass.draw_indexed(sub.index_count, 1, sub.first_index);
        }
    }
}

void Renderer::State::record_shading(std::size_t round) {
    const bool first = round == 0;
    const auto offset = static_cast<std::uint32_t>(round * round_stride);
    auto pass = encoder.begin_render_pass(
        picture_pass("shading", first ? gpu::LoadOp::Clear : gpu::LoadOp::Load));
    shade(pass, pipelines.forward[first ? 0 : 1], offset);
}

void Renderer::State::record_picture() {
    if (targets.resolved) {
        auto resolve = encoder.begin_render_pass(
            {.label = "resolve",
             .color_attachments = {
                 {.texture = targets.radiance, .resolve_target = targets.resolved}}});
        resolve.end();
    }
    auto pass = encoder.begin_render_pass(
        {.label = "tone map",
         .color_attachments = {{.texture = targets.picture, .load_op = gpu::LoadOp::Clear}}});
    pass.set_pipeline(pipelines.tone_map);
    pass.set_bind_group(0, tone_map_group);
    pass.draw(3);
}

Status Renderer::State::submit() {
    auto commands = encoder.finish();
    encoder = device->create_command_encoder("frame");
    if (!commands) return forward_error(commands);
    return submit(*commands);
}

Status Renderer::State::submit(const gpu::CommandBuffer& commands) {
    const auto before = Clock::now();
    const Status submitted = device->submit(commands);
    times.submit_ms += milliseconds_since(before);
    return submitted;
}

void Renderer::State::find_contents(const FrameInput& input) {
    contents.drawn.clear();
    for (const internal::Instance& instance : instances) {
        contents.drawn.push_back({instance.vertices->positions, instance.vertices->attributes,
                                  instance.mesh->indices, instance.draw_offset, instance.culling});
    }
    contents.lights.clear();
    for (const internal::FrameLight& light : lights) {
        shadows::PixelRect changed;
        if (light.draws) {
            changed = shadows::pixels_of(input.shadows.lights[*light.draws].bounds, desc.width,
                                         desc.height);
        }
        contents.lights.push_back({light.draws, changed});
    }
    contents.light_count = light_count;
    contents.shadows = shadows->revision();
    contents.draws = draws.group;
    contents.rounds = rounds.group;
    contents.unclipped = unclipped;
    contents.background = background;
}

// Into the encoder.
Status Renderer::State::record(const FrameInput& input) {
    record_depth();
    for (std::size_t round = 0; round < round_count(); ++round) {
        if (const Status done = record_masks(input, round); !done) return done;
        record_shading(round);
    }
    if (const Status done = record_overlays(); !done) return done;
    record_picture();
    return {};
}

Result<Renderer> Renderer::create(gpu::Device& device, const RendererDesc& desc) {
    auto state = std::make_unique<State>(device, desc);
    if (const Status created = state->create(); !created) return forward_error(created);
    return Renderer(std::move(state));
}

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Status Renderer::upload(const scene::Scene& scene) {
    state_->bounds.reset();
    state_->recorded.reset();
    return state_->gpu_scene.upload(scene);
}

Status Renderer::reconfigure(const RendererDesc& desc) {
    State& s = *state_;
    RendererDesc resized = s.desc;
    resized.width = desc.width;
    resized.height = desc.height;
    if (desc == s.desc) return {};
    s.desc = desc;
    s.recorded.reset();
    // What measure_fill() would measure is gone with the passes.
    s.lights.clear();
    s.light_count = 0;
    if (desc != resized) {
        if (const Status made = s.create_passes(); !made) return made;
    }
    return s.create_targets();
}

Status Renderer::render(const FrameInput& input) {
    State& s = *state_;
    s.times = {};
    s.called_back_ms = 0.0;
    s.encoder = s.device->create_command_encoder("frame");  // a frame that failed left its own
    const auto start = Clock::now();
    if (const Status done = s.collect_instances(input); !done) return done;
    // Once an upload: it visits every vertex, and exposure had better not follow what moves.
    if (!s.bounds) s.bounds = scene::world_bounds(input.scene);
    s.lights = internal::frame_lights(input.scene, *s.bounds, input.shadows.lights,
                                      input.unshadowed, input.view, input.environment.exposure);
    s.background = input.environment.background;
    std::erase_if(s.lights, [&](const internal::FrameLight& light) {
        const bool asked_for = light.draws && input.after_light;
        return !light.in_view && !asked_for;
    });
    s.light_count = input.shadows.lights.size();
    if (const Status done = s.write_rounds(input); !done) return done;
    const shadow_pass::TargetSize target{s.desc.width, s.desc.height};
    if (const Status done = s.shadows->prepare(input.shadows, input.view, target); !done) {
        return done;
    }

    Status submitted;
    if (input.after_light || s.desc.overlays.any()) {
        if (const Status done = s.record(input); !done) return done;
        submitted = s.submit();
    } else {
        s.find_contents(input);
        s.times.recorded = !s.recorded || s.contents != s.recorded_contents;
        if (s.times.recorded) {
            s.recorded.reset();
            if (const Status done = s.record(input); !done) return done;
            auto commands = s.encoder.finish();
            if (!commands) return forward_error(commands);
            s.recorded = std::move(*commands);
            std::swap(s.recorded_contents, s.contents);
        }
        submitted = s.submit(*s.recorded);
    }
    s.times.record_ms = milliseconds_since(start) - s.times.submit_ms - s.called_back_ms;
    return submitted;
}

Result<std::vector<shadow_pass::LightFill>> Renderer::measure_fill() {
    State& s = *state_;
    GNOMON_EXPECTS(s.desc.meter_fill);
    std::vector<std::size_t> drawn;
    for (const internal::FrameLight& light : s.lights) {
        if (light.draws) drawn.push_back(*light.draws);
    }
    const auto fill = shadow_pass::count_fill(
        *s.device, *s.shadows, s.mask_pass("fill meter", gpu::LoadOp::Load, gpu::LoadOp::Load),
        drawn);
    if (!fill) return forward_error(fill);
    std::vector<shadow_pass::LightFill> by_light(s.light_count);
    for (std::size_t i = 0; i < drawn.size(); ++i) by_light[drawn[i]] = (*fill)[i];
    return by_light;
}

gpu::TextureId Renderer::picture() const { return state_->targets.picture; }
gpu::TextureId Renderer::depth_stencil() const { return state_->targets.depth_stencil; }
const shadow_pass::PassStats& Renderer::shadow_stats() const { return state_->shadows->stats(); }
FrameTimes Renderer::times() const { return state_->times; }
const RendererDesc& Renderer::desc() const { return state_->desc; }

Result<std::vector<std::byte>> read_stencil(gpu::Device& device, const Renderer& renderer,
                                            std::uint32_t sample) {
    const RendererDesc& desc = renderer.desc();
    if (desc.sample_count == 1)
        return device.read_texture(renderer.depth_stencil(), gpu::Aspect::StencilOnly);
    return shadow_pass::read_stencil_sample(device, renderer.depth_stencil(), desc.width,
                                            desc.height, sample);
}

}  // namespace gnomon::render
