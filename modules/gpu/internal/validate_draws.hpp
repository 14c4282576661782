// SPDX-License-Identifier: MIT
//
// DrawCheck: what a pass has set, and whether a draw may use it. What depends on the state alone is
// looked at once per change of state, so that a draw costs a few comparisons.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "internal/device_state.hpp"
#include "internal/validate_passes.hpp"
#include "internal/violations.hpp"

namespace gnomon::gpu {

class DrawCheck {
public:
    DrawCheck(const DeviceState& device, Violations& violations);

    void begin_pass(PassTargets targets);
    [[nodiscard]] const PassTargets& targets() const { return targets_; }

    void set_pipeline(const cmd::SetPipeline& command);
    void set_bind_group(const cmd::SetBindGroup& command);
    void set_vertex_buffer(const cmd::SetVertexBuffer& command);
    void set_index_buffer(const cmd::SetIndexBuffer& command);
    void draw(const cmd::Draw& command);
    void draw_indexed(const cmd::DrawIndexed& command);

private:
    static constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

    // `given` without a record: it was wrong when it was set, and that was said there.
    struct Pipeline {
        bool given = false;
        const RenderPipelineRecord* record = nullptr;
    };
    struct Group {
        bool given = false;
        const BindGroupRecord* record = nullptr;
    };
    struct Bytes {
        bool given = false;
        std::uint64_t available = unlimited;
    };

    void match_targets(const RenderPipelineRecord& pipeline);
    void check_dynamic_offsets(const cmd::SetBindGroup& command, const BindGroupRecord& group);
    /// False when there is no pipeline to draw with. Otherwise groups and vertex buffers have been
    /// looked at since they last changed.
    bool prepare_draw();
    void match_groups();
    void measure_vertex_buffers();
    void check_range(std::uint64_t first, std::uint64_t count, std::uint64_t available,
                     const char* what);

    const DeviceState& device_;
    Violations& violations_;
    PassTargets targets_;
    Pipeline pipeline_;
    std::array<Group, max_bind_groups> groups_;
    std::vector<Bytes> vertex_buffers_;
    Bytes index_buffer_;
    std::uint64_t index_bytes_ = 4;
    bool groups_changed_ = true;
    bool vertices_changed_ = true;
    std::uint64_t vertices_available_ = unlimited;
    std::uint64_t instances_available_ = unlimited;
};

}  // namespace gnomon::gpu
