// SPDX-License-Identifier: MIT
#include <gnomon/shadow_pass/guest_pass.hpp>

#include <optional>
#include <utility>
#include <vector>

#include "internal/guest_target.hpp"

namespace gnomon::shadow_pass {

struct GuestPass::State {
    gpu::Device* device = nullptr;
    GuestPassDesc desc;
    ShadowPass pass;
    std::optional<std::size_t> lights = std::nullopt;  // of the list; nothing: none is prepared
    // By light, while the pass's revision stays: what count() submitted.
    std::vector<std::optional<gpu::CommandBuffer>> recorded;
    std::uint64_t recorded_revision = 0;
};

GuestPass::GuestPass(std::unique_ptr<State> state) : state_(std::move(state)) {}
GuestPass::GuestPass(GuestPass&&) noexcept = default;
GuestPass& GuestPass::operator=(GuestPass&&) noexcept = default;
GuestPass::~GuestPass() = default;

Result<GuestPass> GuestPass::create(gpu::Device& device, const GuestPassDesc& desc) {
    if (const Status checked = internal::check_guest(device, desc, "the guest pass"); !checked) {
        return forward_error(checked);
    }
    auto pass = ShadowPass::create(device, internal::shadow_pass_of(desc, {}));
    if (!pass) return forward_error(pass);
    return GuestPass(std::make_unique<State>(
        State{.device = &device, .desc = desc, .pass = std::move(*pass), .recorded = {}}));
}

Status GuestPass::prepare(const shadows::DrawList& list, const shadows::HostView& view) {
    State& s = *state_;
    s.lights.reset();
    const Status fits = internal::check_view(s.desc, view, "the guest pass");
    if (!fits) return fits;
    if (const Status prepared = s.pass.prepare(list, view.as_drawn, s.desc.size); !prepared) {
        return prepared;
    }
    s.lights = list.lights.size();
    if (s.recorded_revision != s.pass.revision()) s.recorded.clear();
    s.recorded_revision = s.pass.revision();
    s.recorded.resize(*s.lights);
    return {};
}

Status GuestPass::count(std::size_t light) {
    State& s = *state_;
    const Status known = internal::check_lights(s.lights, light, 1, "the guest pass", "be counted");
    if (!known) return known;
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
