// SPDX-License-Identifier: MIT
//
// What a Renderer holds and does in a frame: renderer.cpp draws the picture, overlays.cpp the debug
// views.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gnomon/render/renderer.hpp>

#include "gpu_scene.hpp"
#include "lighting.hpp"
#include "pipelines.hpp"
#include "targets.hpp"

namespace gnomon::render {

namespace internal {

/// WebGPU's largest alignment: right for every adapter.
inline constexpr std::uint32_t uniform_alignment = 256;

/// An instance of a mesh, as this frame draws it.
struct Instance {
    GpuMesh* mesh = nullptr;
    const GpuVertices* vertices = nullptr;
    std::uint32_t draw_offset = 0;
    Culling culling = Culling::None;
};

/// All that the commands of a frame depend on, beside what is uploaded once.
struct FrameContents {
    struct Drawn {
        gpu::BufferId positions, attributes, indices;
        std::uint32_t draw_offset = 0;
        Culling culling = Culling::None;
        bool operator==(const Drawn&) const = default;
    };
    struct Light {
        std::optional<std::size_t> draws;
        shadows::PixelRect changed;
        bool operator==(const Light&) const = default;
    };
    std::vector<Drawn> drawn;
    std::vector<Light> lights;
    std::size_t light_count = 0;
    std::uint64_t shadows = 0;  ///< ShadowPass::revision()
    gpu::BindGroupId draws, rounds;
    bool unclipped = false;
    glm::vec3 background{0.0F};
    bool operator==(const FrameContents&) const = default;
};

/// A uniform buffer that grows, and its bind group.
struct Uniforms {
    gpu::Buffer buffer;
    std::uint64_t size = 0;
    gpu::BindGroup group;
};

}  // namespace internal

struct Renderer::State {
    gpu::Device* device = nullptr;
    RendererDesc desc;
    internal::GpuScene gpu_scene;
    internal::Targets targets;
    internal::Pipelines pipelines;
    std::optional<shadow_pass::ShadowPass> shadows;
    internal::Uniforms overlay;
    gpu::Sampler sampler;
    gpu::BindGroup tone_map_group;
    gpu::BindGroup mask_group;
    internal::Uniforms draws;
    internal::Uniforms rounds;

    std::vector<internal::Instance> instances;
    std::vector<internal::FrameLight> lights;  // those that are drawn
    bool unclipped = false;                    // this frame's geometry
    glm::vec3 background{0.0F};                // and what is behind it
    std::optional<scene::Bounds> bounds;       // of the scene when it was first drawn
    std::size_t light_count = 0;               // of the last frame's draw list
    FrameTimes times;
    gpu::CommandEncoder encoder;
    // The last frame, to be submitted again where its commands would be the same.
    std::optional<gpu::CommandBuffer> recorded;
    internal::FrameContents recorded_contents;
    internal::FrameContents contents;
    double called_back_ms = 0.0;

    State(gpu::Device& d, const RendererDesc& description)
        : device(&d), desc(description), gpu_scene(d), encoder(d.create_command_encoder("frame")) {}

    Status create();
    Status create_passes();
    Status create_targets();
    Status create_overlays();
    Status write(internal::Uniforms& uniforms, const char* label, gpu::BindGroupLayoutId layout,
                 std::uint32_t binding, std::uint64_t size, std::span<const std::byte> bytes);
    Status collect_instances(const FrameInput& input);

    Status write_rounds(const FrameInput& input);
    [[nodiscard]] std::size_t round_count() const;
    [[nodiscard]] std::span<const internal::FrameLight> lights_of(std::size_t round) const;

    // The light mask, or the picture, with the scene's depth and stencil.
    [[nodiscard]] gpu::RenderPassDesc mask_pass(std::string label, gpu::LoadOp mask,
                                                gpu::LoadOp stencil) const;
    [[nodiscard]] gpu::RenderPassDesc picture_pass(std::string label, gpu::LoadOp color) const;
    void draw_instance(gpu::RenderPassEncoder& pass, const internal::Instance& instance) const;
    void record_depth();
    Status record_masks(const FrameInput& input, std::size_t round);
    void record_shading(std::size_t round);
    void shade(gpu::RenderPassEncoder& pass, const internal::GeometryPipelines& geometry,
               std::uint32_t round_offset) const;
    void record_counts();
    void record_fill();
    Status record_overlays();
    void record_picture();
    void find_contents(const FrameInput& input);
    Status record(const FrameInput& input);
    Status submit();
    Status submit(const gpu::CommandBuffer& commands);
};

}  // namespace gnomon::render
