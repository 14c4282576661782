// SPDX-License-Identifier: MIT
#include "internal/volume_instances.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace gnomon::shadow_pass::internal {

VolumeInstance instance_of(const shadows::VolumeDraw& draw, const glm::dmat4& clip_from_world) {
    return {glm::mat4(clip_from_world * draw.world_from_local),
            glm::mat4(clip_from_world * draw.world_from_far), draw.extrusion.offset,
            draw.extrusion.scale};
}

gpu::VertexBufferLayout instance_layout() {
    gpu::VertexBufferLayout layout{.array_stride = sizeof(VolumeInstance),
                                   .step_mode = gpu::VertexStepMode::Instance};
    // Two matrices of four columns, and the offset.
    for (std::uint32_t i = 0; i < 9; ++i) {
        layout.attributes.push_back({.format = gpu::VertexFormat::Float32x4,
                                     .offset = i * sizeof(glm::vec4),
                                     .shader_location = 1 + i});
    }
    layout.attributes.push_back({.format = gpu::VertexFormat::Float32,
                                 .offset = offsetof(VolumeInstance, far_scale),
                                 .shader_location = 10});
    return layout;
}

Status VolumeInstances::update(const shadows::DrawList& list, const shadows::View& view,
                               std::uint64_t& uploaded) {
    const std::size_t count = list.draws.size();
    changed_.assign(count, 0);
    if (count == 0) return {};
    const glm::dmat4 clip_from_world = view.clip_from_world();
    if (clip_from_world != clip_from_world_) sources_.clear();
    clip_from_world_ = clip_from_world;
    if (count > capacity_) {
        capacity_ = 0;
        sources_.clear();
        const std::size_t wanted = count + count / 2;
        auto buffer =
            device_->create_buffer({.label = "shadow volume matrices",
                                    .size = wanted * sizeof(VolumeInstance),
                                    .usage = gpu::BufferUsage::Vertex | gpu::BufferUsage::CopyDst});
        if (!buffer) return forward_error(buffer);
        buffer_ = std::move(*buffer);
        capacity_ = wanted;
    }
    const std::size_t known = std::min(sources_.size(), count);
    sources_.resize(count);
    instances_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const shadows::VolumeDraw& draw = list.draws[i];
        Source& source = sources_[i];
        if (i < known && source.world_from_local == draw.world_from_local &&
            source.world_from_far == draw.world_from_far &&
            source.far_offset == draw.extrusion.offset &&
            source.far_scale == draw.extrusion.scale) {
            continue;
        }
        source = {draw.world_from_local, draw.world_from_far, draw.extrusion.offset,
                  draw.extrusion.scale};
        instances_[i] = instance_of(draw, clip_from_world);
        changed_[i] = 1;
    }
    // A few that did not change cost less to write than another call.
    constexpr std::size_t worth_a_call = 16;
    for (std::size_t i = 0; i < count; ++i) {
        if (changed_[i] == 0) continue;
        std::size_t last = i;
        for (std::size_t j = i + 1; j < count && j <= last + worth_a_call; ++j) {
            if (changed_[j] != 0) last = j;
        }
        const auto bytes = std::as_bytes(std::span(instances_).subspan(i, last - i + 1));
        if (const Status written =
                device_->write_buffer(buffer_, i * sizeof(VolumeInstance), bytes);
            !written) {
            sources_.clear();
            return written;
        }
        uploaded += bytes.size();
        i = last;
    }
    return {};
}

}  // namespace gnomon::shadow_pass::internal
