// SPDX-License-Identifier: MIT
//
// Front: the game in its window. It gives the screens what was pressed and obeys their orders, lets
// the world tick sixty times a second, and draws as often as the screen takes it.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <gnomon/input/script.hpp>
#include <gnomon/panel/picker.hpp>
#include <gnomon/ui/context.hpp>
#include <gnomon/ui/ui_pass.hpp>
#include <gnomon/window/window.hpp>

#include "capture.hpp"
#include "play/hands.hpp"
#include "play/pages.hpp"
#include "play/panel.hpp"
#include "play/play_options.hpp"
#include "play/session.hpp"
#include "play/settings_file.hpp"
#include "play/stepper.hpp"

namespace gnomon::game {

struct NamedLevel {
    std::string name;
    Level level;
};

class Front {
public:
    /// `levels`: at least one. `capture`: where pictures of ticks go, if anywhere.
    Front(const PlayOptions& options, std::vector<NamedLevel> levels, LoadedSettings settings,
          window::Window window, std::optional<input::Script> script,
          std::optional<Capture> capture);

    [[nodiscard]] Status start();
    /// Until the window is closed, somebody quits, or what was to be watched is over.
    [[nodiscard]] Status run();
    /// Of what was watched to its end.
    [[nodiscard]] const std::optional<Ended>& ended() const { return ended_; }

private:
    // front.cpp: frames
    [[nodiscard]] bool is_over() const;
    [[nodiscard]] Status frame(const input::Input& input, double dt_s);
    [[nodiscard]] Status simulate(const input::Input& input, double dt_s);
    [[nodiscard]] Status tick(const input::Input& input);
    void note_input(bool is_last);
    [[nodiscard]] Status draw(const input::Input& input, double dt_s);
    void show_marks(const shadows::View& view, const glm::uvec2& size, const glm::dvec2& cursor_px);
    [[nodiscard]] MenuPress press_of(const input::Input& input) const;
    [[nodiscard]] Status handle_keys(const input::Input& input);
    void update_cursor();
    [[nodiscard]] double until_due_s() const;
    [[nodiscard]] bool turns_by_mouse(const input::Input& input) const;
    [[nodiscard]] bool watches() const { return options_.watched.has_value(); }
    /// The level has not begun: nobody has moved yet.
    [[nodiscard]] bool waits() const { return !watches() && !is_under_way_; }
    [[nodiscard]] bool is_backdrop() const { return screens_.behind() == Screen::Title; }

    // front_deeds.cpp: what orders and scripts want
    [[nodiscard]] Status obey(const Order& order);
    [[nodiscard]] Status obey(const std::string& command);
    [[nodiscard]] Status begin_level(std::size_t level);
    [[nodiscard]] Status restart_level();
    [[nodiscard]] Status show_backdrop();
    [[nodiscard]] Status change(Setting setting, int by);
    void save();
    void save_what_is_sound();  ///< unless the file that is there could not be read
    void remember_win();
    [[nodiscard]] Status keep_recording() const;
    void report();
    [[nodiscard]] Status save_picture(const std::filesystem::path& path);
    [[nodiscard]] Status exchange(window::Backend backend);
    [[nodiscard]] Status switch_backend();
    [[nodiscard]] Status attach();
    [[nodiscard]] Status make_drawing();
    [[nodiscard]] Status refresh_ui();
    [[nodiscard]] glm::uvec2 picture_size() const;
    void say(std::string text);

    PlayOptions options_;
    std::vector<NamedLevel> levels_;
    std::vector<PageState::LevelLine> lines_;
    Settings settings_;
    Settings saved_;       // what the file holds, or would if it could be read
    bool file_is_broken_;  // nothing is written over it unasked
    Screens screens_;
    window::Window window_;
    std::optional<input::Script> script_;
    input::Input scripted_;
    std::optional<Capture> capture_;

    std::optional<Session> session_;
    std::size_t backdrop_ = 0;  // the level that the title shows
    std::optional<Drawing> drawing_;
    bool has_drawn_ = false;
    std::optional<ui::Context> ui_;
    Lettering letters_;
    float letters_unit_ = 0.0F;
    std::optional<ui::UiPass> ui_pass_;

    Stepper stepper_;
    Buttons buttons_;
    Look look_;
    PanelState panel_;
    panel::Picker picker_;
    scene::Bounds bounds_;  // of the level
    glm::uvec2 size_px_{0, 0};
    std::string note_;
    double note_s_ = 0.0;
    double time_s_ = 0.0;
    double screen_s_ = 0.0;  // since this screen came up
    double level_s_ = 0.0;   // since the level began
    double rested_s_ = 0.0;  // since the title's choice changed
    double hold_s_ = 0.0;    // for which the end of what was watched still stands
    double rules_ms_ = 0.0;
    bool is_under_way_ = false;
    bool picture_due_ = false;
    bool captured_ = false;
    int skipped_motions_ = 0;  // of a cursor that was put elsewhere
    bool over_ = false;
    std::uint64_t frames_ = 0;
    std::optional<Ended> ended_;
};

/// Reads and checks it; none of an empty path. Fails with ErrorCode::Io and as Script::parse().
[[nodiscard]] Result<std::optional<input::Script>> read_play_script(
    const std::filesystem::path& path);
[[nodiscard]] std::optional<window::Backend> window_backend_named(std::string_view name);

}  // namespace gnomon::game
