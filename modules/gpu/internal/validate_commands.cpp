// SPDX-License-Identifier: MIT
#include "internal/validate_commands.hpp"

#include <array>
#include <limits>
#include <variant>

#include "internal/validate_draws.hpp"
#include "internal/validate_passes.hpp"
#include "internal/validate_transfers.hpp"
#include "internal/violations.hpp"

namespace gnomon::gpu {

namespace {

// In the order of Command's alternatives.
constexpr std::array<const char*, std::variant_size_v<Command>> function_names = {
    "begin_render_pass",     "end",
    "set_pipeline",          "set_bind_group",
    "set_vertex_buffer",     "set_index_buffer",
    "set_stencil_reference", "set_blend_constant",
    "set_viewport",          "set_scissor_rect",
    "set_depth_bounds",      "draw",
    "draw_indexed",          "begin_occlusion_query",
    "end_occlusion_query",   "push_debug_group",
    "pop_debug_group",       "copy_buffer_to_buffer"};

constexpr std::uint32_t no_query = std::numeric_limits<std::uint32_t>::max();

/// One visit over the commands, with the state that a device would have at each of them.
class CommandCheck {
public:
    CommandCheck(const DeviceState& device, const CommandBuffer& commands)
        : device_(device),
          commands_(commands),
          violations_(commands),
          draws_(device, violations_) {}

    Status run(const std::vector<std::string>& misuse) {
        for (const std::string& sentence : misuse) violations_.add("{}", sentence);
        for (std::size_t i = 0; i < commands_.commands.size(); ++i) {
            const Command& command = commands_.commands[i];
            violations_.at(i, function_names[command.index()], pass_);
            std::visit([this](const auto& c) { check(c); }, command);
        }
        violations_.at(commands_.commands.size(), nullptr, nullptr);
        if (pass_ != nullptr) {
            violations_.add("{} has not ended.", object_name("RenderPass", pass_->label));
        }
        close_debug_groups(debug_groups_);
        return violations_.status();
    }

private:
    void check(const cmd::BeginRenderPass& command) {
        const RenderPassDesc& desc = commands_.passes[command.pass];
        if (pass_ != nullptr) {
            violations_.add("{} begins before {} has ended.", object_name("RenderPass", desc.label),
                            object_name("RenderPass", pass_->label));
            ++nested_passes_;
            return;
        }
        pass_ = &desc;
        violations_.enter(pass_);
        draws_.begin_pass(validate_pass(device_, desc, violations_));
        pass_debug_groups_ = 0;
        open_query_ = no_query;
        used_queries_.assign(draws_.targets().occlusion_queries, false);
    }

    void check(const cmd::EndRenderPass&) {
        if (nested_passes_ > 0) {
            --nested_passes_;
            return;
        }
        if (!inside_pass()) return;
        if (open_query_ != no_query) {
            violations_.add("The occlusion query {} has not ended.", open_query_);
        }
        close_debug_groups(pass_debug_groups_);
        pass_ = nullptr;
    }

    void check(const cmd::SetPipeline& command) {
        if (inside_pass()) draws_.set_pipeline(command);
    }
    void check(const cmd::SetBindGroup& command) {
        if (inside_pass()) draws_.set_bind_group(command);
    }
    void check(const cmd::SetVertexBuffer& command) {
        if (inside_pass()) draws_.set_vertex_buffer(command);
    }
    void check(const cmd::SetIndexBuffer& command) {
        if (inside_pass()) draws_.set_index_buffer(command);
    }
    void check(const cmd::Draw& command) {
        if (inside_pass()) draws_.draw(command);
    }
    void check(const cmd::DrawIndexed& command) {
        if (inside_pass()) draws_.draw_indexed(command);
    }

    void check(const cmd::SetStencilReference& command) {
        if (inside_pass() && command.reference > 0xFF) {
            violations_.add("The stencil reference ({}) exceeds 255.", command.reference);
        }
    }

    void check(const cmd::SetBlendConstant&) { inside_pass(); }

    void check(const cmd::SetViewport& v) {
        if (!inside_pass()) return;
        const PassTargets& targets = draws_.targets();
        // In double, where sums of floats are exact enough not to reject a viewport that fits.
        const bool within = v.x >= 0.0F && v.y >= 0.0F && v.width > 0.0F && v.height > 0.0F &&
                            double{v.x} + double{v.width} <= targets.width &&
                            double{v.y} + double{v.height} <= targets.height;
        if (targets.complete && !within) {
            violations_.add(
                "The viewport (x {}, y {}, width {}, height {}) is empty or not within "
                "the attachments ({} x {}).",
                v.x, v.y, v.width, v.height, targets.width, targets.height);
        }
        if (!(v.min_depth >= 0.0F && v.min_depth <= v.max_depth && v.max_depth <= 1.0F)) {
            violations_.add(
                "The depth range of the viewport ({} to {}) is not an interval within "
                "0 and 1.",
                v.min_depth, v.max_depth);
        }
    }

    void check(const cmd::SetScissorRect& s) {
        if (!inside_pass()) return;
        const PassTargets& targets = draws_.targets();
        if (targets.complete && (!range_fits(s.x, s.width, targets.width) ||
                                 !range_fits(s.y, s.height, targets.height))) {
            violations_.add(
                "The scissor rectangle (x {}, y {}, width {}, height {}) is not within "
                "the attachments ({} x {}).",
                s.x, s.y, s.width, s.height, targets.width, targets.height);
        }
    }

    void check(const cmd::SetDepthBounds& bounds) {
        if (!inside_pass()) return;
        if (!device_.caps().features.depth_bounds) {
            violations_.add("The adapter has no depth bounds.");
        }
        if (!(bounds.min >= 0.0F && bounds.min <= bounds.max && bounds.max <= 1.0F)) {
            violations_.add("The depth bounds ({} to {}) are not an interval within 0 and 1.",
                            bounds.min, bounds.max);
        }
    }

    void check(const cmd::BeginOcclusionQuery& command) {
        if (!inside_pass()) return;
        const std::uint32_t count = draws_.targets().occlusion_queries;
        if (!pass_->occlusion_query_set) {
            violations_.add("The pass has no occlusion query set.");
        } else if (open_query_ != no_query) {
            violations_.add("The occlusion query {} begins before the query {} has ended.",
                            command.index, open_query_);
            return;
        } else if (command.index >= count) {
            violations_.add("The occlusion query index ({}) is not below the count ({}) of {}.",
                            command.index, count, device_.name(pass_->occlusion_query_set));
        } else if (used_queries_[command.index]) {
            violations_.add("The occlusion query {} is used twice in the pass.", command.index);
        } else {
            used_queries_[command.index] = true;
        }
        open_query_ = command.index;
    }

    void check(const cmd::EndOcclusionQuery&) {
        if (!inside_pass()) return;
        if (open_query_ == no_query) violations_.add("No occlusion query has begun.");
        open_query_ = no_query;
    }

    void check(const cmd::PushDebugGroup&) {
        ++(pass_ != nullptr ? pass_debug_groups_ : debug_groups_);
    }

    void check(const cmd::PopDebugGroup&) {
        std::uint32_t& groups = pass_ != nullptr ? pass_debug_groups_ : debug_groups_;
        if (groups == 0) {
            violations_.add("There is no debug group to pop.");
        } else {
            --groups;
        }
    }

    void check(const cmd::CopyBufferToBuffer& c) {
        if (pass_ != nullptr) violations_.add("A copy cannot happen inside of a render pass.");
        if (c.source == c.destination && c.source) {
            violations_.add("{} is both source and destination.", device_.name(c.source));
        }
        if (c.size % 4 != 0) violations_.add("The size ({}) is not a multiple of 4.", c.size);
        copy_range(c.source, BufferUsage::CopySrc, "source", c.source_offset, c.size);
        copy_range(c.destination, BufferUsage::CopyDst, "destination", c.destination_offset,
                   c.size);
    }

    void copy_range(BufferId id, BufferUsage usage, const char* role, std::uint64_t offset,
                    std::uint64_t size) {
        const BufferDesc* buffer = device_.find(id);
        if (buffer == nullptr) {
            violations_.add("{}", device_.absence(id));
            return;
        }
        if (!has(buffer->usage, usage)) {
            violations_.add("The usage ({}) of {} lacks {}.", to_text(buffer->usage),
                            device_.name(id), to_text(usage));
        }
        if (offset % 4 != 0) {
            violations_.add("The {} offset ({}) is not a multiple of 4.", role, offset);
        }
        if (!range_fits(offset, size, buffer->size)) {
            violations_.add("The {} range (offset {}, size {}) does not fit in {} (size {}).", role,
                            offset, size, device_.name(id), buffer->size);
        }
    }

    bool inside_pass() {
        if (pass_ == nullptr) violations_.add("The command is outside of a render pass.");
        return pass_ != nullptr;
    }

    void close_debug_groups(std::uint32_t open) {
        if (open > 0)
            violations_.add("The number of debug groups that are still open is {}.", open);
    }

    const DeviceState& device_;
    const CommandBuffer& commands_;
    Violations violations_;
    DrawCheck draws_;
    const RenderPassDesc* pass_ = nullptr;
    std::uint32_t nested_passes_ = 0;
    std::uint32_t debug_groups_ = 0;
    std::uint32_t pass_debug_groups_ = 0;
    std::uint32_t open_query_ = no_query;
    std::vector<bool> used_queries_;
};

}  // namespace

Status validate_commands(const DeviceState& device, const CommandBuffer& commands,
                         const std::vector<std::string>& misuse) {
    return CommandCheck(device, commands).run(misuse);
}

}  // namespace gnomon::gpu
