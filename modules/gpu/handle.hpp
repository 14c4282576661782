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

namespace gnomon::gpu {

template <class Tag>
struct Id {
    std::uint32_t index = 0;
    std::uint32_t generation = 0;  ///< 0: names nothing

    [[nodiscard]] explicit operator bool() const { return generation != 0; }
    auto operator<=>(const Id&) const = default;
};

struct BufferTag;
struct TextureTag;
struct SamplerTag;
struct ShaderTag;
struct BindGroupLayoutTag;
struct BindGroupTag;
struct RenderPipelineTag;
struct QuerySetTag;

using BufferId = Id<BufferTag>;
using TextureId = Id<TextureTag>;
using SamplerId = Id<SamplerTag>;
using ShaderId = Id<ShaderTag>;
using BindGroupLayoutId = Id<BindGroupLayoutTag>;
using BindGroupId = Id<BindGroupTag>;
using RenderPipelineId = Id<RenderPipelineTag>;
using QuerySetId = Id<QuerySetTag>;

class DeviceState;  // the device's tables; owners hold it weakly, so that they may outlive the
                    // device

/// Sole owner of a GPU object; move-only. Converts to the id it owns.
template <class Tag>
class Owned {
public:
    Owned() = default;
    Owned(std::weak_ptr<DeviceState> device, Id<Tag> id) : device_(std::move(device)), id_(id) {}
    Owned(Owned&& other) noexcept
        : device_(std::move(other.device_)), id_(std::exchange(other.id_, {})) {}
    Owned& operator=(Owned&& other) noexcept {
        if (this != &other) {
            reset();
            device_ = std::move(other.device_);
            id_ = std::exchange(other.id_, {});
        }
        return *this;
    }
    ~Owned() { reset(); }

    [[nodiscard]] Id<Tag> id() const { return id_; }
    operator Id<Tag>() const {
        return id_;
    }  // NOLINT(google-explicit-constructor): an owner is used as its id
    [[nodiscard]] explicit operator bool() const { return static_cast<bool>(id_); }

    /// Frees the object now. Does nothing when empty or when the device is gone.
    void reset();

private:
    std::weak_ptr<DeviceState> device_;
    Id<Tag> id_;
};

using Buffer = Owned<BufferTag>;
using Texture = Owned<TextureTag>;
using Sampler = Owned<SamplerTag>;
using Shader = Owned<ShaderTag>;
using BindGroupLayout = Owned<BindGroupLayoutTag>;
using BindGroup = Owned<BindGroupTag>;
using RenderPipeline = Owned<RenderPipelineTag>;
using QuerySet = Owned<QuerySetTag>;

}  // namespace gnomon::gpu
