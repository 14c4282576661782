// SPDX-License-Identifier: MIT
#include <gnomon/render/renderer.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

#include <gnomon/core/expects.hpp>
#include <gnomon/shadow_pass/stencil_samples.hpp>

#include "internal/gpu_scene.hpp"
#include "internal/lighting.hpp"
#include "internal/pipelines.hpp"
#include "internal/targets.hpp"

namespace gnomon::render {

using internal::Culling;

namespace {

constexpr std::uint32_t uniform_stride =
    256;  // WebGPU's largest alignment: right for every adapter

// std140, as in geometry.vert.
struct DrawUniforms {
    glm::mat4 clip_from_local;
    glm::mat4 view_from_local;
    glm::mat4 normal_matrix;
};

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

struct Instance {
    internal::GpuMesh* mesh = nullptr;
    const internal::GpuVertices* vertices = nullptr;
    std::uint32_t draw_offset = 0;
    Culling culling = Culling::None;
    glm::dvec3 center{0.0};
    double radius = 0.0;
};

}  // namespace

struct Renderer::State {
    gpu::Device* device = nullptr;
    RendererDesc desc;
    internal::GpuScene gpu_scene;
    internal::Targets targets;
    internal::Pipelines pipelines;
    std::optional<shadow_pass::ShadowPass> shadows;
    gpu::Buffer overlay_uniforms;
    gpu::BindGroup overlay_group;
    gpu::Sampler tone_map_sampler;
    gpu::BindGroup tone_map_group;

    struct Uniforms {
        gpu::Buffer buffer;
        std::uint64_t size = 0;
        gpu::BindGroup group;
    };
    Uniforms draws;
    Uniforms frame;  // ambient first, then the lights

    std::vector<Instance> instances;
    bool unclipped = false;               // this frame's geometry
    std::optional<scene::Bounds> bounds;  // of the scene when it was first drawn
    std::size_t light_count = 0;          // of the last frame
    FrameTimes times;

    State(gpu::Device& d, const RendererDesc& description)
        : device(&d), desc(description), gpu_scene(d) {}

    Status create();
    Status write(Uniforms& uniforms, const char* label, gpu::BindGroupLayoutId layout,
                 std::uint32_t binding, std::uint64_t size, std::span<const std::byte> bytes);
    Status collect_instances(const FrameInput& frame);
    Status write_frame_uniforms(const FrameInput& frame,
                                std::span<const internal::FrameLight> lights);
    void draw_instance(gpu::RenderPassEncoder& pass, const Instance& instance) const;
    void draw_geometry(gpu::RenderPassEncoder& pass, const internal::GeometryPipelines& geometry,
                       std::uint32_t frame_offset, const internal::FrameLight* light) const;
    [[nodiscard]] gpu::RenderPassDesc scene_pass(std::string label, bool first) const;
    void record_light(gpu::CommandEncoder& encoder, std::size_t index,
                      const internal::FrameLight& light) const;
    void record_fill_overlay(gpu::CommandEncoder& encoder, std::size_t lights) const;
    Status record_overlays(gpu::CommandEncoder& encoder, const FrameInput& frame);
    void record_picture(gpu::CommandEncoder& encoder) const;
};

Status Renderer::State::create() {
    if (const Status made = gpu_scene.create(); !made) return made;
    auto made_targets = internal::create_targets(*device, desc);
    if (!made_targets) return forward_error(made_targets);
    targets = std::move(*made_targets);
    auto pass = shadow_pass::ShadowPass::create(
        *device,
        {.depth_stencil_format = desc.depth_stencil_format,
         .depth_compare = desc.volume_depth_compare,
         .sample_count = desc.sample_count,
         .color_formats = {internal::radiance_format},
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

    std::vector<std::byte> colors(overlay_colors.size() * uniform_stride);
    for (std::size_t i = 0; i < overlay_colors.size(); ++i) {
        std::memcpy(colors.data() + i * uniform_stride, &overlay_colors[i], sizeof(glm::vec4));
    }
    Uniforms overlay;
    const Status written =
        write(overlay, "overlay colours", pipelines.overlay_layout, 4, sizeof(glm::vec4), colors);
    if (!written) return written;
    overlay_uniforms = std::move(overlay.buffer);
    overlay_group = std::move(overlay.group);

    auto sampler = device->create_sampler({.label = "tone map"});
    if (!sampler) return forward_error(sampler);
    tone_map_sampler = std::move(*sampler);
    auto group =
        device->create_bind_group({.label = "tone map",
                                   .layout = pipelines.tone_map_layout,
                                   .entries = {{.binding = 0,
                                                .texture = targets.single_sampled_radiance(),
                                                .sampler = tone_map_sampler}}});
    if (!group) return forward_error(group);
    tone_map_group = std::move(*group);
    return {};
}

// Grows the buffer when it must, and its bind group with it.
Status Renderer::State::write(Uniforms& uniforms, const char* label, gpu::BindGroupLayoutId layout,
                              std::uint32_t binding, std::uint64_t size,
                              std::span<const std::byte> bytes) {
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

Status Renderer::State::collect_instances(const FrameInput& frame) {
    unclipped = device->caps().features.unclipped_depth &&
                frame.view.projection != shadows::ProjectionKind::InfinitePerspective;
    instances.clear();
    std::vector<std::byte> bytes;
    const glm::dmat4 clip_from_world = frame.view.clip_from_world();
    Status status;
    frame.scene.registry.each<scene::Receiver, scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::Receiver&, const scene::MeshInstance& mesh,
            const scene::WorldTransform& transform) {
            internal::GpuMesh* gpu_mesh = gpu_scene.find(mesh.mesh.get());
            if (gpu_mesh == nullptr || !status) return;
            const scene::Geometry geometry =
                scene::geometry_of(frame.scene.registry, entity, mesh, transform);
            const auto vertices = gpu_scene.vertices_of(entity, *gpu_mesh, geometry);
            if (!vertices) {
                status = forward_error(vertices);
                return;
            }
            const glm::dmat4& world = geometry.world_from_positions;
            Instance instance;
            instance.mesh = gpu_mesh;
            instance.vertices = *vertices;
            instance.draw_offset = static_cast<std::uint32_t>(bytes.size());
            const glm::dmat3 linear(world);
            if (desc.cull_back_faces) {
                instance.culling =
                    glm::determinant(linear) < 0.0 ? Culling::BackMirrored : Culling::Back;
            }
            instance.center = glm::dvec3(world * glm::dvec4(instance.vertices->center, 1.0));
            const double scale =
                glm::length(linear[0]) + glm::length(linear[1]) + glm::length(linear[2]);
            instance.radius = instance.vertices->radius * scale;

            const glm::dmat4 view_from_local = frame.view.view_from_world * world;
            const DrawUniforms u{glm::mat4(clip_from_world * world), glm::mat4(view_from_local),
                                 glm::mat4(glm::mat3(cofactors(glm::dmat3(view_from_local))))};
            bytes.resize(bytes.size() + uniform_stride);
            std::memcpy(bytes.data() + instance.draw_offset, &u, sizeof u);
            instances.push_back(instance);
        });
    if (!status) return status;
    // Changing a material costs some drivers far more than a draw.
    std::stable_sort(instances.begin(), instances.end(), [](const Instance& a, const Instance& b) {
        return std::pair(a.culling, a.mesh->mesh->sub_meshes[0].material) <
               std::pair(b.culling, b.mesh->mesh->sub_meshes[0].material);
    });
    return write(draws, "draws", pipelines.draw_layout, 1, sizeof(DrawUniforms), bytes);
}

Status Renderer::State::write_frame_uniforms(const FrameInput& input,
                                             std::span<const internal::FrameLight> lights) {
    std::vector<std::byte> bytes((1 + lights.size()) * uniform_stride);
    const internal::AmbientUniforms ambient = internal::ambient_uniforms(input.view);
    std::memcpy(bytes.data(), &ambient, sizeof ambient);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        internal::LightUniforms uniforms = lights[i].uniforms;
        const bool fades = desc.averted_faces == shadow_pass::AvertedFaces::Shadowed;
        uniforms.spot_range.z = fades ? 1.0F : 0.0F;
        std::memcpy(bytes.data() + (1 + i) * uniform_stride, &uniforms, sizeof uniforms);
    }
    return write(frame, "frame", pipelines.frame_layout, 0, sizeof(internal::LightUniforms), bytes);
}

void Renderer::State::draw_instance(gpu::RenderPassEncoder& pass, const Instance& instance) const {
    pass.set_bind_group(0, draws.group, std::span(&instance.draw_offset, 1));
    pass.set_vertex_buffer(0, instance.vertices->positions);
    pass.set_vertex_buffer(1, instance.vertices->attributes);
}

void Renderer::State::draw_geometry(gpu::RenderPassEncoder& pass,
                                    const internal::GeometryPipelines& geometry,
                                    std::uint32_t frame_offset,
                                    const internal::FrameLight* light) const {
    std::optional<Culling> current;
    std::optional<std::uint32_t> material;
    for (const Instance& instance : instances) {
        if (light != nullptr && light->range_m > 0.0 &&
            glm::length(instance.center - glm::dvec3(light->position_world)) >
                light->range_m + instance.radius) {
            continue;
        }
        if (current != instance.culling) {
            current = instance.culling;
            pass.set_pipeline(geometry.get(instance.culling, unclipped));
            pass.set_bind_group(1, frame.group, std::span(&frame_offset, 1));
        }
        draw_instance(pass, instance);
        pass.set_index_buffer(instance.mesh->indices, gpu::IndexFormat::Uint32);
        for (const scene::SubMesh& sub : instance.mesh->mesh->sub_meshes) {
            if (material != sub.material) pass.set_bind_group(2, gpu_scene.material(sub.material));
            material = sub.material;
            pass.draw_indexed(sub.index_count, 1, sub.first_index);
        }
    }
}

gpu::RenderPassDesc Renderer::State::scene_pass(std::string label, bool first) const {
    const gpu::LoadOp load = first ? gpu::LoadOp::Clear : gpu::LoadOp::Load;
    return {.label = std::move(label),
            .color_attachments = {{.texture = targets.radiance,
                                   .load_op = load,
                                   .clear_value = {0.20, 0.26, 0.34, 1.0}}},
            .depth_stencil = gpu::DepthStencilAttachment{.texture = targets.depth_stencil,
                                                         .depth_load_op = load,
                                                         .stencil_load_op = gpu::LoadOp::Clear}};
}

void Renderer::State::record_light(gpu::CommandEncoder& encoder, std::size_t index,
                                   const internal::FrameLight& light) const {
    auto pass = encoder.begin_render_pass(scene_pass("light " + std::to_string(index), false));
    shadows->record(pass, index);
    pass.set_stencil_reference(0);
    draw_geometry(pass, pipelines.light, static_cast<std::uint32_t>(1 + index) * uniform_stride,
                  &light);
    if (desc.overlays.count && !instances.empty()) {
        pass.set_pipeline(pipelines.count);
        pass.set_bind_group(0, draws.group, std::array<std::uint32_t, 1>{0});
        for (std::uint32_t count = 1; first_count + count <= overlay_colors.size(); ++count) {
            const std::uint32_t offset = (first_count + count - 1) * uniform_stride;
            pass.set_bind_group(1, overlay_group, std::span(&offset, 1));
            pass.set_stencil_reference(count);
            pass.draw(3);
        }
    }
}

void Renderer::State::record_fill_overlay(gpu::CommandEncoder& encoder, std::size_t lights) const {
    auto pass = encoder.begin_render_pass(scene_pass("fill overlay", false));
    for (std::size_t light = 0; light < lights; ++light) {
        shadows->record_fill(pass, light, shadow_pass::Fill::PerPixel);
    }
    for (std::uint32_t band = 0; band < internal::fill_bands; ++band) {
        const std::uint32_t offset = (first_count + band) * uniform_stride;
        pass.set_pipeline(pipelines.fill[band]);
        pass.set_bind_group(0, draws.group, std::array<std::uint32_t, 1>{0});
        pass.set_bind_group(1, overlay_group, std::span(&offset, 1));
        pass.set_stencil_reference(1U << band);
        pass.draw(3);
    }
}

Status Renderer::State::record_overlays(gpu::CommandEncoder& encoder, const FrameInput& input) {
    const Overlays& show = desc.overlays;
    if (!show.any()) return {};
    if (show.fill && !instances.empty()) record_fill_overlay(encoder, input.shadows.lights.size());
    if (show.wireframe) {
        for (const Instance& instance : instances) {
            if (const Status made = gpu_scene.ensure_lines(*instance.mesh); !made) return made;
        }
    }
    auto desc_of_pass = scene_pass("overlays", false);
    desc_of_pass.depth_stencil->stencil_load_op = gpu::LoadOp::Load;
    auto pass = encoder.begin_render_pass(desc_of_pass);
    const auto color = [&](OverlayColor which) {
        const std::uint32_t offset = which * uniform_stride;
        pass.set_bind_group(1, overlay_group, std::span(&offset, 1));
    };
    if (show.wireframe) {
        pass.set_pipeline(pipelines.wireframe);
        color(Wireframe);
        for (const Instance& instance : instances) {
            draw_instance(pass, instance);
            pass.set_index_buffer(instance.mesh->line_indices, gpu::IndexFormat::Uint32);
            pass.draw_indexed(static_cast<std::uint32_t>(instance.mesh->mesh->indices.size() * 2));
        }
    }
    for (std::size_t light = 0; light < input.shadows.lights.size(); ++light) {
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

void Renderer::State::record_picture(gpu::CommandEncoder& encoder) const {
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
    return state_->gpu_scene.upload(scene);
}

Status Renderer::render(const FrameInput& input) {
    State& s = *state_;
    s.times = {};
    const auto start = Clock::now();
    double called_back_ms = 0.0;
    if (const Status done = s.collect_instances(input); !done) return done;
    // Once an upload: it visits every vertex, and exposure had better not follow what moves.
    if (!s.bounds) s.bounds = scene::world_bounds(input.scene);
    const auto lights =
        internal::frame_lights(input.scene, *s.bounds, input.shadows.lights, input.view);
    if (const Status done = s.write_frame_uniforms(input, lights); !done) return done;
    if (const Status done =
            s.shadows->prepare(input.shadows, input.view, {s.desc.width, s.desc.height});
        !done)
        return done;
    s.light_count = lights.size();

    gpu::CommandEncoder encoder = s.device->create_command_encoder("frame");
    const auto submit = [&]() -> Status {
        auto commands = encoder.finish();
        if (!commands) return forward_error(commands);
        encoder = s.device->create_command_encoder("frame");
        const auto before = Clock::now();
        const Status submitted = s.device->submit(*commands);
        s.times.submit_ms += milliseconds_since(before);
        return submitted;
    };
    {
        auto pass = encoder.begin_render_pass(s.scene_pass("depth and ambient", true));
        s.draw_geometry(pass, s.pipelines.ambient, 0, nullptr);
    }
    for (std::size_t i = 0; i < lights.size(); ++i) {
        s.record_light(encoder, i, lights[i]);
        if (input.after_light) {
            if (const Status done = submit(); !done) return done;
            const auto before = Clock::now();
            const Status done = input.after_light(i);
            called_back_ms += milliseconds_since(before);
            if (!done) return done;
        }
    }
    if (const Status done = s.record_overlays(encoder, input); !done) return done;
    s.record_picture(encoder);
    const Status submitted = submit();
    s.times.record_ms = milliseconds_since(start) - s.times.submit_ms - called_back_ms;
    return submitted;
}

Result<std::vector<shadow_pass::LightFill>> Renderer::measure_fill() {
    GNOMON_EXPECTS(state_->desc.meter_fill);
    return shadow_pass::count_fill(*state_->device, *state_->shadows,
                                   state_->scene_pass("fill meter", false), state_->light_count);
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
