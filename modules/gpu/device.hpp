// SPDX-License-Identifier: MIT
//
// Device: the front of the GPU interface. It owns the tables of objects, validates every call once
// and hands valid ones to its backend. It is not a scene, not a frame graph and has no window:
// gnomon::gl and gnomon::vk make the backend, headless or for a window.
//
// Threads: one device, one thread at a time. Recording (encoder.hpp) needs no device and may happen
// anywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/backend.hpp>
#include <gnomon/gpu/encoder.hpp>
#include <gnomon/gpu/handle.hpp>

#pragma GCC visibility push(default)
namespace gnomon::gpu {

/// Totals since the device was made. What tests of "nothing is uploaded when nothing moved" read.
struct DeviceCounters {
    std::uint64_t uploaded_bytes = 0;  ///< write_buffer and write_texture
    std::uint64_t draw_calls = 0;      ///< submitted
    std::uint64_t render_passes = 0;   ///< submitted
    std::uint64_t submissions = 0;     ///< calls of submit()
    std::uint64_t objects_alive = 0;   ///< of all kinds; not a total but the present number
};

/// The front of the GPU interface: makes objects, validates every call once, hands valid ones to
/// its backend. One thread at a time.
class Device {
public:
    /// Takes the backend, which gnomon::gl or gnomon::vk makes.
    explicit Device(std::unique_ptr<Backend> backend);
    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;
    ~Device();

    /// Memory, all zero. Here as in all creation: a descriptor that breaks a rule gives
    /// ErrorCode::Validation with a sentence that names the object by its label, the value and the
    /// limit; a driver's refusal gives what the backend says.
    [[nodiscard]] Result<Buffer> create_buffer(const BufferDesc& desc);
    /// A picture, all zero.
    [[nodiscard]] Result<Texture> create_texture(const TextureDesc& desc);
    /// A texture that the host made and keeps: freeing the owner frees the name alone. `desc` says
    /// what it is, `native` which one, in the backend's own words (gl::HostTarget). Its contents
    /// stay; it outlives every use here. ErrorCode::Unsupported where the backend cannot use it,
    /// with a sentence that says what to change.
    [[nodiscard]] Result<Texture> import_texture(const TextureDesc& desc,
                                                 const NativeTexture& native);
    /// How textures are read.
    [[nodiscard]] Result<Sampler> create_sampler(const SamplerDesc& desc);
    /// A shader of one stage; the sources may be freed afterwards.
    [[nodiscard]] Result<Shader> create_shader(const ShaderDesc& desc);
    /// What a shader expects in a group.
    [[nodiscard]] Result<BindGroupLayout> create_bind_group_layout(const BindGroupLayoutDesc& desc);
    /// Buffers and textures that fit a layout; they must outlive every use.
    [[nodiscard]] Result<BindGroup> create_bind_group(const BindGroupDesc& desc);
    /// Shaders and state. Cost: milliseconds, where the driver compiles.
    [[nodiscard]] Result<RenderPipeline> create_render_pipeline(const RenderPipelineDesc& desc);
    /// Places for samples or times.
    [[nodiscard]] Result<QuerySet> create_query_set(const QuerySetDesc& desc);

    /// Queue order: everything submitted later sees it, nothing submitted before. Offset and size
    /// are multiples of 4 bytes. Cost: one copy.
    [[nodiscard]] Status write_buffer(BufferId buffer, std::uint64_t offset,
                                      std::span<const std::byte> data);
    /// A whole mip level of a colour texture, rows tightly packed, row 0 on top.
    [[nodiscard]] Status write_texture(TextureId texture, std::uint32_t mip_level,
                                       std::span<const std::byte> data);

    /// Begins a recording; `label` names it in messages.
    [[nodiscard]] CommandEncoder create_command_encoder(std::string label = {});
    /// Runs a finished command buffer. Fails when an object it names was freed after finish().
    [[nodiscard]] Status submit(const CommandBuffer& commands);
    /// Blocks until the device has finished all that was submitted.
    [[nodiscard]] Status wait_idle();

    // Reading back; blocks until the device is done.
    /// A piece of a buffer, in bytes; blocks until the device is done.
    [[nodiscard]] Result<std::vector<std::byte>> read_buffer(BufferId buffer, std::uint64_t offset,
                                                             std::uint64_t size);
    /// Mip level 0 of a single-sampled texture, rows tightly packed, row 0 on top. Colour comes in
    /// the texture's own format, Aspect::DepthOnly as one float a pixel, Aspect::StencilOnly as one
    /// byte a pixel.
    [[nodiscard]] Result<std::vector<std::byte>> read_texture(TextureId texture,
                                                              Aspect aspect = Aspect::Color);
    /// All values of a query set: samples or nanoseconds.
    [[nodiscard]] Result<std::vector<std::uint64_t>> read_query_set(QuerySetId query_set);

    /// Copies a colour texture onto the window, stretched to its size.
    [[nodiscard]] Status present(TextureId texture);

    /// What a texture was made or imported as; nothing where it is gone or never was.
    [[nodiscard]] std::optional<TextureDesc> desc_of(TextureId texture) const;
    /// In which clip space what is drawn into a texture lies: ZeroToOne but where a host's was
    /// imported that is drawn to otherwise. The texture is alive.
    [[nodiscard]] ClipDepth clip_depth_of(TextureId texture) const;
    /// Whether a render pass with this depth-stencil can have colour attachments as well:
    /// ErrorCode::Unsupported and the reason where a host's was imported that cannot. The texture
    /// is alive.
    [[nodiscard]] Status takes_colors_beside(TextureId depth_stencil) const;
    /// What the adapter is and can do.
    [[nodiscard]] const Caps& caps() const;
    /// Totals so far.
    [[nodiscard]] DeviceCounters counters() const;

private:
    std::shared_ptr<DeviceState> state_;
};

}  // namespace gnomon::gpu
#pragma GCC visibility pop
