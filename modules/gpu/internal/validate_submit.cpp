// SPDX-License-Identifier: MIT
#include <variant>

#include "internal/validate_commands.hpp"

namespace gnomon::gpu {

namespace {

class SubmitCheck {
public:
    explicit SubmitCheck(const DeviceState& device) : device_(device) {}

    Status operator()(const cmd::SetPipeline& command) const { return alive(command.pipeline); }
    Status operator()(const cmd::SetVertexBuffer& command) const { return alive(command.buffer); }
    Status operator()(const cmd::SetIndexBuffer& command) const { return alive(command.buffer); }

    Status operator()(const cmd::CopyBufferToBuffer& command) const {
        if (Status s = alive(command.source); !s) return s;
        return alive(command.destination);
    }

    Status operator()(const cmd::SetBindGroup& command) const {
        const BindGroupRecord* group = device_.find(command.bind_group);
        if (group == nullptr) return alive(command.bind_group);
        const auto check_parts = [&](const auto& parts) -> Status {
            for (const auto part : parts) {
                if (device_.find(part) != nullptr) continue;
                return invalid("{} It is bound by {}.", device_.absence(part),
                               object_name("BindGroup", group->label));
            }
            return {};
        };
        if (Status s = check_parts(group->buffers); !s) return s;
        if (Status s = check_parts(group->textures); !s) return s;
        return check_parts(group->samplers);
    }

    template <class Command>
    Status operator()(const Command&) const {
        return {};
    }

    Status pass(const RenderPassDesc& desc) const {
        for (const ColorAttachment& color : desc.color_attachments) {
            if (Status s = alive(color.texture); !s) return s;
            if (!color.resolve_target) continue;
            if (Status s = alive(color.resolve_target); !s) return s;
        }
        if (desc.depth_stencil) {
            if (Status s = alive(desc.depth_stencil->texture); !s) return s;
        }
        if (desc.occlusion_query_set) {
            if (Status s = alive(desc.occlusion_query_set); !s) return s;
        }
        return desc.timestamp_writes ? alive(desc.timestamp_writes->query_set) : Status{};
    }

private:
    template <class Tag>
    Status alive(Id<Tag> id) const {
        if (device_.find(id) == nullptr) return invalid("{}", device_.absence(id));
        return {};
    }

    const DeviceState& device_;
};

}  // namespace

Status validate_submit(const DeviceState& device, const CommandBuffer& commands) {
    const SubmitCheck check(device);
    for (const RenderPassDesc& desc : commands.passes) {
        if (Status s = check.pass(desc); !s) return s;
    }
    for (const Command& command : commands.commands) {
        if (Status s = std::visit(check, command); !s) return s;
    }
    return {};
}

}  // namespace gnomon::gpu
