// SPDX-License-Identifier: MIT
//
// What mouse and keys do in the viewer.
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "view/viewer.hpp"

namespace gnomon::cli {

namespace {

using input::Key;
using input::MouseButton;

constexpr double radians_per_pixel = 0.008;
/// A click is a press that moves no farther.
constexpr double click_px = 4.0;
constexpr double step_s = 1.0 / 30.0;

}  // namespace

Status Viewer::handle_keys(const input::Input& input) {
    if (input.control() || input.alt()) return {};
    const auto pressed = [&](Key key) { return input.was_pressed(key); };
    if (pressed(Key::Tab)) state_.panel = !state_.panel;
    if (pressed(Key::F1)) state_.help = !state_.help;
    if (pressed(Key::Q)) state_.marks.probe = !state_.marks.probe;
    if (pressed(Key::G)) {
        stage_.show_ground(!stage_.has_ground());
        forget_what_is_gone();
    }
    if (pressed(Key::P)) state_.wishes.screenshot = true;
    if (pressed(Key::B)) state_.wishes.other_backend = true;
    if (pressed(Key::F)) state_.wishes.frame_all = true;
    if (pressed(Key::F5)) state_.wishes.reload = true;
    if (pressed(Key::F11)) window_.set_fullscreen(!window_.is_fullscreen());
    if (pressed(Key::T)) state_.mode = MoveMode::Translate;
    if (pressed(Key::R)) state_.mode = MoveMode::Rotate;
    if (pressed(Key::C) || pressed(Key::Escape)) state_.selection = {};
    if (pressed(Key::L)) select_next_light();

    const auto views = panel::overlay_switches(stage_.options().overlays);
    for (std::size_t i = 0; i < views.size(); ++i) {
        const auto key = static_cast<Key>(static_cast<std::size_t>(Key::Digit1) + i);
        if (pressed(key)) *views[i] = !*views[i];
    }
    if (stage_.shot().scene.animations.empty()) return {};
    if (pressed(Key::Space)) state_.playing = !state_.playing;
    const auto stepped = [&](Key key) { return pressed(key) || input.was_repeated(key); };
    const double step = (stepped(Key::Right) ? step_s : 0.0) - (stepped(Key::Left) ? step_s : 0.0);
    if (step == 0.0) return {};
    state_.playing = false;
    state_.time_s += step;
    return stage_.set_time(state_.time_s);
}

// The ground may be selected, or held, while it is taken away.
void Viewer::forget_what_is_gone() {
    const auto gone = [&](const Selection& selection) {
        return selection.kind != Selection::Kind::Camera && !stage_.is_there(selection.entity);
    };
    if (gone(state_.selection)) state_.selection = {};
    if (!drag_) return;
    const bool object_gone = drag_->kind == Drag::Kind::Object && !stage_.is_there(drag_->node);
    if (object_gone || (drag_->candidate && gone(*drag_->candidate))) drag_.reset();
}

void Viewer::select_next_light() {
    const auto& lights = stage_.lights();
    if (lights.empty()) return;
    std::size_t next = 0;
    if (state_.selection.kind == Selection::Kind::Light) {
        next = (stage_.light_of(state_.selection.entity).value_or(lights.size() - 1) + 1) %
               lights.size();
    }
    state_.selection = {Selection::Kind::Light, lights[next].entity};
}

Status Viewer::handle_mouse(const input::Input& input) {
    if (drag_) {
        const glm::dvec2 motion = input.cursor_motion_px();
        if (glm::distance(input.cursor_px(), drag_->begin_px) > click_px) drag_->moved = true;
        if (drag_->kind == Drag::Kind::Pan) {
            camera_.pan(motion, canvas());
        } else if (drag_->kind == Drag::Kind::Orbit && drag_->moved) {
            camera_.orbit(-motion.x * radians_per_pixel, -motion.y * radians_per_pixel);
        } else if (drag_->kind == Drag::Kind::Object && motion != glm::dvec2(0.0)) {
            if (const Status moved = drag_object(input); !moved) return moved;
        }
        if (!input.is_down(drag_->button)) end_drag();
    }
    if (ui_.wants_mouse()) return {};
    if (input.scroll.y != 0.0) camera_.zoom(input.scroll.y);
    for (const MouseButton button : {MouseButton::Left, MouseButton::Right, MouseButton::Middle}) {
        if (!drag_ && input.was_pressed(button)) begin_drag(input, button);
    }
    // Pressed and let go within one frame.
    if (drag_ && !input.is_down(drag_->button)) end_drag();
    return {};
}

void Viewer::begin_drag(const input::Input& input, MouseButton button) {
    Drag drag{.button = button, .begin_px = input.cursor_px()};
    const bool moves = state_.mode == MoveMode::Translate;
    if (button != MouseButton::Left) {
        drag.kind = Drag::Kind::Pan;
        drag_ = drag;
        return;
    }
    const panel::Ray ray = panel::ray_through(view_, input.cursor_px(), size_px_);
    if (const auto light = stage_.light_under(view_, size_px_, input.cursor_px())) {
        // A handle is small and there to be dragged: no click before.
        state_.selection = {Selection::Kind::Light, stage_.lights()[*light].entity};
        drag.kind = Drag::Kind::Object;
    } else if (const auto hit = stage_.pick(ray)) {
        drag.candidate = Selection{Selection::Kind::Caster, hit->entity};
        if (drag.candidate == state_.selection) drag.kind = Drag::Kind::Object;
    } else {
        drag.candidate = Selection{};
    }
    // Whoever pans with the left button does so wherever it goes down.
    if (drag.kind == Drag::Kind::Orbit && moves &&
        state_.selection.kind == Selection::Kind::Camera) {
        drag.kind = Drag::Kind::Pan;
    }
    drag_ = drag;
    if (drag.kind == Drag::Kind::Object) begin_object_drag(ray);
}

void Viewer::begin_object_drag(const panel::Ray& ray) {
    const scene::Bounds& all = stage_.shot().bounds;
    drag_->node = stage_.handle_node(state_.selection.entity);
    drag_->start_local = stage_.shot().scene.registry.get<scene::LocalTransform>(drag_->node);
    drag_->pivot = all.empty() ? glm::dvec3(0.0) : all.center();
    if (state_.selection.kind == Selection::Kind::Light) {
        const panel::LightLine& light = stage_.lights()[*stage_.light_of(state_.selection.entity)];
        drag_->grabbed = stage_.handle_of(light);
        // A spot light is turned where it hangs; others go round the scene.
        if (stage_.shot().scene.registry.has<scene::SpotLight>(light.entity)) {
            drag_->pivot = drag_->grabbed;
        }
        return;
    }
    if (const auto hit = stage_.pick(ray)) drag_->grabbed = hit->point_world;
    const scene::Bounds own = stage_.bounds_of(state_.selection.entity);
    if (!own.empty()) drag_->pivot = own.center();
}

Status Viewer::drag_object(const input::Input& input) {
    glm::dmat4 motion(1.0);
    if (state_.mode == MoveMode::Rotate) {
        const glm::dvec2 pixels = input.cursor_px() - drag_->begin_px;
        motion = turned_about(drag_->pivot, glm::dvec3(camera_.world_from_camera()[0]),
                              pixels.x * radians_per_pixel, pixels.y * radians_per_pixel);
    } else {
        const glm::dvec3 normal = input.shift() ? glm::dvec3(0.0, 1.0, 0.0) : -camera_.forward();
        const panel::Ray ray = panel::ray_through(view_, input.cursor_px(), size_px_);
        const auto way = dragged_in_plane(ray, drag_->grabbed, normal);
        if (!way) return {};
        const auto light = state_.selection.kind == Selection::Kind::Light
                               ? stage_.light_of(state_.selection.entity)
                               : std::nullopt;
        if (light &&
            panel::is_directional(stage_.shot().scene.registry, stage_.lights()[*light].entity)) {
            motion = turned_towards(drag_->pivot, drag_->grabbed - drag_->pivot,
                                    drag_->grabbed + *way - drag_->pivot);
        } else {
            motion = glm::translate(glm::dmat4(1.0), *way);
        }
    }
    return stage_.move(drag_->node, drag_->start_local, motion);
}

void Viewer::end_drag() {
    if (!drag_->moved && drag_->candidate) state_.selection = *drag_->candidate;
    drag_.reset();
}

}  // namespace gnomon::cli
