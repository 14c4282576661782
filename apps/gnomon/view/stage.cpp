// SPDX-License-Identifier: MIT
#include "view/stage.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <gnomon/core/expects.hpp>
#include <gnomon/render/light_choice.hpp>
#include <gnomon/scene/deform.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/transforms.hpp>

#include "view/mover.hpp"

namespace gnomon::cli {

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

Stage::Stage(const RenderOptions& options, Shot shot) : options_(options), shot_(std::move(shot)) {
    shot_.scene.registry.each<scene::Receiver, scene::MeshInstance>(
        [&](scene::Entity, const scene::Receiver&, const scene::MeshInstance& instance) {
            triangles_ += instance.mesh->triangle_count();
        });
    // What --light made is called so.
    lights_ = panel::lights_of(shot_.scene, "--light");
}

Result<Stage> Stage::load(const RenderOptions& options) {
    auto shot = make_shot(options);
    if (!shot) return forward_error(shot);
    return Stage(options, std::move(*shot));
}

render::RendererDesc Stage::renderer_desc(const glm::uvec2& size_px) const {
    return {.width = size_px.x,
            .height = size_px.y,
            .sample_count = options_.samples,
            .averted_faces = options_.near_caps == shadows::NearCaps::Averted
                                 ? shadow_pass::AvertedFaces::LeftToShading
                                 : shadow_pass::AvertedFaces::Shadowed,
            .cull_back_faces = options_.cull_back,
            .overlays = options_.overlays};
}

Status Stage::set_device(gpu::Device& device, const glm::uvec2& size_px) {
    drop_device();
    device_ = &device;
    auto renderer = render::Renderer::create(device, renderer_desc(size_px));
    if (!renderer) return forward_error(renderer);
    renderer_ = std::move(*renderer);
    return renderer_->upload(shot_.scene);
}

void Stage::drop_device() {
    list_ = nullptr;
    renderer_.reset();
    device_ = nullptr;
}

void Stage::shadows_changed() {
    list_ = nullptr;
    system_.reset();
}

Status Stage::make_system() {
    list_ = nullptr;
    auto system = shadows::ShadowSystem::create({.force_technique = options_.technique,
                                                 .silhouette = options_.silhouette,
                                                 .layer_bound = options_.layer_bound,
                                                 .receivers = shadows::Receivers::Submitted,
                                                 .fill = options_.fill});
    if (!system) return forward_error(system);
    system_.emplace(std::move(*system));
    return {};
}

Status Stage::draw(const shadows::View& view, const glm::uvec2& size_px) {
    return draw_frame(view, size_px, {});
}

Result<std::vector<LightMask>> Stage::draw_masks(const shadows::View& view,
                                                 const glm::uvec2& size_px) {
    std::vector<LightMask> masks;
    const auto keep = [&](std::size_t place) -> Status {
        const auto drawn = std::ranges::find(lights_, list_->lights[place].light,
                                             [](const auto& line) { return line.entity.key(); });
        GNOMON_EXPECTS(drawn != lights_.end());
        LightMask& mask = masks.emplace_back();
        mask.light = scene::shadow_light(shot_.scene.registry, drawn->entity).value();
        for (std::uint32_t sample = 0; sample < options_.samples; ++sample) {
            auto counts = render::read_stencil(*device_, *renderer_, sample);
            if (!counts) return forward_error(counts);
            mask.samples.push_back(std::move(*counts));
        }
        return {};
    };
    const render::Overlays shown = std::exchange(options_.overlays, {});
    const Status drawn = draw_frame(view, size_px, keep);
    options_.overlays = shown;
    if (!drawn) return forward_error(drawn);
    return masks;
}

Status Stage::draw_frame(const shadows::View& view, const glm::uvec2& size_px,
                         const AfterLight& after_light) {
    GNOMON_EXPECTS(renderer_.has_value());
    if (!system_) {
        if (const Status made = make_system(); !made) return made;
    }
    if (const Status done = renderer_->reconfigure(renderer_desc(size_px)); !done) return done;
    if (std::exchange(upload_due_, false)) {
        if (const Status uploaded = renderer_->upload(shot_.scene); !uploaded) return uploaded;
    }
    const auto start = Clock::now();
    const gpu::DeviceCounters before = device_->counters();

    const panel::SwitchedLights lights = panel::switched(lights_);
    unshadowed_ = lights.unshadowed;
    if (options_.max_shadowed_lights) {
        const auto choice = render::choose_shadowed_lights(
            shot_.scene, shot_.bounds, view, *options_.max_shadowed_lights, lights.off);
        for (const scene::Entity light : choice.unshadowed) {
            if (std::ranges::find(unshadowed_, light) == unshadowed_.end()) {
                unshadowed_.push_back(light);
            }
        }
    }
    std::vector<scene::Entity> without_shadow = unshadowed_;
    without_shadow.insert(without_shadow.end(), lights.off.begin(), lights.off.end());
    list_ = nullptr;
    auto frame = system_->begin_frame();
    if (const Status submitted = adapter_.submit(shot_.scene, frame, options_.cull_back,
                                                 options_.near_caps, without_shadow);
        !submitted) {
        return submitted;
    }
    list_ = &std::move(frame).finish(view);
    if (const Status drawn =
            renderer_->render({shot_.scene, view, *list_, after_light, unshadowed_});
        !drawn) {
        return drawn;
    }
    const auto waiting = Clock::now();
    if (const Status idle = waits_ ? device_->wait_idle() : Status(); !idle) return idle;

    const gpu::DeviceCounters after = device_->counters();
    figures_.detect_ms = list_->stats.detect_ms;
    figures_.build_ms = list_->stats.build_ms;
    figures_.record_ms = renderer_->times().record_ms;
    figures_.device_ms = renderer_->times().submit_ms + ms_since(waiting);
    figures_.frame_ms = ms_since(start);
    figures_.upload_bytes = after.uploaded_bytes - before.uploaded_bytes;
    figures_.draw_calls = after.draw_calls - before.draw_calls;
    figures_.shadows = list_->stats;
    return {};
}

gpu::TextureId Stage::picture() const { return renderer_->picture(); }

std::optional<std::size_t> Stage::light_of(scene::Entity entity) const {
    const auto found = std::ranges::find(lights_, entity, &panel::LightLine::entity);
    if (found == lights_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - lights_.begin());
}

std::optional<std::size_t> Stage::light_under(const shadows::View& view, const glm::uvec2& size_px,
                                              const glm::dvec2& cursor_px, double reach_px) const {
    std::optional<std::size_t> nearest;
    double best = reach_px;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const auto pixel = panel::pixel_of(view, handle_of(lights_[i]), size_px);
        if (!pixel || !(glm::distance(*pixel, cursor_px) < best)) continue;
        best = glm::distance(*pixel, cursor_px);
        nearest = i;
    }
    return nearest;
}

void Stage::show_ground(bool shown) {
    if (shown == has_ground() || shot_.bounds.empty()) return;
    scene::Registry& registry = shot_.scene.registry;
    upload_due_ = true;
    if (!shown) {
        registry.destroy(*ground_);
        ground_.reset();
        return;
    }
    const double size_m = std::max(shot_.bounds.diagonal(), 1e-6);
    const glm::dvec3 middle = shot_.bounds.center();
    // A little below, so that a floor of the scene's own stays on top.
    const scene::LocalTransform local{
        .translation = {middle.x, shot_.bounds.min.y - 5e-4 * size_m, middle.z}};
    if (!ground_material_) {
        ground_material_ = static_cast<std::uint32_t>(shot_.scene.materials.size());
        scene::Material& stone = shot_.scene.materials.emplace_back();
        stone.name = "ground";
        stone.base_color = {0.42F, 0.42F, 0.43F, 1.0F};
        stone.roughness = 0.95F;
    }
    const auto side_m = static_cast<float>(4.0 * size_m);
    ground_ = shot_.scene.create_node("ground", local);
    registry.emplace<scene::MeshInstance>(
        *ground_, std::make_shared<const scene::Mesh>(
                      scene::make_plane(side_m, side_m, 1, *ground_material_)));
    registry.emplace<scene::Receiver>(*ground_);
}

Status Stage::set_time(double time_s) { return pose_at(shot_, time_s); }

double Stage::duration_s() const {
    double longest = 0.0;
    for (const std::size_t animation : shot_.animations) {
        longest = std::max(longest, shot_.scene.animations[animation].duration_s);
    }
    return longest;
}

Status Stage::move(scene::Entity entity, const scene::LocalTransform& start_local,
                   const glm::dmat4& motion_world) {
    move_node(shot_.scene.registry, entity, start_local, motion_world);
    scene::update_world_transforms(shot_.scene.registry);
    return scene::deform(shot_.scene);
}

Result<std::optional<panel::Probe>> Stage::probe(const panel::Ray& ray) {
    const auto hit = pick(ray);
    if (!hit) return std::optional<panel::Probe>();
    const auto casters = adapter_.casters(shot_.scene, options_.cull_back, options_.near_caps);
    if (!casters) return forward_error(casters);
    queries_.update(*casters);
    return std::optional(panel::probe_at(*hit, shot_.scene.registry, queries_, lights_, unshadowed_,
                                         shot_.bounds.diagonal()));
}

scene::Entity Stage::handle_node(scene::Entity entity) const {
    const scene::Registry& registry = shot_.scene.registry;
    const auto* skin = registry.try_get<scene::Skin>(entity);
    if (skin == nullptr || skin->joints.empty()) return entity;
    const auto* parent_of_mesh = registry.try_get<scene::Parent>(entity);
    scene::Entity node = skin->joints.front();
    while (const auto* parent = registry.try_get<scene::Parent>(node)) {
        const bool shared = parent_of_mesh != nullptr && parent_of_mesh->value == parent->value;
        if (shared || !registry.has<scene::LocalTransform>(parent->value)) break;
        node = parent->value;
    }
    return registry.has<scene::LocalTransform>(node) ? node : entity;
}

scene::Bounds Stage::bounds_of(scene::Entity entity) const {
    scene::Bounds bounds;
    const scene::Registry& registry = shot_.scene.registry;
    const auto* instance = registry.try_get<scene::MeshInstance>(entity);
    const auto* world = registry.try_get<scene::WorldTransform>(entity);
    if (instance == nullptr || world == nullptr) return bounds;
    const scene::Geometry geometry = scene::geometry_of(registry, entity, *instance, *world);
    for (const glm::vec3& p : geometry.positions) {
        bounds.include(glm::dvec3(geometry.world_from_positions * glm::dvec4(p, 1.0)));
    }
    return bounds;
}

std::string Stage::name_of(scene::Entity entity) const {
    const auto* name = shot_.scene.registry.try_get<scene::Name>(entity);
    return name == nullptr ? std::string() : one_line(name->value);
}

}  // namespace gnomon::cli
