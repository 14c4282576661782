// SPDX-License-Identifier: MIT
#include "drawing.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include <gnomon/render/camera.hpp>

#include "frame_times.hpp"
#include "movers.hpp"

namespace gnomon::game {

shadows::View follow(const Level& level, const Player& player, double aspect, const Look& look) {
    CameraRig rig = level.camera;
    rig.yaw_rad += look.yaw_rad;
    rig.pitch_rad =
        std::clamp(rig.pitch_rad + look.pitch_rad, glm::radians(20.0), glm::radians(85.0));
    rig.distance_m /= look.nearer;
    // Of the level, what the picture shows about the middle of its sides: the box about that, as it
    // is turned in plan.
    const glm::dvec2 shown =
        rig.distance_m * std::tan(rig.fovy_rad * 0.5) * glm::dvec2(aspect, 1.0);
    const glm::dvec2 turn = glm::abs(glm::dvec2(std::cos(rig.yaw_rad), std::sin(rig.yaw_rad)));
    const glm::dvec2 margin(turn.x * shown.x + turn.y * shown.y,
                            turn.y * shown.x + turn.x * shown.y);
    const glm::dvec2 room = glm::max(level.size_m * 0.5 + 2.0 - margin, glm::dvec2(0.0));
    const glm::dvec2 ahead = plan_direction(rig.yaw_rad) * -1.2;
    const glm::dvec2 at = glm::clamp(player.at + ahead, -room, room);
    const glm::dvec3 target(at.x, 0.9, at.y);
    const glm::dvec2 back = plan_direction(rig.yaw_rad);
    const double c = std::cos(rig.pitch_rad);
    const glm::dvec3 eye =
        target + rig.distance_m * glm::dvec3(back.x * c, std::sin(rig.pitch_rad), back.y * c);
    return {.view_from_world = shadows::look_at(eye, target, {0.0, 1.0, 0.0}),
            .clip_from_view = shadows::infinite_perspective(rig.fovy_rad, aspect, 0.1)};
}

namespace {

render::RendererDesc renderer_desc(const DrawingOptions& options) {
    return {.width = options.width,
            .height = options.height,
            .sample_count = options.samples,
            .overlays = options.overlays};
}

Result<shadows::ShadowSystem> make_shadow_system(const DrawingOptions& options) {
    return shadows::ShadowSystem::create({.force_technique = options.technique,
                                          .silhouette = options.silhouette,
                                          .receivers = shadows::Receivers::Submitted});
}

std::size_t number_of(std::span<const MeterLight> lights, std::uint64_t key) {
    return static_cast<std::size_t>(std::ranges::count_if(
        lights, [&](const MeterLight& light) { return light.shadow.key < key; }));
}

}  // namespace

Drawing::Drawing(gpu::Device& device, const DrawingOptions& options, shadows::ShadowSystem system,
                 render::Renderer renderer)
    : device_(&device),
      options_(options),
      system_(std::move(system)),
      renderer_(std::move(renderer)) {}

Result<Drawing> Drawing::create(gpu::Device& device, Stage& stage, const DrawingOptions& options) {
    auto system = make_shadow_system(options);
    if (!system) return forward_error(system);
    auto renderer = render::Renderer::create(device, renderer_desc(options));
    if (!renderer) return forward_error(renderer);
    stage.dress();
    if (const Status uploaded = renderer->upload(stage.scene()); !uploaded) {
        return forward_error(uploaded);
    }
    return Drawing(device, options, std::move(*system), std::move(*renderer));
}

Status Drawing::configure(const DrawingOptions& options) {
    if (options == options_) return {};
    if (options.technique != options_.technique || options.silhouette != options_.silhouette) {
        list_ = nullptr;
        auto system = make_shadow_system(options);
        if (!system) return forward_error(system);
        system_ = std::move(*system);
    }
    options_ = options;
    return renderer_.reconfigure(renderer_desc(options));
}

Status Drawing::draw(Stage& stage, const Level& level, const shadows::View& view,
                     const std::function<Status(std::size_t)>& after_light) {
    const auto start = std::chrono::steady_clock::now();
    const gpu::DeviceCounters before = device_->counters();
    std::vector<scene::Entity> without_shadow = options_.off;
    without_shadow.insert(without_shadow.end(), options_.unshadowed.begin(),
                          options_.unshadowed.end());
    list_ = nullptr;
    auto frame = system_.begin_frame();
    const Status submitted = stage.adapter().submit(stage.scene(), frame, false,
                                                    shadows::NearCaps::Facing, without_shadow);
    if (!submitted) return submitted;
    list_ = &std::move(frame).finish(view);
    stats_ = list_->stats;
    shadows_ms_ = milliseconds_since(start);
    std::function<Status(std::size_t)> after_drawn;
    if (after_light) {
        after_drawn = [&](std::size_t i) {
            return after_light(number_of(stage.lights(), list_->lights[i].light));
        };
    }
    const Mood& mood = level.mood;
    const Status rendered = renderer_.render({.scene = stage.scene(),
                                              .view = view,
                                              .shadows = *list_,
                                              .after_light = after_drawn,
                                              .unshadowed = options_.unshadowed,
                                              .environment = {.sky = mood.sky,
                                                              .ground = mood.ground,
                                                              .background = mood.background,
                                                              .exposure = mood.exposure}});
    const gpu::DeviceCounters after = device_->counters();
    uploaded_bytes_ = after.uploaded_bytes - before.uploaded_bytes;
    draw_calls_ = after.draw_calls - before.draw_calls;
    return rendered;
}

Result<std::vector<std::byte>> Drawing::read_picture() {
    return device_->read_texture(renderer_.picture());
}

Result<std::vector<std::byte>> Drawing::read_mask(std::uint32_t sample) {
    return render::read_stencil(*device_, renderer_, sample);
}

}  // namespace gnomon::game
