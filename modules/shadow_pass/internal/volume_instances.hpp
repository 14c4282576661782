// SPDX-License-Identifier: MIT
//
// VolumeInstances: what one draw's vertices share (matrices, and where far vertices are), an
// element a draw of one buffer that steps by instance. A draw names its element by first_instance,
// so that nothing has to be bound between two of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/shadows/view.hpp>

namespace gnomon::shadow_pass::internal {

/// As the shaders have it, behind the vertex's own place: attributes 1 to 10.
struct VolumeInstance {
    glm::mat4 clip_from_local;
    glm::mat4 clip_from_far;
    glm::vec4 far_offset;
    float far_scale;
};
static_assert(sizeof(VolumeInstance) == 148);

/// What an element follows from, under one view.
struct InstanceSource {
    glm::dmat4 world_from_near;
    glm::dmat4 world_from_far;
    glm::vec4 far_offset;
    float far_scale;
    bool operator==(const InstanceSource&) const = default;
};

/// Products in double, rounded once: the scene must be drawn with these very bits.
[[nodiscard]] VolumeInstance instance_of(const InstanceSource& source,
                                         const glm::dmat4& clip_from_world);
/// Of a volume as a whole.
[[nodiscard]] VolumeInstance instance_of(const shadows::VolumeDraw& draw,
                                         const glm::dmat4& clip_from_world);
[[nodiscard]] gpu::VertexBufferLayout instance_layout();

class VolumeInstances {
public:
    explicit VolumeInstances(gpu::Device& device) : device_(&device) {}

    /// Element i is of list.draws[i] as a whole; behind all of these come those of slabs. Uploads
    /// those that are not what they were, and adds their size to `uploaded`. Cost: linear in the
    /// draws; a matrix product for each that changed.
    Status update(const shadows::DrawList& list, const shadows::View& view,
                  std::uint64_t& uploaded);
    /// Of the first of VolumeDraw::slabs of draw i; the others follow.
    [[nodiscard]] std::uint32_t first_slab(std::size_t i) const { return first_slabs_[i]; }
    /// Nothing is known to be on the GPU.
    void forget() { sources_.clear(); }

    [[nodiscard]] gpu::BufferId buffer() const { return buffer_; }
    [[nodiscard]] const VolumeInstance& operator[](std::size_t i) const { return instances_[i]; }
    /// Whether the last update() wrote element i.
    [[nodiscard]] bool changed(std::size_t i) const { return changed_[i] != 0; }

private:
    void number(const shadows::DrawList& list);
    void renew(std::size_t i, const InstanceSource& source);
    Status make_room();

    gpu::Device* device_;
    gpu::Buffer buffer_;
    std::size_t capacity_ = 0;
    glm::dmat4 clip_from_world_{0.0};
    std::size_t count_ = 0;
    std::size_t known_ = 0;  // of sources_, from the last time
    std::vector<std::uint32_t> first_slabs_;
    std::vector<InstanceSource> sources_;
    std::vector<VolumeInstance> instances_;
    std::vector<unsigned char> changed_;
};

}  // namespace gnomon::shadow_pass::internal
