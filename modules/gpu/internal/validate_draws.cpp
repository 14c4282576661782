// SPDX-License-Identifier: MIT
#include "internal/validate_draws.hpp"

#include <algorithm>
#include <utility>

namespace gnomon::gpu {

namespace {

/// Where two different shapes differ first.
std::string difference(const LayoutShape& group, const LayoutShape& pipeline) {
    const auto [own, wanted] = std::ranges::mismatch(group.entries, pipeline.entries);
    const bool own_ended = own == group.entries.end();
    const bool wanted_ended = wanted == pipeline.entries.end();
    if (wanted_ended || (!own_ended && own->binding < wanted->binding)) {
        return fmt::format("The bind group alone has binding {}.", own->binding);
    }
    if (own_ended || wanted->binding < own->binding) {
        return fmt::format("The pipeline alone has binding {}.", wanted->binding);
    }
    return fmt::format("Binding {} differs.", own->binding);
}

}  // namespace

DrawCheck::DrawCheck(const DeviceState& device, Violations& violations)
    : device_(device),
      violations_(violations),
      vertex_buffers_(device.caps().limits.max_vertex_buffers) {}

void DrawCheck::begin_pass(PassTargets targets) {
    targets_ = std::move(targets);
    pipeline_ = {};
    groups_ = {};
    std::ranges::fill(vertex_buffers_, Bytes{});
    index_buffer_ = {};
    groups_changed_ = true;
    vertices_changed_ = true;
}

void DrawCheck::set_pipeline(const cmd::SetPipeline& command) {
    pipeline_ = {true, device_.find(command.pipeline)};
    groups_changed_ = true;
    vertices_changed_ = true;
    if (pipeline_.record == nullptr) {
        violations_.add("{}", device_.absence(command.pipeline));
    } else if (targets_.complete) {
        match_targets(*pipeline_.record);
    }
}

void DrawCheck::match_targets(const RenderPipelineRecord& pipeline) {
    const auto name = [&pipeline] { return object_name("RenderPipeline", pipeline.label); };
    if (pipeline.color_formats != targets_.color_formats) {
        const std::size_t own = pipeline.color_formats.size();
        const std::size_t pass = targets_.color_formats.size();
        if (own != pass) {
            violations_.add(
                "The number of targets ({}) of {} is not the number of color "
                "attachments ({}).",
                own, name(), pass);
        }
        for (std::size_t i = 0; i < std::min(own, pass); ++i) {
            if (pipeline.color_formats[i] == targets_.color_formats[i]) continue;
            violations_.add(
                "The format of target {} of {} is {}, but that of the attachment is "
                "{}.",
                i, name(), to_text(pipeline.color_formats[i]), to_text(targets_.color_formats[i]));
        }
    }
    if (pipeline.depth_stencil_format != targets_.depth_stencil_format) {
        violations_.add("The depth-stencil format of {} is {}, but that of the attachment is {}.",
                        name(), to_text(pipeline.depth_stencil_format),
                        to_text(targets_.depth_stencil_format));
    }
    if (pipeline.sample_count != targets_.sample_count) {
        violations_.add("The sample count of {} is {}, but that of the attachments is {}.", name(),
                        pipeline.sample_count, targets_.sample_count);
    }
    if (pipeline.writes_depth && targets_.depth_read_only) {
        violations_.add("{} writes depth, which is read-only in the pass.", name());
    }
    if (pipeline.writes_stencil && targets_.stencil_read_only) {
        violations_.add("{} writes stencil, which is read-only in the pass.", name());
    }
}

void DrawCheck::set_bind_group(const cmd::SetBindGroup& command) {
    if (command.group >= max_bind_groups) {
        violations_.add("The group ({}) is not below max_bind_groups ({}).", command.group,
                        max_bind_groups);
        return;
    }
    const BindGroupRecord* group = device_.find(command.bind_group);
    groups_[command.group] = {true, group};
    groups_changed_ = true;
    if (group == nullptr) {
        violations_.add("{}", device_.absence(command.bind_group));
        return;
    }
    for (const TextureId texture : group->textures) {
        if (std::ranges::find(targets_.textures, texture) != targets_.textures.end()) {
            violations_.add("{} is bound by {}, but is an attachment of the pass.",
                            device_.name(texture), device_.name(command.bind_group));
        }
    }
    check_dynamic_offsets(command, *group);
}

void DrawCheck::check_dynamic_offsets(const cmd::SetBindGroup& command,
                                      const BindGroupRecord& group) {
    const std::uint32_t expected = group.shape->dynamic_offset_count;
    if (command.dynamic_offset_count != expected) {
        violations_.add("The number of dynamic offsets ({}) is not the number ({}) that {} has.",
                        command.dynamic_offset_count, expected, device_.name(command.bind_group));
        return;
    }
    const std::uint32_t alignment = device_.caps().limits.min_uniform_buffer_offset_alignment;
    for (std::uint32_t i = 0; i < expected; ++i) {
        const std::uint32_t offset = command.dynamic_offsets[i];
        const DynamicBinding& binding = group.dynamic_bindings[i];
        if (offset % alignment != 0) {
            violations_.add(
                "The dynamic offset ({}) of binding {} is not a multiple of "
                "min_uniform_buffer_offset_alignment ({}).",
                offset, binding.binding, alignment);
        }
        // The bind group's own range was seen to fit when it was made.
        if (offset > binding.buffer_size - binding.offset - binding.size) {
            violations_.add(
                "The dynamic offset ({}) of binding {} brings the range (offset {}, "
                "size {}) beyond the end of {} (size {}).",
                offset, binding.binding, binding.offset, binding.size, device_.name(binding.buffer),
                binding.buffer_size);
        }
    }
}

void DrawCheck::set_vertex_buffer(const cmd::SetVertexBuffer& command) {
    if (command.slot >= vertex_buffers_.size()) {
        violations_.add("The slot ({}) is not below max_vertex_buffers ({}).", command.slot,
                        vertex_buffers_.size());
        return;
    }
    vertices_changed_ = true;
    Bytes& bytes = vertex_buffers_[command.slot];
    bytes = {true, unlimited};
    const BufferDesc* buffer = device_.find(command.buffer);
    if (buffer == nullptr) {
        violations_.add("{}", device_.absence(command.buffer));
        return;
    }
    if (!has(buffer->usage, BufferUsage::Vertex)) {
        violations_.add("The usage ({}) of {} lacks Vertex.", to_text(buffer->usage),
                        device_.name(command.buffer));
    }
    if (command.offset % 4 != 0) {
        violations_.add("The offset ({}) is not a multiple of 4.", command.offset);
    }
    if (command.offset > buffer->size) {
        violations_.add("The offset ({}) exceeds the size ({}) of {}.", command.offset,
                        buffer->size, device_.name(command.buffer));
        return;
    }
    bytes.available = buffer->size - command.offset;
}

void DrawCheck::set_index_buffer(const cmd::SetIndexBuffer& command) {
    index_buffer_ = {true, unlimited};
    index_bytes_ = command.format == IndexFormat::Uint16 ? 2 : 4;
    const BufferDesc* buffer = device_.find(command.buffer);
    if (buffer == nullptr) {
        violations_.add("{}", device_.absence(command.buffer));
        return;
    }
    if (!has(buffer->usage, BufferUsage::Index)) {
        violations_.add("The usage ({}) of {} lacks Index.", to_text(buffer->usage),
                        device_.name(command.buffer));
    }
    if (command.offset % index_bytes_ != 0) {
        violations_.add("The offset ({}) is not a multiple of the index size ({}).", command.offset,
                        index_bytes_);
    }
    if (command.offset > buffer->size) {
        violations_.add("The offset ({}) exceeds the size ({}) of {}.", command.offset,
                        buffer->size, device_.name(command.buffer));
        return;
    }
    index_buffer_.available = (buffer->size - command.offset) / index_bytes_;
}

bool DrawCheck::prepare_draw() {
    if (!pipeline_.given) violations_.add("No pipeline is set.");
    if (pipeline_.record == nullptr) return false;
    if (groups_changed_) match_groups();
    if (vertices_changed_) measure_vertex_buffers();
    return true;
}

void DrawCheck::match_groups() {
    groups_changed_ = false;
    const RenderPipelineRecord& pipeline = *pipeline_.record;
    for (std::size_t i = 0; i < pipeline.groups.size(); ++i) {
        const LayoutShape* shape = pipeline.groups[i];
        if (shape->entries.empty()) continue;
        if (!groups_[i].given) {
            violations_.add("{} needs a bind group {}, but none is set.",
                            object_name("RenderPipeline", pipeline.label), i);
        } else if (groups_[i].record != nullptr && groups_[i].record->shape != shape) {
            violations_.add("The layout of {} is not that of group {} of {}. {}",
                            object_name("BindGroup", groups_[i].record->label), i,
                            object_name("RenderPipeline", pipeline.label),
                            difference(*groups_[i].record->shape, *shape));
        }
    }
}

void DrawCheck::measure_vertex_buffers() {
    vertices_changed_ = false;
    vertices_available_ = unlimited;
    instances_available_ = unlimited;
    const RenderPipelineRecord& pipeline = *pipeline_.record;
    for (std::size_t i = 0; i < pipeline.vertex_slots.size(); ++i) {
        const VertexSlot& slot = pipeline.vertex_slots[i];
        if (slot.last_attribute_end == 0) continue;
        if (!vertex_buffers_[i].given) {
            violations_.add("{} needs a vertex buffer {}, but none is set.",
                            object_name("RenderPipeline", pipeline.label), i);
            continue;
        }
        const std::uint64_t bytes = vertex_buffers_[i].available;
        if (bytes == unlimited) continue;
        std::uint64_t elements = 0;
        // The last element needs its attributes, not its whole stride.
        if (bytes >= slot.last_attribute_end) {
            elements =
                slot.stride == 0 ? unlimited : (bytes - slot.last_attribute_end) / slot.stride + 1;
        }
        std::uint64_t& available =
            slot.step_mode == VertexStepMode::Vertex ? vertices_available_ : instances_available_;
        available = std::min(available, elements);
    }
}

void DrawCheck::check_range(std::uint64_t first, std::uint64_t count, std::uint64_t available,
                            const char* what) {
    // Both come from 32 bits, so that the sum cannot overflow; nothing is read where count is 0.
    if (count > 0 && first + count > available) {
        violations_.add("The {} {} to {} are drawn, but the buffers hold {}.", what, first,
                        first + count - 1, available);
    }
}

void DrawCheck::draw(const cmd::Draw& command) {
    if (!prepare_draw()) return;
    check_range(command.first_vertex, command.vertex_count, vertices_available_, "vertices");
    check_range(command.first_instance, command.instance_count, instances_available_, "instances");
}

void DrawCheck::draw_indexed(const cmd::DrawIndexed& command) {
    if (!prepare_draw()) return;
    if (!index_buffer_.given) {
        violations_.add("No index buffer is set.");
        return;
    }
    check_range(command.first_index, command.index_count, index_buffer_.available, "indices");
    check_range(command.first_instance, command.instance_count, instances_available_, "instances");
}

}  // namespace gnomon::gpu
