// SPDX-License-Identifier: MIT
#include <gnomon/shadow_pass/guest_pass.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/core/expects.hpp>

namespace gnomon::shadow_pass {

struct GuestPass::State {
    gpu::Device* device = nullptr;
    GuestPassDesc desc;
    ShadowPass pass;
    std::size_t lights = 0;
    // By light, while the pass's revision stays: what count() submitted.
    std::vector<std::optional<gpu::CommandBuffer>> recorded;
    std::uint64_t recorded_revision = 0;
};

namespace {

std::string format_words(gpu::Format format) {
    switch (format) {
        case gpu::Format::Depth24UnormStencil8: return "Depth24UnormStencil8";
        case gpu::Format::Depth32FloatStencil8: return "Depth32FloatStencil8";
        default: return "a format without a stencil";
    }
}

std::string target_words(TargetSize size, gpu::Format format, std::uint32_t samples) {
    return std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels of " +
           format_words(format) + " with " + std::to_string(samples) +
           (samples == 1 ? " sample" : " samples");
}

Status check_target(const gpu::Device& device, const GuestPassDesc& desc) {
    if (!desc.target) {
        return fail(ErrorCode::InvalidInput,
                    "The guest pass has no target: name the host's depth-stencil by "
                    "Device::import_texture().");
    }
    const std::optional<gpu::TextureDesc> target = device.desc_of(desc.target);
    if (!target) {
        return fail(ErrorCode::InvalidInput,
                    "The guest pass's target was freed, or belongs to another device.");
    }
    const TargetSize size{target->width, target->height};
    if (desc.size != size || desc.format != target->format ||
        desc.sample_count != target->sample_count) {
        return fail(ErrorCode::InvalidInput,
                    "The guest pass's target [Texture \"" + target->label + "\"] has " +
                        target_words(size, target->format, target->sample_count) + ", not " +
                        target_words(desc.size, desc.format, desc.sample_count) + ".");
    }
    return {};
}

}  // namespace

GuestPass::GuestPass(std::unique_ptr<State> state) : state_(std::move(state)) {}
GuestPass::GuestPass(GuestPass&&) noexcept = default;
GuestPass& GuestPass::operator=(GuestPass&&) noexcept = default;
GuestPass::~GuestPass() = default;

Result<GuestPass> GuestPass::create(gpu::Device& device, const GuestPassDesc& desc) {
    if (const Status checked = check_target(device, desc); !checked) return forward_error(checked);
    if (desc.conventions.depth == shadows::HostDepth::MinusOneToOne &&
        device.caps().backend == "vk") {
        return fail(ErrorCode::InvalidInput,
                    "The guest pass's HostConventions::depth is MinusOneToOne, but clip space has "
                    "depth from 0 to 1 on Vulkan: set it to ZeroToOne.");
    }
    // The one that refuses such depth, and says why.
    if (desc.conventions.depth == shadows::HostDepth::Logarithmic) {
        return forward_error(
            shadows::view_of_host(glm::dmat4(1.0), glm::dmat4(1.0), desc.conventions));
    }
    auto pass = ShadowPass::create(
        device,
        {.depth_stencil_format = desc.format,
         .depth_compare = desc.conventions.reversed ? gpu::Compare::Greater : gpu::Compare::Less,
         .clip_from_minus_one = desc.conventions.depth == shadows::HostDepth::MinusOneToOne,
         .sample_count = desc.sample_count,
         .cap_bias = desc.cap_bias});
    if (!pass) return forward_error(pass);
    return GuestPass(std::make_unique<State>(
        State{.device = &device, .desc = desc, .pass = std::move(*pass), .recorded = {}}));
}

Status GuestPass::prepare(const shadows::DrawList& list, const shadows::HostView& view) {
    State& s = *state_;
    if (view.conventions.reversed != s.desc.conventions.reversed ||
        view.conventions.depth != s.desc.conventions.depth) {
        return fail(ErrorCode::InvalidInput,
                    "The view's conventions of depth are not those that the guest pass was made "
                    "with: make another pass where they change.");
    }
    s.lights = 0;
    if (const Status prepared = s.pass.prepare(list, view.as_drawn, s.desc.size); !prepared) {
        return prepared;
    }
    s.lights = list.lights.size();
    if (s.recorded_revision != s.pass.revision()) s.recorded.clear();
    s.recorded_revision = s.pass.revision();
    s.recorded.resize(s.lights);
    return {};
}

Status GuestPass::count(std::size_t light) {
    State& s = *state_;
    GNOMON_EXPECTS(light < s.lights);
    std::optional<gpu::CommandBuffer>& commands = s.recorded[light];
    if (!commands) {
        gpu::CommandEncoder encoder = s.device->create_command_encoder("guest");
        {
            auto pass = encoder.begin_render_pass(
                {.label = "shadow volumes in the host's stencil",
                 .depth_stencil = gpu::DepthStencilAttachment{
                     .texture = s.desc.target, .stencil_load_op = gpu::LoadOp::Clear}});
            s.pass.record(pass, light);
        }
        auto finished = encoder.finish();
        if (!finished) return forward_error(finished);
        commands = std::move(*finished);
    }
    return s.device->submit(*commands);
}

const PassStats& GuestPass::stats() const { return state_->pass.stats(); }

}  // namespace gnomon::shadow_pass
