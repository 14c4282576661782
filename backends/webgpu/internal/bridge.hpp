// SPDX-License-Identifier: MIT
//
// Bridge: what the C++ half needs of the JavaScript half. In a browser it is bridge.js; tests of
// what is written down put a recorder in its place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <gnomon/gpu/types.hpp>

namespace gnomon::webgpu {

/// Kinds of objects, numbered as bridge.js numbers them.
enum class Kind : std::uint32_t {
    Buffer,
    Texture,
    Sampler,
    Shader,
    BindGroupLayout,
    BindGroup,
    RenderPipeline,
    QuerySet,
};

/// What became of a call, as bridge.js says it.
enum class Outcome : std::uint32_t { Done, Unsupported, OutOfMemory, DeviceLost, Internal };

class Bridge {
public:
    virtual ~Bridge() = default;

    /// The device in JSON: adapter, features, limits. Empty where there is none.
    virtual std::string describe() = 0;
    /// What the last outcome but Done means.
    virtual std::string error() = 0;
    /// The oldest complaint of the device that was not taken yet; empty where there is none.
    virtual std::string take_message() = 0;

    virtual Outcome create(Kind kind, std::uint32_t index, std::string_view description) = 0;
    virtual void destroy(Kind kind, std::uint32_t index) = 0;

    virtual Outcome write_buffer(std::uint32_t index, std::uint64_t offset,
                                 std::span<const std::byte> bytes) = 0;
    virtual Outcome write_texture(std::uint32_t index, std::uint32_t mip_level,
                                  std::span<const std::byte> bytes) = 0;
    virtual Outcome submit(std::span<const std::uint32_t> words) = 0;
    virtual Outcome present(std::uint32_t index) = 0;

    // These wait.
    virtual Outcome wait_idle() = 0;
    virtual Outcome read_buffer(std::uint32_t index, std::uint64_t offset,
                                std::span<std::byte> bytes) = 0;
    virtual Outcome read_texture(std::uint32_t index, gpu::Aspect aspect,
                                 std::span<std::byte> bytes) = 0;
    virtual Outcome read_query_set(std::uint32_t index, std::span<std::uint64_t> values) = 0;
};

}  // namespace gnomon::webgpu
