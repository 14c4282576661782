// SPDX-License-Identifier: MIT
//
// Stage: a scene, its shadows and what draws them, with everything that the viewer lets one change
// while it is looked at. It has no window: tests draw it as the viewer does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/panel/lights.hpp>
#include <gnomon/panel/picker.hpp>
#include <gnomon/panel/probe.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/shadows/shadow_query.hpp>

#include "render_setup.hpp"

namespace gnomon::cli {

/// What a frame cost and drew.
struct FrameFigures {
    double detect_ms = 0.0;
    double build_ms = 0.0;
    double record_ms = 0.0;
    double device_ms = 0.0;  ///< submission, and waiting until it is drawn
    double frame_ms = 0.0;   ///< all of it, casters' submission included; the panel is not
    std::uint64_t upload_bytes = 0;
    std::uint64_t draw_calls = 0;
    shadows::FrameStats shadows;
};

/// What a light's stencil held, and the light as the scene had it.
struct LightMask {
    shadows::Light light;
    std::vector<std::vector<std::byte>> samples;  ///< a byte a pixel each, 0 = lit, row 0 on top
};

class Stage {
public:
    /// Reads the scene. Fails as make_shot() does.
    [[nodiscard]] static Result<Stage> load(const RenderOptions& options);

    /// Makes the renderer on a device and uploads the scene; again after the device was exchanged.
    /// The device outlives it, or set_device() or drop_device() is called first.
    [[nodiscard]] Status set_device(gpu::Device& device, const glm::uvec2& size_px);
    void drop_device();
    /// Whether it may draw: not after set_device() failed, nor after drop_device().
    [[nodiscard]] bool has_device() const { return renderer_.has_value(); }

    /// Draws, and waits until it is drawn, unless told not to. `options()` as they are now count.
    [[nodiscard]] Status draw(const shadows::View& view, const glm::uvec2& size_px);
    /// Draws without debug views and reads the stencil back after each light that casts a shadow,
    /// in the order of their keys. Fails with ErrorCode::Unsupported where a device cannot be
    /// waited for. figures() are of no use then.
    [[nodiscard]] Result<std::vector<LightMask>> draw_masks(const shadows::View& view,
                                                            const glm::uvec2& size_px);
    /// Where waiting is not possible, FrameFigures::device_ms is submission alone. The default
    /// waits.
    void wait_for_device(bool wait) { waits_ = wait; }
    [[nodiscard]] gpu::TextureId picture() const;
    [[nodiscard]] const FrameFigures& figures() const { return figures_; }
    /// Of the last draw(), where has_drawn(); good until the next one.
    [[nodiscard]] const shadows::DrawList& draw_list() const { return *list_; }
    /// Whether picture() and draw_list() hold anything: not after shadows_changed(), set_device()
    /// or drop_device(), until the next draw().
    [[nodiscard]] bool has_drawn() const { return list_ != nullptr; }

    /// Technique, strategy, savings, debug views, culling, samples: what may be changed between
    /// frames. Call shadows_changed() after a change to what the shadow system is made with.
    [[nodiscard]] RenderOptions& options() { return options_; }
    void shadows_changed();

    [[nodiscard]] const Shot& shot() const { return shot_; }
    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }

    /// With switches, which count from the next draw() on.
    [[nodiscard]] std::vector<panel::LightLine>& lights() { return lights_; }
    [[nodiscard]] const std::vector<panel::LightLine>& lights() const { return lights_; }
    [[nodiscard]] std::optional<std::size_t> light_of(scene::Entity entity) const;
    [[nodiscard]] glm::dvec3 handle_of(const panel::LightLine& light) const {
        return panel::handle_of(shot_.scene.registry, light.entity, shot_.bounds);
    }
    /// A light whose handle is so near the cursor; the nearest. Fingers need more than mice.
    [[nodiscard]] std::optional<std::size_t> light_under(const shadows::View& view,
                                                         const glm::uvec2& size_px,
                                                         const glm::dvec2& cursor_px,
                                                         double reach_px = 16.0) const;

    /// A floor below everything, for models that have nothing to cast a shadow on. Receives, and
    /// casts none. Nothing happens where the scene is empty. Its entity goes with it: see
    /// is_there().
    void show_ground(bool shown);
    [[nodiscard]] bool has_ground() const { return ground_.has_value(); }
    /// Whether an entity that was picked is still part of the scene.
    [[nodiscard]] bool is_there(scene::Entity entity) const {
        return shot_.scene.registry.valid(entity);
    }

    /// Which of the scene's animations are played; places in Scene::animations.
    void play(std::vector<std::size_t> animations) { shot_.animations = std::move(animations); }
    [[nodiscard]] Status set_time(double time_s);
    /// Of the longest animation that is played; 0 without.
    [[nodiscard]] double duration_s() const;

    /// Moves a node from where it was at the beginning of a drag (move_node()).
    [[nodiscard]] Status move(scene::Entity entity, const scene::LocalTransform& start_local,
                              const glm::dmat4& motion_world);

    [[nodiscard]] std::optional<panel::Hit> pick(const panel::Ray& ray) {
        return picker_.pick(shot_.scene, ray);
    }
    /// Of the lights as the last draw() had them: one that cast no shadow then lights whatever it
    /// reaches.
    [[nodiscard]] Result<std::optional<panel::Probe>> probe(const panel::Ray& ray);
    /// What is moved where this is dragged: of a skinned mesh, whose own pose has no say, the node
    /// above all its joints.
    [[nodiscard]] scene::Entity handle_node(scene::Entity entity) const;
    [[nodiscard]] scene::Bounds bounds_of(scene::Entity entity) const;
    [[nodiscard]] std::string name_of(scene::Entity entity) const;

private:
    explicit Stage(const RenderOptions& options, Shot shot);
    [[nodiscard]] render::RendererDesc renderer_desc(const glm::uvec2& size_px) const;
    [[nodiscard]] Status make_system();
    using AfterLight = std::function<Status(std::size_t light)>;  // FrameInput::after_light
    [[nodiscard]] Status draw_frame(const shadows::View& view, const glm::uvec2& size_px,
                                    const AfterLight& after_light);

    RenderOptions options_;
    Shot shot_;
    std::vector<panel::LightLine> lights_;
    std::uint64_t triangles_ = 0;
    std::optional<shadows::ShadowSystem> system_;
    scene::ShadowAdapter adapter_;
    shadows::ShadowQueries queries_;
    panel::Picker picker_;
    gpu::Device* device_ = nullptr;
    std::optional<render::Renderer> renderer_;
    std::optional<scene::Entity> ground_;
    std::optional<std::uint32_t> ground_material_;  // stays when the ground goes
    std::vector<scene::Entity> unshadowed_;         // lights of the last draw()
    bool upload_due_ = false;                       // meshes came or went
    bool waits_ = true;
    const shadows::DrawList* list_ = nullptr;  // the system's
    FrameFigures figures_;
};

}  // namespace gnomon::cli
