// SPDX-License-Identifier: MIT
#include <gnomon/shadow_pass/fill_meter.hpp>

#include <array>
#include <utility>

namespace gnomon::shadow_pass {

Result<std::vector<LightFill>> count_fill(gpu::Device& device, const ShadowPass& pass,
                                          gpu::RenderPassDesc target,
                                          std::span<const std::size_t> lights) {
    if (!device.caps().features.occlusion_query) {
        return fail(ErrorCode::Unsupported, "Stencil fragments cannot be counted: the adapter " +
                                                device.caps().adapter +
                                                " lacks exact occlusion queries.");
    }
    std::vector<LightFill> result(lights.size());
    if (lights.empty()) return result;
    constexpr std::array<Fill, 2> kinds{Fill::Rasterised, Fill::Counted};
    auto queries = device.create_query_set(
        {.label = "stencil fragments",
         .type = gpu::QueryType::Occlusion,
         .count = static_cast<std::uint32_t>(kinds.size() * lights.size())});
    if (!queries) return forward_error(queries);
    target.label = "fill meter";
    target.occlusion_query_set = *queries;
    target.timestamp_writes.reset();
    for (gpu::ColorAttachment& color : target.color_attachments) {
        color = {.texture = color.texture};
    }
    if (target.depth_stencil) {
        target.depth_stencil = gpu::DepthStencilAttachment{.texture = target.depth_stencil->texture,
                                                           .depth_read_only = true,
                                                           .stencil_read_only = true};
    }
    auto encoder = device.create_command_encoder("fill meter");
    {
        auto recorder = encoder.begin_render_pass(std::move(target));
        for (std::size_t i = 0; i < kinds.size() * lights.size(); ++i) {
            recorder.begin_occlusion_query(static_cast<std::uint32_t>(i));
            pass.record_fill(recorder, lights[i / kinds.size()], kinds[i % kinds.size()]);
            recorder.end_occlusion_query();
        }
    }
    auto commands = encoder.finish();
    if (!commands) return forward_error(commands);
    if (const Status submitted = device.submit(*commands); !submitted) {
        return forward_error(submitted);
    }
    const auto samples = device.read_query_set(*queries);
    if (!samples) return forward_error(samples);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        result[i] = {(*samples)[kinds.size() * i], (*samples)[kinds.size() * i + 1]};
    }
    return result;
}

}  // namespace gnomon::shadow_pass
