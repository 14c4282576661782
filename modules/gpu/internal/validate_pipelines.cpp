// SPDX-License-Identifier: MIT
#include "internal/validate_pipelines.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "internal/validate_descriptors.hpp"
#include "internal/validate_transfers.hpp"

namespace gnomon::gpu {

namespace {

constexpr std::uint64_t max_vertex_stride = 2048;  // WebGPU's maxVertexBufferArrayStride

bool has_write(const StencilFaceState& face) {
    return face.fail_op != StencilOp::Keep || face.depth_fail_op != StencilOp::Keep ||
           face.pass_op != StencilOp::Keep;
}

class PipelineCheck {
public:
    PipelineCheck(const DeviceState& device, const RenderPipelineDesc& desc)
        : device_(device),
          desc_(desc),
          limits_(device.caps().limits),
          name_(object_name("RenderPipeline", desc.label)) {
        record_.label = desc.label;
        record_.sample_count = desc.sample_count;
    }

    Result<RenderPipelineRecord> run() {
        for (const auto step :
             {&PipelineCheck::shaders, &PipelineCheck::groups, &PipelineCheck::vertex_buffers,
              &PipelineCheck::depth_stencil, &PipelineCheck::targets, &PipelineCheck::outputs}) {
            if (const Status s = (this->*step)(); !s) return forward_error(s);
        }
        return std::move(record_);
    }

private:
    Status shader(ShaderId id, ShaderStage stage) {
        const ShaderRecord* shader = device_.find(id);
        if (shader == nullptr) return invalid("{}", device_.absence(id));
        if (shader->stage != stage) {
            return invalid("The stage of {} is {}, but it is used as the {} shader.",
                           device_.name(id), to_text(shader->stage), to_text(stage));
        }
        return {};
    }

    Status shaders() {
        if (const Status s = shader(desc_.vertex, ShaderStage::Vertex); !s) {
            return in_frame(s, "While checking the vertex shader.");
        }
        if (!desc_.fragment) return {};
        if (const Status s = shader(desc_.fragment, ShaderStage::Fragment); !s) {
            return in_frame(s, "While checking the fragment shader.");
        }
        return {};
    }

    Status groups() {
        if (desc_.bind_group_layouts.size() > max_bind_groups) {
            return invalid(
                "The number of bind group layouts ({}) of {} exceeds max_bind_groups ({}).",
                desc_.bind_group_layouts.size(), name_, max_bind_groups);
        }
        std::vector<std::uint32_t> bindings;
        for (const BindGroupLayoutId id : desc_.bind_group_layouts) {
            const BindGroupLayoutRecord* layout = device_.find(id);
            if (layout == nullptr) return invalid("{}", device_.absence(id));
            record_.groups.push_back(layout->shape);
            for (const BindGroupLayoutEntry& entry : layout->shape->entries) {
                bindings.push_back(entry.binding);
            }
        }
        std::ranges::sort(bindings);
        if (const auto twice = std::ranges::adjacent_find(bindings); twice != bindings.end()) {
            return invalid(
                "Binding {} is in two bind group layouts of {}, but bindings are unique "
                "across all groups.",
                *twice, name_);
        }
        return {};
    }

    Status vertex_buffers() {
        if (desc_.vertex_buffers.size() > limits_.max_vertex_buffers) {
            return invalid(
                "The number of vertex buffers ({}) of {} exceeds max_vertex_buffers ({}).",
                desc_.vertex_buffers.size(), name_, limits_.max_vertex_buffers);
        }
        std::size_t attributes = 0;
        for (const VertexBufferLayout& layout : desc_.vertex_buffers) {
            attributes += layout.attributes.size();
        }
        if (attributes > limits_.max_vertex_attributes) {
            return invalid(
                "The number of vertex attributes ({}) of {} exceeds "
                "max_vertex_attributes ({}).",
                attributes, name_, limits_.max_vertex_attributes);
        }
        std::vector<bool> used(limits_.max_vertex_attributes, false);
        for (std::size_t slot = 0; slot < desc_.vertex_buffers.size(); ++slot) {
            if (const Status s = vertex_buffer(desc_.vertex_buffers[slot], used); !s) {
                return in_frame(s, fmt::format("While checking vertex buffer {}.", slot));
            }
        }
        return {};
    }

    Status vertex_buffer(const VertexBufferLayout& layout, std::vector<bool>& used) {
        const std::uint64_t stride = layout.array_stride;
        if (stride % 4 != 0) return invalid("The stride ({}) is not a multiple of 4.", stride);
        if (stride > max_vertex_stride) {
            return invalid("The stride ({}) exceeds {}.", stride, max_vertex_stride);
        }
        VertexSlot slot{stride, 0, layout.step_mode};
        // A stride of 0 gives every vertex the same element, wherever that lies.
        const std::uint64_t extent = stride != 0 ? stride : max_vertex_stride;
        for (const VertexAttribute& attribute : layout.attributes) {
            const std::uint32_t location = attribute.shader_location;
            const std::uint32_t bytes = vertex_format_bytes(attribute.format);
            if (attribute.offset % 4 != 0) {
                return invalid(
                    "The offset ({}) of the attribute at location {} is not a multiple "
                    "of 4.",
                    attribute.offset, location);
            }
            if (!range_fits(attribute.offset, bytes, extent)) {
                return invalid(
                    "The attribute at location {} (offset {}, {} bytes) does not fit in "
                    "the stride ({}).",
                    location, attribute.offset, bytes, extent);
            }
            if (location >= used.size()) {
                return invalid(
                    "The location ({}) of an attribute is not below "
                    "max_vertex_attributes ({}).",
                    location, used.size());
            }
            if (used[location]) return invalid("The location {} is used twice.", location);
            used[location] = true;
            slot.last_attribute_end = std::max(slot.last_attribute_end, attribute.offset + bytes);
        }
        record_.vertex_slots.push_back(slot);
        return {};
    }

    Status depth_stencil() {
        if (!desc_.depth_stencil) return {};
        const DepthStencilState& state = *desc_.depth_stencil;
        if (state.format == Format::Undefined || has_color(state.format)) {
            return invalid("The depth-stencil format ({}) of {} is not a depth-stencil format.",
                           to_text(state.format), name_);
        }
        if (const Status s = validate_format(device_, state.format, name_); !s) return s;
        if (state.depth_compare == Compare::Undefined) {
            return invalid(
                "The depth_compare of {} is Undefined, but its format ({}) has a depth "
                "aspect.",
                name_, to_text(state.format));
        }
        if (const Status s = stencil(state); !s) return s;
        if (!std::isfinite(state.depth_bias_slope_scale) ||
            !std::isfinite(state.depth_bias_clamp)) {
            return invalid("The depth bias (slope scale {}, clamp {}) of {} is not finite.",
                           state.depth_bias_slope_scale, state.depth_bias_clamp, name_);
        }
        const bool biased = state.depth_bias != 0 || state.depth_bias_slope_scale != 0.0F ||
                            state.depth_bias_clamp != 0.0F;
        if (biased && desc_.primitive.topology != PrimitiveTopology::TriangleList) {
            return invalid("The depth of {} is biased, but its topology is not TriangleList.",
                           name_);
        }
        record_.depth_stencil_format = state.format;
        record_.writes_depth = state.depth_write_enabled;
        record_.writes_stencil =
            state.stencil_write_mask != 0 &&
            ((desc_.primitive.cull_mode != CullMode::Front && has_write(state.stencil_front)) ||
             (desc_.primitive.cull_mode != CullMode::Back && has_write(state.stencil_back)));
        return {};
    }

    Status stencil(const DepthStencilState& state) {
        for (const auto& [side, face] :
             {std::pair("front", &state.stencil_front), std::pair("back", &state.stencil_back)}) {
            if (face->compare == Compare::Undefined) {
                return invalid("The compare of stencil_{} of {} is Undefined.", side, name_);
            }
            if (*face != StencilFaceState{} && !has_stencil(state.format)) {
                return invalid(
                    "The stencil is used by {}, but its format ({}) has no stencil aspect.", name_,
                    to_text(state.format));
            }
        }
        for (const auto& [which, mask] : {std::pair("read", state.stencil_read_mask),
                                          std::pair("write", state.stencil_write_mask)}) {
            if (mask > 0xFF) {
                return invalid("The stencil_{}_mask ({:#x}) of {} exceeds 0xff.", which, mask,
                               name_);
            }
        }
        return {};
    }

    Status targets() {
        if (desc_.targets.size() > limits_.max_color_attachments) {
            return invalid("The number of targets ({}) of {} exceeds max_color_attachments ({}).",
                           desc_.targets.size(), name_, limits_.max_color_attachments);
        }
        for (std::size_t i = 0; i < desc_.targets.size(); ++i) {
            if (const Status s = target(desc_.targets[i]); !s) {
                return in_frame(s, fmt::format("While checking target {}.", i));
            }
            record_.color_formats.push_back(desc_.targets[i].format);
        }
        return {};
    }

    Status target(const ColorTargetState& target) {
        if (!has_color(target.format)) {
            return invalid("The format ({}) is not a color format.", to_text(target.format));
        }
        if ((static_cast<std::uint32_t>(target.write_mask) & ~15U) != 0) {
            return invalid("The write mask ({:#x}) has unknown bits.",
                           static_cast<std::uint32_t>(target.write_mask));
        }
        if (target.write_mask != ColorWrite::None && !desc_.fragment) {
            return invalid("{} writes color, but has no fragment shader.", name_);
        }
        if (!target.blend) return {};
        if (is_uint(target.format)) {
            return invalid("Blending is on, but the format ({}) is not blendable.",
                           to_text(target.format));
        }
        for (const BlendComponent& component : {target.blend->color, target.blend->alpha}) {
            const bool extreme = component.operation == BlendOperation::Min ||
                                 component.operation == BlendOperation::Max;
            if (extreme && (component.src_factor != BlendFactor::One ||
                            component.dst_factor != BlendFactor::One)) {
                return invalid(
                    "The blend operation is Min or Max, but its factors are not both "
                    "One.");
            }
        }
        return {};
    }

    Status outputs() {
        if (desc_.targets.empty() && !desc_.depth_stencil) {
            return invalid("{} has neither a target nor a depth-stencil state.", name_);
        }
        if (desc_.primitive.unclipped_depth && !device_.caps().features.unclipped_depth) {
            return invalid("{} uses unclipped_depth, which this adapter does not have.", name_);
        }
        if (desc_.depth_stencil && desc_.depth_stencil->depth_bounds_test &&
            !device_.caps().features.depth_bounds) {
            return invalid("{} uses depth_bounds_test, which this adapter does not have.", name_);
        }
        return validate_sample_count(device_, desc_.sample_count, name_);
    }

    const DeviceState& device_;
    const RenderPipelineDesc& desc_;
    const Limits& limits_;
    std::string name_;
    RenderPipelineRecord record_;
};

}  // namespace

Result<RenderPipelineRecord> validate(DeviceState& device, const RenderPipelineDesc& desc) {
    return PipelineCheck(device, desc).run();
}

}  // namespace gnomon::gpu
