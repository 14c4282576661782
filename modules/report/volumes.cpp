// SPDX-License-Identifier: MIT
#include "internal/volumes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gnomon/render/light_choice.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>
#include <gnomon_shaders/report.hpp>

#include "internal/edge_on.hpp"

namespace gnomon::report::internal {

namespace {

// 2^-22: two steps of a 24-bit depth buffer, and of single precision just below 1.
constexpr double epsilon = 2.384185791015625e-07;

shadows::View with_near(shadows::View view, double scale) {
    view.clip_from_view[3][2] *= scale;
    return view;
}

shadows::View view_of(const Setup& setup, const VolumeTechnique& how) {
    shadows::View view = with_near(setup.view, how.near_scale);
    const Projection projection = how.projection;
    glm::dmat4& clip = view.clip_from_view;
    const double near_m = clip[3][2];
    if (projection == Projection::Epsilon) {
        clip[2][2] = epsilon - 1.0;
        clip[3][2] = (epsilon - 1.0) * near_m;
    } else if (projection == Projection::Clamped) {
        const glm::dvec3 eye(glm::inverse(view.view_from_world)[3]);
        const double far_m =
            glm::length(eye - setup.bounds.center()) + 2.0 * setup.bounds.diagonal();
        clip[2][2] = near_m / (far_m - near_m);
        clip[3][2] = far_m * near_m / (far_m - near_m);
        view.projection = shadows::ProjectionKind::FinitePerspective;
    }
    return view;
}

// Far vertices no farther than `reach_m` behind the caster.
void shorten(shadows::VolumeDraw& draw, double reach_m) {
    shadows::Extrusion& extrusion = draw.extrusion;
    const glm::dvec3 offset(extrusion.offset);
    if (extrusion.offset.w == 0.0F || draw.mesh == nullptr) return;
    if (extrusion.scale == 1.0F) {
        const double length =
            glm::length(glm::dvec3(draw.world_from_far * glm::dvec4(offset, 0.0)));
        if (length <= reach_m || length == 0.0) return;
        extrusion.offset = glm::vec4(glm::vec3(offset * (reach_m / length)), 1.0F);
        return;
    }
    const double scale = extrusion.scale;
    const glm::dvec3 light = offset / (1.0 - scale);
    const glm::dvec3 middle =
        (glm::dvec3(draw.mesh->bounds_min()) + glm::dvec3(draw.mesh->bounds_max())) * 0.5;
    const double distance =
        glm::length(glm::dvec3(draw.world_from_local * glm::dvec4(middle - light, 0.0)));
    if (distance == 0.0) return;
    const double shorter = 1.0 + reach_m / distance;
    if (shorter >= scale) return;
    extrusion.scale = static_cast<float>(shorter);
    extrusion.offset = glm::vec4(glm::vec3(light * (1.0 - shorter)), 1.0F);
}

class Volumes final : public DrawnTechnique {
public:
    Volumes(const Setup& setup, const VolumeTechnique& how)
        : DrawnTechnique(setup.stage),
          how_(how),
          bounds_(setup.bounds),
          view_(view_of(setup, how)) {}

    Status create(const Setup& setup);
    Result<FrameCost> frame(const Moment& moment, bool look) override;
    Status restart() override;
    [[nodiscard]] std::size_t edge_on(const Moment& moment, std::size_t light,
                                      std::span<const std::uint32_t> pixels) const override {
        if (last_ == nullptr) return 0;
        const PictureSize size{stage_.width(), stage_.height()};
        return static_cast<std::size_t>(std::ranges::count_if(pixels, [&](std::uint32_t at) {
            return is_on_a_side_seen_edge_on(*last_, moment.lights[light].key, view_, size,
                                             {at % size.width, at / size.width});
        }));
    }

private:
    Result<const shadows::DrawList*> shadows_of(const Moment& moment);
    Status submit(const Moment& moment, shadows::ShadowSystem::Frame& frame);
    Status submit_commands(gpu::CommandEncoder& encoder);
    void record_light(gpu::CommandEncoder& encoder, gpu::TextureId depth,
                      const shadows::DrawList& list, const Moment& moment, std::size_t light);
    [[nodiscard]] DepthRange range() const {
        return how_.projection == Projection::Epsilon ? DepthRange::Forward : DepthRange::Reversed;
    }

    VolumeTechnique how_;
    scene::Bounds bounds_;
    shadows::View view_;  // that is drawn with
    std::optional<shadows::ShadowSystem> system_;
    std::optional<shadow_pass::ShadowPass> pass_;
    scene::ShadowAdapter adapter_;
    gpu::RenderPipeline mask_;
    gpu::Shader ranged_vertex_;
    gpu::Shader ranged_fragment_;
    gpu::RenderPipeline ranged_depth_;
    DrawMatrices matrices_;
    std::vector<shadows::Caster> proxies_;
    std::vector<shadows::Receiver> receivers_;  // with proxies_
    shadows::DrawList shortened_;
    const shadows::DrawList* last_ = nullptr;
};

Status Volumes::create(const Setup& setup) {
    gpu::Device& device = stage_.device();
    const gpu::Features& features = device.caps().features;
    if (how_.format == gpu::Format::Depth24UnormStencil8 && !features.depth24unorm_stencil8) {
        return fail(ErrorCode::Unsupported, "This adapter has no 24-bit depth beside a stencil.");
    }
    if (how_.projection == Projection::Clamped && !features.unclipped_depth) {
        return fail(ErrorCode::Unsupported, "This adapter cannot clamp depth.");
    }
    auto pass = shadow_pass::ShadowPass::create(
        device, {.depth_stencil_format = how_.format,
                 .depth_compare =
                     range() == DepthRange::Forward ? gpu::Compare::Less : gpu::Compare::Greater,
                 .color_formats = {mask_format}});
    if (!pass) return forward_error(pass);
    pass_ = std::move(*pass);
    const gpu::StencilFaceState counted{.compare = gpu::Compare::NotEqual};
    auto mask = device.create_render_pipeline(
        {.label = "mask",
         .vertex = stage_.full_screen(),
         .fragment = stage_.white(),
         .depth_stencil = gpu::DepthStencilState{.format = how_.format,
                                                 .depth_compare = gpu::Compare::Always,
                                                 .stencil_front = counted,
                                                 .stencil_back = counted},
         .targets = {{.format = mask_format}}});
    if (!mask) return forward_error(mask);
    mask_ = std::move(*mask);
    if (how_.projection == Projection::Clamped) {
        auto vertex = device.create_shader({.label = "ranged positions",
                                            .stage = gpu::ShaderStage::Vertex,
                                            .source = shaders::ranged_vert});
        if (!vertex) return forward_error(vertex);
        auto fragment = device.create_shader({.label = "ranged depth",
                                              .stage = gpu::ShaderStage::Fragment,
                                              .source = shaders::ranged_frag});
        if (!fragment) return forward_error(fragment);
        ranged_vertex_ = std::move(*vertex);
        ranged_fragment_ = std::move(*fragment);
        auto depth = device.create_render_pipeline(
            {.label = "depth, clamped",
             .bind_group_layouts = {stage_.draw_layout()},
             .vertex = ranged_vertex_,
             .fragment = ranged_fragment_,
             .vertex_buffers = {Stage::position_layout()},
             .primitive = {.unclipped_depth = true},
             .depth_stencil = gpu::DepthStencilState{.format = how_.format,
                                                     .depth_write_enabled = true,
                                                     .depth_compare = gpu::Compare::Greater}});
        if (!depth) return forward_error(depth);
        ranged_depth_ = std::move(*depth);
    }
    if (how_.most_lights) {
        const std::size_t lights = setup.lights;
        if (lights <= *how_.most_lights) {
            return fail(ErrorCode::Unsupported,
                        fmt::format("The scene has {} light{}: none would be left out.", lights,
                                    lights == 1 ? "" : "s"));
        }
    }
    if (how_.proxy_share) {
        auto proxies = simplified_casters(setup.subject.scene, *how_.proxy_share, how_.proxy_inset);
        if (!proxies) return forward_error(proxies);
        proxies_ = std::move(*proxies);
        const scene::Registry& registry = setup.subject.scene.registry;
        registry.each<scene::Receiver, scene::MeshInstance,
                      scene::WorldTransform>([&](scene::Entity entity, const scene::Receiver&,
                                                 const scene::MeshInstance& instance,
                                                 const scene::WorldTransform& world) {
            const auto geometry = scene::geometry_of(registry, entity, instance, world);
            if (geometry.positions.empty()) return;
            scene::Bounds box;
            for (const glm::vec3& p : geometry.positions) box.include(glm::dvec3(p));
            receivers_.push_back({entity.key(), {geometry.world_from_positions, box.min, box.max}});
        });
    }
    return restart();
}

Status Volumes::restart() {
    shadows::SystemOptions options = how_.system;
    options.receivers = shadows::Receivers::Submitted;
    if (how_.reach_share) options.fill.clamp = false;
    last_ = nullptr;
    auto system = shadows::ShadowSystem::create(options);
    if (!system) return forward_error(system);
    system_ = std::move(*system);
    return {};
}

Status Volumes::submit(const Moment& moment, shadows::ShadowSystem::Frame& frame) {
    if (!how_.proxy_share) {
        std::vector<scene::Entity> unshadowed;
        if (how_.most_lights) {
            unshadowed = render::choose_shadowed_lights(*moment.scene, bounds_, moment.view,
                                                        *how_.most_lights)
                             .unshadowed;
        }
        return adapter_.submit(*moment.scene, frame, false, how_.near_caps, unshadowed);
    }
    for (const shadows::Caster& caster : proxies_) frame.caster(caster);
    for (const shadows::Receiver& receiver : receivers_) frame.receiver(receiver);
    for (const shadows::Light& light : moment.lights) frame.light(light);
    return {};
}

Result<const shadows::DrawList*> Volumes::shadows_of(const Moment& moment) {
    auto frame = system_->begin_frame();
    if (const Status submitted = submit(moment, frame); !submitted) {
        return forward_error(submitted);
    }
    // Where volumes can be seen is asked with the reversed view: it is the same picture.
    const shadows::DrawList& list = std::move(frame).finish(
        how_.projection == Projection::Clamped ? view_ : with_near(moment.view, how_.near_scale));
    if (!how_.reach_share) return &list;
    static std::uint64_t next_revision = std::uint64_t{1} << 62U;
    shortened_ = list;
    shortened_.revision = next_revision++;
    for (shadows::VolumeDraw& draw : shortened_.draws) {
        shorten(draw, *how_.reach_share * bounds_.diagonal());
    }
    return &shortened_;
}

Status Volumes::submit_commands(gpu::CommandEncoder& encoder) {
    auto commands = encoder.finish();
    if (!commands) return forward_error(commands);
    return stage_.device().submit(*commands);
}

void Volumes::record_light(gpu::CommandEncoder& encoder, gpu::TextureId depth,
                           const shadows::DrawList& list, const Moment& moment, std::size_t light) {
    const auto drawn = std::find_if(
        list.lights.begin(), list.lights.end(),
        [&](const shadows::LightDraws& l) { return l.light == moment.lights[light].key; });
    auto pass = encoder.begin_render_pass(
        {.label = "volumes",
         .color_attachments = {{.texture = stage_.mask(light), .load_op = gpu::LoadOp::Clear}},
         .depth_stencil =
             gpu::DepthStencilAttachment{.texture = depth, .stencil_load_op = gpu::LoadOp::Clear}});
    if (drawn == list.lights.end() || drawn->count == 0) return;
    const shadows::PixelRect changed =
        shadows::pixels_of(drawn->bounds, stage_.width(), stage_.height());
    if (changed.width == 0 || changed.height == 0) return;
    pass_->record(pass, static_cast<std::size_t>(drawn - list.lights.begin()));
    pass.set_pipeline(mask_);
    pass.set_stencil_reference(0);
    pass.set_scissor_rect(changed.x, changed.y, changed.width, changed.height);
    pass.draw(3);
}

Result<FrameCost> Volumes::frame(const Moment& moment, bool look) {
    gpu::Device& device = stage_.device();
    const auto start = Clock::now();
    const std::uint64_t uploaded = device.counters().uploaded_bytes;
    FrameCost cost;
    auto list = shadows_of(moment);
    if (!list) return forward_error(list);
    last_ = *list;
    cost.detect_ms = (*list)->stats.detect_ms;
    cost.build_ms = (*list)->stats.build_ms;

    const auto recording = Clock::now();
    const shadow_pass::TargetSize target{stage_.width(), stage_.height()};
    if (const Status done = pass_->prepare(**list, view_, target); !done) {
        return forward_error(done);
    }
    const auto instances = stage_.instances(*moment.scene);
    matrices_.clear();
    std::vector<std::uint32_t> offsets;
    const glm::dmat4 clip_from_world = view_.clip_from_world();
    glm::mat4 range_m(0.0F);  // ranged.vert's
    if (how_.projection == Projection::Clamped) {
        const glm::dmat4& clip = view_.clip_from_view;
        range_m[0] = {static_cast<float>(clip[3][2] / (1.0 + clip[2][2])),
                      static_cast<float>(clip[3][2] / clip[2][2]), 0.0F, 0.0F};
    }
    for (const StageInstance& instance : instances) {
        offsets.push_back(
            matrices_.add(glm::mat4(clip_from_world * instance.world_from_local), range_m));
    }
    if (const Status done = matrices_.upload(device, stage_.draw_layout()); !done) {
        return forward_error(done);
    }
    auto depth = stage_.depth_stencil(how_.format);
    if (!depth) return forward_error(depth);
    auto pipeline = stage_.depth_pipeline(how_.format, range());
    if (!pipeline) return forward_error(pipeline);
    auto encoder = device.create_command_encoder("frame");
    stage_.record_depth(encoder, ranged_depth_ ? ranged_depth_.id() : *pipeline, *depth, range(),
                        instances, matrices_, offsets);
    for (std::size_t light = 0; light < moment.lights.size(); ++light) {
        record_light(encoder, *depth, **list, moment, light);
        if (!look) continue;
        if (const Status done = submit_commands(encoder); !done) return forward_error(done);
        auto stencil = device.read_texture(*depth, gpu::Aspect::StencilOnly);
        if (!stencil) return forward_error(stencil);
        for (const std::byte count : *stencil) {
            // Counts wrap: what is more than half of the range lies below zero.
            const auto value = std::to_integer<std::uint64_t>(count);
            cost.layers = std::max(cost.layers, std::min(value, 256 - value));
        }
        encoder = device.create_command_encoder("frame");
    }
    cost.record_ms = milliseconds_since(recording);
    if (!look) {
        if (const Status done = submit_commands(encoder); !done) return forward_error(done);
    }
    if (const Status idle = device.wait_idle(); !idle) return forward_error(idle);
    cost.frame_ms = milliseconds_since(start);
    cost.upload_bytes = device.counters().uploaded_bytes - uploaded;
    return cost;
}

}  // namespace

Result<std::unique_ptr<Technique>> create_volumes(const Setup& setup, const VolumeTechnique& how) {
    auto technique = std::make_unique<Volumes>(setup, how);
    if (const Status created = technique->create(setup); !created) return forward_error(created);
    return technique;
}

}  // namespace gnomon::report::internal
