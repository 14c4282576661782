// SPDX-License-Identifier: MIT
#include "internal/adapter.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace gnomon::webgpu {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 4> optional_features{"depth-clip-control", "timestamp-query",
                                                            "multisample", "sampled-stencil"};

bool contains(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

Result<gpu::Caps> read_caps(std::string_view description,
                            const std::vector<std::string>& disabled_features) {
    for (const std::string& name : disabled_features) {
        if (std::find(optional_features.begin(), optional_features.end(), name) ==
            optional_features.end()) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("'{}' cannot be disabled: the known features are {}.", name,
                                    fmt::join(optional_features, ", ")));
        }
    }
    if (description.empty()) {
        return fail(ErrorCode::Unsupported,
                    "There is no WebGPU device: the page has put no bridge into "
                    "Module.gnomonBridge.");
    }
    const Json json = Json::parse(description, nullptr, false);
    if (!json.is_object() || !json.contains("features") || !json.contains("limits")) {
        return fail(ErrorCode::Internal,
                    "What the bridge says of the WebGPU device has no features and limits.");
    }
    const Json& features = json["features"];
    const auto has = [&](std::string_view name) {
        return std::find(features.begin(), features.end(), name) != features.end() &&
               !contains(disabled_features, name);
    };
    if (!has("depth32float-stencil8")) {
        return fail(ErrorCode::Unsupported,
                    "The WebGPU adapter lacks depth32float-stencil8, and WebGPU has no other "
                    "depth-stencil format whose depth can be relied on.");
    }
    gpu::Caps caps;
    caps.backend = "webgpu";
    caps.adapter = json.value("adapter", "unnamed");
    caps.stencil_path = "native";
    caps.features.unclipped_depth = has("depth-clip-control");
    caps.features.timestamp_query = has("timestamp-query");
    // WebGPU promises no more of occlusion queries than zero or not.
    caps.features.occlusion_query = false;
    caps.features.depth32float_stencil8 = true;
    caps.features.multisample_4 = !contains(disabled_features, "multisample");
    caps.features.multisample_32bit = false;
    caps.features.sample_shading = true;
    caps.features.sampled_stencil = !contains(disabled_features, "sampled-stencil");
    caps.features.exact_clip_space = true;

    const Json& limits = json["limits"];
    const auto limit = [&](const char* name) { return limits.value(name, std::uint64_t{0}); };
    const auto small = [&](const char* name) {
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(limit(name), UINT32_MAX));
    };
    caps.limits.max_texture_dimension_2d = small("maxTextureDimension2D");
    caps.limits.max_color_attachments = small("maxColorAttachments");
    caps.limits.max_vertex_buffers = small("maxVertexBuffers");
    caps.limits.max_vertex_attributes = small("maxVertexAttributes");
    caps.limits.max_buffer_size = limit("maxBufferSize");
    caps.limits.max_uniform_buffer_binding_size = limit("maxUniformBufferBindingSize");
    caps.limits.min_uniform_buffer_offset_alignment = small("minUniformBufferOffsetAlignment");
    return caps;
}

}  // namespace gnomon::webgpu
