// SPDX-License-Identifier: MIT
//
// Backend: what a graphics API has to provide. It is a translator, not an architecture: everything
// that arrives here has been validated by the Device in front, so a backend reports only what the
// front end cannot know (the driver refuses, memory runs out, the device is lost). Ids come from
// the front end; a backend keeps a table indexed by Id::index and never invents names.
// docs/backends.md is the checklist for writing one.
#pragma once

#include <any>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/caps.hpp>
#include <gnomon/gpu/command.hpp>
#include <gnomon/gpu/descriptors.hpp>

#pragma GCC visibility push(default)
namespace gnomon::gpu {

/// A texture that the host made, in words of the backend's own: gl::HostTarget, vk::HostImage.
using NativeTexture = std::any;

/// What a graphics API has to do. All that arrives is valid.
class Backend {
public:
    virtual ~Backend() = default;

    /// Decided when it was made; never changes.
    [[nodiscard]] virtual const Caps& caps() const = 0;

    virtual Status create_buffer(BufferId, const BufferDesc&) = 0;  ///< contents start as zero
    /// Contents start as zero.
    virtual Status create_texture(TextureId, const TextureDesc&) = 0;
    /// Names what the host made, which stays the host's: destroy() frees the name alone.
    virtual Status import_texture(TextureId, const TextureDesc& desc, const NativeTexture&) {
        return fail(ErrorCode::Unsupported, "[Texture \"" + desc.label +
                                                "\"] cannot be imported: this backend (" +
                                                caps().backend + ") adopts no textures.");
    }
    /// In which clip space what is drawn into the texture lies.
    [[nodiscard]] virtual ClipDepth clip_depth(TextureId) const { return ClipDepth::ZeroToOne; }
    /// Whether a pass with this depth-stencil can have colour attachments; Unsupported otherwise,
    /// with the reason. Only a texture of a host's may not.
    [[nodiscard]] virtual Status takes_colors_beside(TextureId) const { return {}; }
    /// Filters and address modes of textures.
    virtual Status create_sampler(SamplerId, const SamplerDesc&) = 0;
    /// Both languages are there; a backend takes the one it reads.
    virtual Status create_shader(ShaderId, const ShaderDesc&) = 0;
    /// What a group holds.
    virtual Status create_bind_group_layout(BindGroupLayoutId, const BindGroupLayoutDesc&) = 0;
    /// Buffers and textures of a group.
    virtual Status create_bind_group(BindGroupId, const BindGroupDesc&) = 0;
    /// State and shaders.
    virtual Status create_render_pipeline(RenderPipelineId, const RenderPipelineDesc&) = 0;
    /// Places for what is counted.
    virtual Status create_query_set(QuerySetId, const QuerySetDesc&) = 0;

    /// The object may still be in use by work that was submitted: a backend keeps it until that is
    /// done.
    virtual void destroy(BufferId) = 0;
    /// Likewise, as all destroy().
    virtual void destroy(TextureId) = 0;
    /// Likewise.
    virtual void destroy(SamplerId) = 0;
    /// Likewise.
    virtual void destroy(ShaderId) = 0;
    /// Likewise.
    virtual void destroy(BindGroupLayoutId) = 0;
    /// Likewise.
    virtual void destroy(BindGroupId) = 0;
    /// Likewise.
    virtual void destroy(RenderPipelineId) = 0;
    /// Likewise.
    virtual void destroy(QuerySetId) = 0;

    /// Queue order: seen by everything submitted later, by nothing submitted before.
    virtual Status write_buffer(BufferId, std::uint64_t offset, std::span<const std::byte>) = 0;
    /// A whole mip level, rows tightly packed, row 0 on top.
    virtual Status write_texture(TextureId, std::uint32_t mip_level,
                                 std::span<const std::byte>) = 0;

    /// Runs a command list, in order.
    virtual Status submit(const CommandBuffer&) = 0;
    /// Blocks until the device has finished everything submitted.
    virtual Status wait_idle() = 0;

    // Reading back blocks. Sizes of the spans are right.
    /// Blocks until the device is done. The span has the size that is read.
    virtual Status read_buffer(BufferId, std::uint64_t offset, std::span<std::byte>) = 0;
    /// Mip level 0 of a single-sampled texture, rows tightly packed, row 0 on top.
    virtual Status read_texture(TextureId, Aspect, std::span<std::byte>) = 0;
    /// All values, samples or nanoseconds; blocks.
    virtual Result<std::vector<std::uint64_t>> read_query_set(QuerySetId) = 0;

    /// Copies a colour texture onto the window, stretched to its size. Unsupported where there is
    /// no window.
    virtual Status present(TextureId) = 0;
};

}  // namespace gnomon::gpu
#pragma GCC visibility pop
