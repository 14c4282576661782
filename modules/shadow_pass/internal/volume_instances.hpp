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

/// Products in double, rounded once: the scene must be drawn with these very bits.
[[nodiscard]] VolumeInstance instance_of(const shadows::VolumeDraw& draw,
                                         const glm::dmat4& clip_from_world);
[[nodiscard]] gpu::VertexBufferLayout instance_layout();

class VolumeInstances {
public:
    explicit VolumeInstances(gpu::Device& device) : device_(&device) {}

    /// Element i is of list.draws[i]. Uploads those that are not what they were, and adds their
    /// size to `uploaded`. Cost: linear in the draws; a matrix product for each that changed.
    Status update(const shadows::DrawList& list, const shadows::View& view,
                  std::uint64_t& uploaded);
    /// Nothing is known to be on the GPU.
    void forget() { sources_.clear(); }

    [[nodiscard]] gpu::BufferId buffer() const { return buffer_; }
    [[nodiscard]] const VolumeInstance& operator[](std::size_t i) const { return instances_[i]; }
    /// Whether the last update() wrote element i.
    [[nodiscard]] bool changed(std::size_t i) const { return changed_[i] != 0; }

private:
    // What an element follows from, under one view.
    struct Source {
        glm::dmat4 world_from_local;
        glm::dmat4 world_from_far;
        glm::vec4 far_offset;
        float far_scale;
    };

    gpu::Device* device_;
    gpu::Buffer buffer_;
    std::size_t capacity_ = 0;
    glm::dmat4 clip_from_world_{0.0};
    std::vector<Source> sources_;
    std::vector<VolumeInstance> instances_;
    std::vector<unsigned char> changed_;
};

}  // namespace gnomon::shadow_pass::internal
