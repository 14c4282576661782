// SPDX-License-Identifier: MIT
//
// Viewer: the window, the stage in it, and what mouse and keys do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <gnomon/input/script.hpp>
#include <gnomon/ui/context.hpp>
#include <gnomon/ui/ui_pass.hpp>
#include <gnomon/window/window.hpp>

#include "view/orbit_camera.hpp"
#include "view/view_options.hpp"
#include "view/view_state.hpp"

namespace gnomon::cli {

class Viewer {
public:
    Viewer(const ViewOptions& options, window::Window window, Stage stage,
           std::optional<input::Script> script);

    [[nodiscard]] Status start();
    /// Until the window is closed, the script or the frames are over.
    [[nodiscard]] Status run();

private:
    // A mouse button that is held over the scene.
    struct Drag {
        enum class Kind { Orbit, Pan, Object };
        Kind kind = Kind::Orbit;
        input::MouseButton button = input::MouseButton::Left;
        std::optional<Selection> candidate = std::nullopt;  // selected if the mouse does not move
        glm::dvec2 begin_px{0.0};
        bool moved = false;
        // Of an object:
        scene::Entity node = {};
        scene::LocalTransform start_local = {};
        glm::dvec3 grabbed{0.0};
        glm::dvec3 pivot{0.0};
    };

    [[nodiscard]] bool is_over() const;
    [[nodiscard]] bool has_work(const input::Input& live) const;
    [[nodiscard]] Status frame(const input::Input& input, double dt_s);
    [[nodiscard]] Status draw(const input::Input& input, double dt_s);

    // viewer.cpp
    [[nodiscard]] Status attach();
    [[nodiscard]] Status exchange(window::Backend backend);
    void show(Stage stage, const std::string& source);
    [[nodiscard]] Status load(const std::string& source);
    [[nodiscard]] Status obey(const std::string& command);
    [[nodiscard]] Status grant_wishes();
    [[nodiscard]] Status save(const std::filesystem::path& path);
    [[nodiscard]] Canvas canvas() const;

    // controls.cpp
    [[nodiscard]] Status handle_keys(const input::Input& input);
    [[nodiscard]] Status handle_mouse(const input::Input& input);
    void begin_drag(const input::Input& input, input::MouseButton button);
    void begin_object_drag(const panel::Ray& ray);
    [[nodiscard]] Status drag_object(const input::Input& input);
    void end_drag();
    void select_next_light();
    void forget_what_is_gone();

    ViewOptions options_;
    window::Window window_;
    Stage stage_;
    std::optional<input::Script> script_;
    input::Input scripted_;
    ui::Context ui_;
    std::optional<ui::UiPass> ui_pass_;
    ViewState state_;
    OrbitCamera camera_;
    shadows::View view_;        // of this frame
    glm::uvec2 size_px_{0, 0};  // of the picture; while the window is minimised, of the one before
    std::optional<Drag> drag_;
    bool cursor_seen_ = false;
    std::uint64_t frames_ = 0;
    int frames_due_ = 3;  // drawn without anything having happened: widgets settle
};

}  // namespace gnomon::cli
