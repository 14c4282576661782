// SPDX-License-Identifier: MIT
//
// Painting: a small render target and the steps that are drawn on it, each with a pipeline of its
// own. It makes a conformance test a table: state in, pixels out. Failures of the device are
// exceptions, which fail the test.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <gnomon/gpu/device.hpp>

namespace gnomon::conformance {

struct Vertex {
    float x = 0, y = 0, z = 0, w = 1;
    float r = 0, g = 0, b = 0, a = 0;
};

using Rgba = std::array<float, 4>;

/// A rectangle in normalised device coordinates, y up.
struct Rectangle {
    float left = -1, bottom = -1, right = 1, top = 1;
    float z = 0.5F;
    Rgba color{1, 1, 1, 1};
    bool counter_clockwise = true;
};

/// Two triangles, wound as the rectangle says.
[[nodiscard]] std::vector<Vertex> triangles_of(const Rectangle& rectangle);

/// One draw and its whole state. Formats and the sample count come from the painting.
struct Step {
    std::vector<Vertex> vertices = triangles_of({});
    gpu::PrimitiveState primitive = {};
    gpu::DepthStencilState depth_stencil = {.depth_compare = gpu::Compare::Always};
    std::optional<gpu::BlendState> blend = std::nullopt;
    gpu::ColorWrite write_mask = gpu::ColorWrite::All;
    std::uint32_t stencil_reference = 0;
    std::optional<gpu::cmd::SetViewport> viewport = std::nullopt;
    std::optional<gpu::cmd::SetScissorRect> scissor = std::nullopt;
    std::optional<gpu::cmd::SetDepthBounds> depth_bounds = std::nullopt;  ///< else left alone
    gpu::Color blend_constant = {};
    std::optional<std::uint32_t> occlusion_query = std::nullopt;
};

struct PaintingDesc {
    std::uint32_t width = 4;
    std::uint32_t height = 4;
    gpu::Format color_format = gpu::Format::Rgba8Unorm;
    gpu::Format depth_stencil_format = gpu::Format::Depth32FloatStencil8;
    std::uint32_t sample_count = 1;
    gpu::Color clear_color = {};
    float clear_depth = 0.0F;
    std::uint32_t clear_stencil = 0;
};

class Painting {
public:
    Painting(gpu::Device& device, const PaintingDesc& desc);

    /// One pass: clears, then draws the steps in order.
    void paint(const std::vector<Step>& steps, gpu::QuerySetId occlusion_queries = {});
    /// One pass that draws on what is there.
    void paint_over(const std::vector<Step>& steps, gpu::QuerySetId occlusion_queries = {});

    // Reading; row 0 on top. Colour and depth of a multisampled painting cannot be read.
    [[nodiscard]] std::vector<std::uint8_t> color() const;  ///< bytes, as the format has them
    [[nodiscard]] std::vector<float> depth() const;
    [[nodiscard]] std::vector<std::uint8_t> stencil() const;
    [[nodiscard]] std::array<int, 4> pixel(std::uint32_t x, std::uint32_t y) const;  ///< Rgba8Unorm

    [[nodiscard]] const gpu::Texture& color_texture() const { return color_; }
    /// What a multisampled painting is resolved into when a pass ends; empty else.
    [[nodiscard]] const gpu::Texture& resolved_texture() const { return resolved_; }
    [[nodiscard]] const gpu::Texture& depth_stencil_texture() const { return depth_stencil_; }

private:
    void run(const std::vector<Step>& steps, gpu::LoadOp load_op, gpu::QuerySetId queries);
    [[nodiscard]] gpu::RenderPipeline make_pipeline(const Step& step) const;

    gpu::Device& device_;
    PaintingDesc desc_;
    gpu::Texture color_, resolved_, depth_stencil_;
    gpu::Shader vertex_, fragment_;
};

/// Those that hold stencil, of the formats that the device has.
[[nodiscard]] std::vector<gpu::Format> depth_stencil_formats(const gpu::Device& device);

/// A vertex, index or uniform buffer with these bytes.
template <class T>
[[nodiscard]] gpu::Buffer make_buffer(gpu::Device& device, gpu::BufferUsage usage,
                                      const std::vector<T>& contents);

[[nodiscard]] gpu::Buffer make_buffer_of_bytes(gpu::Device& device, gpu::BufferUsage usage,
                                               std::span<const std::byte> bytes);
[[nodiscard]] gpu::Shader make_shader(gpu::Device& device, gpu::ShaderStage stage,
                                      const gpu::ShaderSource& source);

template <class T>
gpu::Buffer make_buffer(gpu::Device& device, gpu::BufferUsage usage,
                        const std::vector<T>& contents) {
    return make_buffer_of_bytes(device, usage, std::as_bytes(std::span(contents)));
}

}  // namespace gnomon::conformance
