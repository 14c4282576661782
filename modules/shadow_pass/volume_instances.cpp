// SPDX-License-Identifier: MIT
#include "internal/volume_instances.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace gnomon::shadow_pass::internal {

VolumeInstance instance_of(const shadows::VolumeDraw& draw, const glm::dmat4& clip_from_world) {
    return instance_of(
        {draw.world_from_local, draw.world_from_far, draw.extrusion.offset, draw.extrusion.scale},
        clip_from_world);
}

VolumeInstance instance_of(const InstanceSource& source, const glm::dmat4& clip_from_world) {
    return {glm::mat4(clip_from_world * source.world_from_near),
            glm::mat4(clip_from_world * source.world_from_far), source.far_offset,
            source.far_scale};
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

void VolumeInstances::number(const shadows::DrawList& list) {
    first_slabs_.resize(list.draws.size());
    std::size_t next = list.draws.size();
    for (std::size_t i = 0; i < list.draws.size(); ++i) {
        first_slabs_[i] = static_cast<std::uint32_t>(next);
        next += list.draws[i].slabs.size();
    }
    count_ = next;
}

void VolumeInstances::renew(std::size_t i, const InstanceSource& source) {
    if (i < known_ && sources_[i] == source) return;
    sources_[i] = source;
    instances_[i] = instance_of(source, clip_from_world_);
    changed_[i] = 1;
}

Status VolumeInstances::make_room() {
    if (count_ <= capacity_) return {};
    capacity_ = 0;
    sources_.clear();
    const std::size_t wanted = count_ + count_ / 2;
    auto buffer =
        device_->create_buffer({.label = "shadow volume matrices",
                                .size = wanted * sizeof(VolumeInstance),
                                .usage = gpu::BufferUsage::Vertex | gpu::BufferUsage::CopyDst});
    if (!buffer) return forward_error(buffer);
    buffer_ = std::move(*buffer);
    capacity_ = wanted;
    return {};
}

Status VolumeInstances::update(const shadows::DrawList& list, const shadows::View& view,
                               std::uint64_t& uploaded) {
    number(list);
    changed_.assign(count_, 0);
    if (count_ == 0) return {};
    const glm::dmat4 clip_from_world = view.clip_from_world();
    if (clip_from_world != clip_from_world_) sources_.clear();
    clip_from_world_ = clip_from_world;
    if (const Status made = make_room(); !made) return made;
    known_ = std::min(sources_.size(), count_);
    sources_.resize(count_);
    instances_.resize(count_);
    for (std::size_t i = 0; i < list.draws.size(); ++i) {
        const shadows::VolumeDraw& draw = list.draws[i];
        const shadows::Extrusion& far = draw.extrusion;
        renew(i, {draw.world_from_local, draw.world_from_far, far.offset, far.scale});
        for (std::size_t k = 0; k < draw.slabs.size(); ++k) {
            const shadows::VolumeSlab& slab = draw.slabs[k];
            renew(first_slabs_[i] + k,
                  {slab.world_from_near, slab.world_from_far, far.offset, far.scale});
        }
    }
    // A few that did not change cost less to write than another call.
    constexpr std::size_t worth_a_call = 16;
    for (std::size_t i = 0; i < count_; ++i) {
        if (changed_[i] == 0) continue;
        std::size_t last = i;
        for (std::size_t j = i + 1; j < count_ && j <= last + worth_a_call; ++j) {
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
