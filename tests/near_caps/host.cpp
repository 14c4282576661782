// SPDX-License-Identifier: MIT
#include "tests/near_caps/host.hpp"

#include <array>
#include <cstring>

#include <gnomon/scene/scene.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>
#include <gnomon_shaders/near_caps.hpp>

#include "tests/support/devices.hpp"

namespace gnomon::test {

namespace {

constexpr gpu::Format depth_format = gpu::Format::Depth32FloatStencil8;
constexpr std::uint32_t stride = 512;  // a multiple of every adapter's alignment

// std140, as in scene.glsl.
struct DrawUniforms {
    glm::mat4 clip_from_local;
    glm::mat4 clip_from_view;
    glm::mat4 view_from_world;
    glm::mat4 world_from_local;
    glm::vec4 depth_range;
};

struct Drawn {
    gpu::Buffer positions;
    gpu::Buffer indices;
    std::uint32_t index_count = 0;
};

glm::vec4 depth_range(const shadows::View& view) {
    constexpr float all = 1e30F;  // and not the greatest number: it is interpolated
    if (view.projection == shadows::ProjectionKind::InfinitePerspective) return {-all, all, 0, 0};
    const auto distance = [&](const glm::dvec3& p) {
        return static_cast<float>(-(view.view_from_world * glm::dvec4(p, 1.0)).z);
    };
    return {distance(near_corners(view)[0]), distance(far_corners(view)[0]), 0, 0};
}

class Host {
public:
    Host(gpu::Device& device, const Setting& setting, const HostOptions& options)
        : device_(device), setting_(setting), options_(options) {}

    HostPicture draw() {
        const bool finite =
            setting_.view.projection != shadows::ProjectionKind::InfinitePerspective;
        upload();
        create_pipeline(finite && device_.caps().features.unclipped_depth);
        depth_stencil_ = must(device_.create_texture(
            {.label = "host depth",
             .width = options_.width,
             .height = options_.height,
             .format = depth_format,
             .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc}));

        HostPicture picture;
        auto system = must(shadows::ShadowSystem::create({.force_technique = options_.technique}));
        auto frame = system.begin_frame();
        scene::ShadowAdapter adapter;
        must(adapter.submit(setting_.scene, frame, false, options_.near_caps));
        picture.list = std::move(frame).finish(setting_.view);
        auto pass = must(shadow_pass::ShadowPass::create(
            device_, {.averted_faces = options_.averted_faces, .cap_bias = options_.cap_bias}));
        must(pass.prepare(picture.list, setting_.view));

        auto encoder = device_.create_command_encoder("host");
        {
            auto depth = encoder.begin_render_pass(pass_desc(gpu::LoadOp::Clear));
            depth.set_pipeline(pipeline_);
            for (std::size_t i = 0; i < drawn_.size(); ++i) {
                const auto offset = static_cast<std::uint32_t>(i) * stride;
                depth.set_bind_group(0, group_, std::span(&offset, 1));
                depth.set_vertex_buffer(0, drawn_[i].positions);
                depth.set_index_buffer(drawn_[i].indices, gpu::IndexFormat::Uint32);
                depth.draw_indexed(drawn_[i].index_count);
            }
        }
        submit(encoder);
        for (std::size_t light = 0; light < picture.list.lights.size(); ++light) {
            encoder = device_.create_command_encoder("host");
            {
                auto counting = encoder.begin_render_pass(pass_desc(gpu::LoadOp::Load));
                pass.record(counting, light);
            }
            submit(encoder);
            const auto bytes = must(device_.read_texture(depth_stencil_, gpu::Aspect::StencilOnly));
            std::vector<std::uint8_t> mask(bytes.size());
            std::memcpy(mask.data(), bytes.data(), bytes.size());
            picture.masks.push_back(std::move(mask));
        }
        picture.depth = must(device_.read_texture(depth_stencil_, gpu::Aspect::DepthOnly));
        return picture;
    }

private:
    [[nodiscard]] gpu::RenderPassDesc pass_desc(gpu::LoadOp depth) const {
        return {
            .label = "host",
            .depth_stencil = gpu::DepthStencilAttachment{.texture = depth_stencil_,
                                                         .depth_load_op = depth,
                                                         .stencil_load_op = gpu::LoadOp::Clear}};
    }

    void submit(gpu::CommandEncoder& encoder) { must(device_.submit(must(encoder.finish()))); }

    gpu::Buffer buffer(std::span<const std::byte> bytes, gpu::BufferUsage usage) {
        auto made = must(device_.create_buffer(
            {.label = "host", .size = bytes.size(), .usage = usage | gpu::BufferUsage::CopyDst}));
        must(device_.write_buffer(made, 0, bytes));
        return made;
    }

    void upload() {
        const shadows::View& view = setting_.view;
        const glm::dvec3 eye(glm::inverse(view.view_from_world)[3]);
        std::vector<std::byte> bytes;
        setting_.scene.registry.each<scene::Receiver, scene::MeshInstance, scene::WorldTransform>(
            [&](scene::Entity entity, const scene::Receiver&, const scene::MeshInstance& instance,
                const scene::WorldTransform& transform) {
                const scene::Mesh& mesh = *instance.mesh;
                const scene::Geometry geometry =
                    scene::geometry_of(setting_.scene.registry, entity, instance, transform);
                const glm::dmat4& world = geometry.world_from_positions;
                glm::dmat4 from_eye = world;
                from_eye[3] -= glm::dvec4(eye, 0.0);
                DrawUniforms u;
                u.clip_from_local = glm::mat4(view.clip_from_world() * world);
                u.clip_from_view = glm::mat4(view.clip_from_view);
                u.view_from_world = glm::mat4(glm::dmat4(glm::dmat3(view.view_from_world)));
                u.world_from_local = glm::mat4(from_eye);
                u.depth_range = depth_range(view);
                bytes.resize(bytes.size() + stride);
                std::memcpy(bytes.data() + bytes.size() - stride, &u, sizeof u);
                drawn_.push_back(
                    {buffer(std::as_bytes(geometry.positions), gpu::BufferUsage::Vertex),
                     buffer(std::as_bytes(std::span(mesh.indices)), gpu::BufferUsage::Index),
                     static_cast<std::uint32_t>(mesh.indices.size())});
            });
        uniforms_ = buffer(bytes, gpu::BufferUsage::Uniform);
    }

    void create_pipeline(bool unclipped) {
        layout_ = must(device_.create_bind_group_layout(
            {.label = "host",
             .entries = {{.binding = 0,
                          .visibility = gpu::ShaderStage::Vertex,
                          .has_dynamic_offset = true,
                          .min_binding_size = sizeof(DrawUniforms)}}}));
        group_ = must(device_.create_bind_group(
            {.label = "host",
             .layout = layout_,
             .entries = {{.binding = 0, .buffer = uniforms_, .size = sizeof(DrawUniforms)}}}));
        const auto vertex = must(device_.create_shader(
            {.label = "host vertices",
             .stage = gpu::ShaderStage::Vertex,
             .source = options_.depth == Depth::Shared ? near_caps::shaders::shared_vert
                                                       : near_caps::shaders::foreign_vert}));
        const auto fragment =
            must(device_.create_shader({.label = "host fragments",
                                        .stage = gpu::ShaderStage::Fragment,
                                        .source = near_caps::shaders::depth_frag}));
        gpu::RenderPipelineDesc desc;
        desc.label = "host depth";
        desc.bind_group_layouts = {layout_};
        desc.vertex = vertex;
        desc.fragment = fragment;
        desc.vertex_buffers = {{.array_stride = sizeof(glm::vec3), .attributes = {{}}}};
        desc.primitive.unclipped_depth = unclipped;
        desc.depth_stencil = gpu::DepthStencilState{.format = depth_format,
                                                    .depth_write_enabled = true,
                                                    .depth_compare = gpu::Compare::Greater};
        pipeline_ = must(device_.create_render_pipeline(desc));
    }

    gpu::Device& device_;
    const Setting& setting_;
    const HostOptions& options_;
    std::vector<Drawn> drawn_;
    gpu::Buffer uniforms_;
    gpu::BindGroupLayout layout_;
    gpu::BindGroup group_;
    gpu::RenderPipeline pipeline_;
    gpu::Texture depth_stencil_;
};

}  // namespace

HostPicture host_picture(gpu::Device& device, const Setting& setting, const HostOptions& options) {
    return Host(device, setting, options).draw();
}

}  // namespace gnomon::test
