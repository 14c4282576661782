// SPDX-License-Identifier: MIT
//
// What the viewer remembers between frames: the panel shows and changes it, the viewer acts on it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/panel/choices.hpp>
#include <gnomon/panel/probe.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/ui/chart.hpp>

#include "view/mover.hpp"
#include "view/stage.hpp"

namespace gnomon::cli {

/// What a drag moves. None: the camera.
struct Selection {
    enum class Kind { Camera, Light, Caster };
    Kind kind = Kind::Camera;
    scene::Entity entity = {};
    bool operator==(const Selection&) const = default;
};

/// Asked for by a key or a button; done at the end of the frame.
struct Wishes {
    bool screenshot = false;
    bool other_backend = false;
    bool frame_all = false;
    bool reload = false;
};

inline constexpr std::size_t chart_frames = 140;

struct ViewState {
    std::string source;
    std::string backend;  ///< "gl", "vk"
    std::string adapter;
    bool can_switch = false;  ///< there are two backends

    float unit = 1.0F;  ///< pixels of the panel's layout are so many of the screen's
    bool panel = true;
    bool help = true;
    gnomon::panel::Marks marks;

    bool playing = false;
    double time_s = 0.0;
    double speed = 1.0;

    MoveMode mode = MoveMode::Rotate;
    Selection selection;
    std::optional<gnomon::panel::Probe> probe;
    glm::dvec2 cursor_px{0.0};

    ui::ChartHistory shadow_times{3, chart_frames};  ///< detect, build, record
    ui::ChartHistory frame_times{2, chart_frames};   ///< CPU, device

    std::string note;
    double note_s = 0.0;  ///< how long it is still shown
    Wishes wishes;

    void say(std::string text) {
        note = std::move(text);
        note_s = 4.0;
    }
    void add_times(const FrameFigures& figures);
};

}  // namespace gnomon::cli
