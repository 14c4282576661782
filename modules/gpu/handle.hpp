// SPDX-License-Identifier: MIT
//
// Ids and owners of GPU objects. An id is a plain value that lives in descriptors and command
// lists; an owner frees the object when it goes out of scope (a backend keeps it alive until the
// GPU is done with it). The generation in an id catches the use of an object that is gone, by the
// label it had.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <utility>

#pragma GCC visibility push(default)
namespace gnomon::gpu {

/// The name of an object of a device's: a plain value. It owns nothing.
template <class Tag>
struct Id {
    std::uint32_t index = 0;       ///< its place in a table of the device's
    std::uint32_t generation = 0;  ///< 0: names nothing

    /// Whether it names anything, alive or not.
    [[nodiscard]] explicit operator bool() const { return generation != 0; }
    auto operator<=>(const Id&) const = default;
};

struct BufferTag;           ///< tells ids apart: of a buffer
struct TextureTag;          ///< of a texture
struct SamplerTag;          ///< of a sampler
struct ShaderTag;           ///< of a shader
struct BindGroupLayoutTag;  ///< of a bind group layout
struct BindGroupTag;        ///< of a bind group
struct RenderPipelineTag;   ///< of a render pipeline
struct QuerySetTag;         ///< of a query set

using BufferId = Id<BufferTag>;                    ///< names a buffer
using TextureId = Id<TextureTag>;                  ///< names a texture
using SamplerId = Id<SamplerTag>;                  ///< names a sampler
using ShaderId = Id<ShaderTag>;                    ///< names a shader
using BindGroupLayoutId = Id<BindGroupLayoutTag>;  ///< names a bind group layout
using BindGroupId = Id<BindGroupTag>;              ///< names a bind group
using RenderPipelineId = Id<RenderPipelineTag>;    ///< names a render pipeline
using QuerySetId = Id<QuerySetTag>;                ///< names a query set

class DeviceState;  // the device's tables; owners hold it weakly, so that they may outlive the
                    // device

/// Sole owner of a GPU object; move-only. Converts to the id it owns.
template <class Tag>
class Owned {
public:
    Owned() = default;  ///< owns nothing
    /// What the device does; nobody else has anything to own.
    Owned(std::weak_ptr<DeviceState> device, Id<Tag> id) : device_(std::move(device)), id_(id) {}
    /// Takes over; `other` owns nothing afterwards.
    Owned(Owned&& other) noexcept
        : device_(std::move(other.device_)), id_(std::exchange(other.id_, {})) {}
    /// Likewise; what it owned before is freed.
    Owned& operator=(Owned&& other) noexcept {
        if (this != &other) {
            reset();
            device_ = std::move(other.device_);
            id_ = std::exchange(other.id_, {});
        }
        return *this;
    }
    ~Owned() { reset(); }

    /// What it owns.
    [[nodiscard]] Id<Tag> id() const { return id_; }
    /// The same.
    operator Id<Tag>() const {
        return id_;
    }  // NOLINT(google-explicit-constructor): an owner is used as its id
    /// Whether it owns anything.
    [[nodiscard]] explicit operator bool() const { return static_cast<bool>(id_); }

    /// Frees the object now. Does nothing when empty or when the device is gone.
    void reset();

private:
    std::weak_ptr<DeviceState> device_;
    Id<Tag> id_;
};

using Buffer = Owned<BufferTag>;                    ///< owns a buffer
using Texture = Owned<TextureTag>;                  ///< owns a texture
using Sampler = Owned<SamplerTag>;                  ///< owns a sampler
using Shader = Owned<ShaderTag>;                    ///< owns a shader
using BindGroupLayout = Owned<BindGroupLayoutTag>;  ///< owns a bind group layout
using BindGroup = Owned<BindGroupTag>;              ///< owns a bind group
using RenderPipeline = Owned<RenderPipelineTag>;    ///< owns a render pipeline
using QuerySet = Owned<QuerySetTag>;                ///< owns a query set

}  // namespace gnomon::gpu
#pragma GCC visibility pop
