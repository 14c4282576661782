// SPDX-License-Identifier: MIT
//
// Stage: what all techniques draw on: the scene's geometry on the device, its depth, and a mask for
// each light. Nothing of it belongs to one technique, so that they are compared on equal terms.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include <gnomon/gpu/device.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/view.hpp>

namespace gnomon::report::internal {

/// A frame of the motion, as every technique sees it.
struct Moment {
    const scene::Scene* scene = nullptr;
    shadows::View view;
    std::vector<shadows::Light> lights;  ///< ascending by key
};

struct GpuGeometry {
    gpu::Buffer positions;
    gpu::Buffer indices;
    std::uint32_t index_count = 0;
    scene::Bounds bounds = {};  ///< in its own space
};

/// A posed mesh.
struct StageInstance {
    const GpuGeometry* geometry = nullptr;
    glm::dmat4 world_from_local{1.0};
    bool casts = false;
    bool receives = false;
};

/// Reversed: 1 near, 0 far. Forward is what most text books have.
enum class DepthRange : std::uint8_t { Reversed, Forward };

/// Matrices for draws, 256 bytes each, and the bind groups that reach them.
class DrawMatrices {
public:
    void clear() { bytes_.clear(); }
    /// Its dynamic offset.
    std::uint32_t add(const glm::mat4& clip_from_local, const glm::mat4& light_from_local);
    [[nodiscard]] Status upload(gpu::Device& device, gpu::BindGroupLayoutId layout);
    [[nodiscard]] gpu::BindGroupId group() const { return group_; }

private:
    std::vector<std::byte> bytes_;
    gpu::Buffer buffer_;
    gpu::BindGroup group_;
    std::uint64_t size_ = 0;
};

class Stage {
public:
    static Result<std::unique_ptr<Stage>> create(gpu::Device& device, std::uint32_t width,
                                                 std::uint32_t height);

    /// Everything that has a mesh. Vertices are read once: motions here are of poses alone.
    Status upload(const scene::Scene& scene);
    Status ensure_masks(std::size_t lights);
    /// Made when first asked for.
    Result<gpu::TextureId> depth_stencil(gpu::Format format);
    Result<gpu::TextureId> shadow_map(std::uint32_t width, std::uint32_t height);
    Result<gpu::RenderPipelineId> depth_pipeline(gpu::Format format, DepthRange range);

    [[nodiscard]] std::vector<StageInstance> instances(const scene::Scene& scene) const;
    /// Records the scene's depth; `offsets` are those of the receivers among `instances`.
    void record_depth(gpu::CommandEncoder& encoder, gpu::RenderPipelineId pipeline,
                      gpu::TextureId depth_stencil, DepthRange range,
                      std::span<const StageInstance> instances, const DrawMatrices& matrices,
                      std::span<const std::uint32_t> offsets) const;
    static void draw(gpu::RenderPassEncoder& pass, const StageInstance& instance,
                     gpu::BindGroupId group, std::uint32_t offset);

    [[nodiscard]] gpu::Device& device() const { return *device_; }
    [[nodiscard]] gpu::TextureId mask(std::size_t light) const { return masks_[light]; }
    [[nodiscard]] gpu::BindGroupLayoutId draw_layout() const { return draw_layout_; }
    [[nodiscard]] gpu::ShaderId positions() const { return positions_; }
    [[nodiscard]] gpu::ShaderId full_screen() const { return full_screen_; }
    [[nodiscard]] gpu::ShaderId white() const { return white_; }
    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    static gpu::VertexBufferLayout position_layout() {
        return {.array_stride = 12, .attributes = {{.shader_location = 0}}};
    }

    /// Clears a mask and waits: what a frame takes in which nothing is drawn.
    [[nodiscard]] Status draw_nothing();

    /// The masks as they are: one byte a pixel, 0 where lit.
    [[nodiscard]] Result<std::vector<std::vector<std::uint8_t>>> read_masks(std::size_t lights);

private:
    gpu::Device* device_ = nullptr;
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    gpu::BindGroupLayout draw_layout_;
    gpu::Shader positions_;
    gpu::Shader full_screen_;
    gpu::Shader white_;
    std::vector<gpu::Texture> masks_;
    std::map<gpu::Format, gpu::Texture> depth_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, gpu::Texture> maps_;
    std::map<std::pair<gpu::Format, DepthRange>, gpu::RenderPipeline> depth_pipelines_;
    std::map<std::uint64_t, GpuGeometry> geometry_;  // by entity
};

inline constexpr gpu::Format mask_format = gpu::Format::R8Unorm;

}  // namespace gnomon::report::internal
