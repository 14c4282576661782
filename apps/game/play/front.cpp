// SPDX-License-Identifier: MIT
//
// Frames: from input to picture.
#include "play/front.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include <gnomon/panel/figures.hpp>
#include <gnomon/panel/probe_card.hpp>

#include "frame_times.hpp"
#include "play/hud.hpp"
#include "play/pacer.hpp"

namespace gnomon::game {

namespace {

using FrameClock = std::chrono::steady_clock;

/// A device that is lost as often without a frame between will be lost again.
constexpr int most_device_losses = 3;
/// How long the end of a recording stands, at its speed.
constexpr double end_stands_s = 2.0;
constexpr double backdrop_after_s = 0.35;

}  // namespace

Front::Front(const PlayOptions& options, std::vector<NamedLevel> levels, LoadedSettings settings,
             window::Window window, std::optional<input::Script> script,
             std::optional<Capture> capture)
    : options_(options),
      levels_(std::move(levels)),
      settings_(std::move(settings.settings)),
      saved_(settings_),
      file_is_broken_(!settings.complaint.empty()),
      screens_({.levels = levels_.size(), .watches = options.watched.has_value()}),
      window_(std::move(window)),
      script_(std::move(script)),
      capture_(std::move(capture)),
      stepper_(options.watched ? options.speed : 1.0) {
    for (const NamedLevel& level : levels_) {
        const bool won = std::ranges::find(settings_.won, level.name) != settings_.won.end();
        lines_.push_back({level.level.name, won});
    }
    say(std::move(settings.complaint));
}

Status Front::start() {
    size_px_ = window_.size_px();
    if (settings_.fullscreen && !script_ && !options_.size_px) window_.set_fullscreen(true);
    const std::string& wanted = watches() ? options_.watched->level : options_.level;
    Status begun;
    if (wanted.empty()) {
        begun = show_backdrop();
    } else {
        const auto level = std::ranges::find(levels_, wanted, &NamedLevel::name);
        const auto place = static_cast<std::size_t>(level - levels_.begin());
        screens_.begin(place);
        begun = begin_level(place);
    }
    if (!begun) return begun;
    if (watches()) session_->follow(options_.watched->inputs);
    return attach();
}

bool Front::is_over() const {
    if (over_ || window_.input().close_requested ||
        (options_.frames && frames_ >= *options_.frames)) {
        return true;
    }
    if (!script_) return false;
    if (scripted_.close_requested) return true;
    // What is watched is watched to its end.
    return !watches() && !options_.frames && frames_ > script_->last_frame() + 2;
}

bool Front::turns_by_mouse(const input::Input& input) const {
    return captured_ || (input.is_down(input::MouseButton::Right) && !ui_->wants_mouse());
}

MenuPress Front::press_of(const input::Input& input) const {
    MenuPress press = menu_press(input, buttons_);
    if (screens_.now() == Screen::Playing || ui_->wants_mouse()) return press;
    const float unit = unit_of(size_px_);
    const glm::vec2 point = glm::vec2(input.cursor_px()) / unit;
    const auto boxes = item_boxes(screens_, glm::vec2(size_px_) / unit);
    const auto under = item_at(boxes, point);
    if (!under) return press;
    if (input.cursor_motion_px() != glm::dvec2(0.0)) press.pointed = under;
    const bool is_setting = screens_.items()[*under].kind == MenuItem::Kind::Setting;
    if (is_setting && input.scroll.y != 0.0) {
        press.pointed = under;
        press.right = input.scroll.y > 0.0 ? 1 : -1;
    }
    if (!input.was_pressed(input::MouseButton::Left)) return press;
    press.pointed = under;
    // Of a setting, the two ends of its value step it up and down.
    const float from_right = boxes[*under].max.x - point.x;
    if (is_setting && from_right < 200.0F) {
        press.right = from_right < 70.0F ? 1 : -1;
    } else {
        press.accept = true;
    }
    return press;
}

Status Front::handle_keys(const input::Input& input) {
    using input::Key;
    const auto pressed = [&](Key key) { return input.was_pressed(key); };
    if (pressed(Key::F1) || buttons_.was_pressed(PadButton::Y)) panel_.shown = !panel_.shown;
    if (panel_.shown || screens_.now() == Screen::Playing) {
        const auto switches = panel::overlay_switches(panel_.drawing.overlays);
        for (std::size_t i = 0; i < switches.size(); ++i) {
            const auto key = static_cast<Key>(static_cast<std::size_t>(Key::Digit1) + i);
            if (pressed(key)) *switches[i] = !*switches[i];
        }
    }
    if (pressed(Key::F11)) {
        settings_.fullscreen = !window_.is_fullscreen();
        window_.set_fullscreen(settings_.fullscreen);
        skipped_motions_ = 3;
    }
    if (pressed(Key::F12)) {
        for (int i = 1;; ++i) {
            const std::filesystem::path path = fmt::format("gnomon-game-{}.png", i);
            std::error_code error;
            if (std::filesystem::exists(path, error) && !error) continue;
            const Status kept = save_picture(path);
            say(kept ? fmt::format("Kept {}", path.string()) : kept.error().message);
            break;
        }
    }
    if (pressed(Key::F2) || std::exchange(panel_.wants_other_backend, false)) {
        return switch_backend();
    }
    return {};
}

// While somebody plays the mouse turns the camera and nothing else.
void Front::update_cursor() {
    const bool wanted =
        screens_.now() == Screen::Playing && !watches() && !script_ && !panel_.shown;
    if (wanted == captured_) return;
    captured_ = wanted;
    window_.capture_cursor(wanted);
    skipped_motions_ = 2;
}

// What follows from an input of the level that is played, a restart's included.
void Front::note_input(bool is_last) {
    picture_due_ = session_->inputs() % options_.every == 0 || is_last;
    if (!options_.record.empty() && session_->has_just_filled_recording()) {
        say("The recording is full: it holds this level's first hour.");
    }
}

Status Front::tick(const input::Input& input) {
    Session& session = *session_;
    const Level& level = session.world().level();
    if (is_backdrop()) {
        const bool done = session.is_over() || session.world().outcome() != Outcome::Playing;
        return done ? session.restart() : session.tick({});
    }
    const Status ticked =
        session.tick(input_of(pad_of(input), level.camera.yaw_rad + look_.yaw_rad));
    if (!ticked) return ticked;
    const World& world = session.world();
    const bool is_last = watches() ? session.is_over() : world.outcome() != Outcome::Playing;
    note_input(is_last);
    if (!is_last) return {};
    if (watches()) {
        ended_ = Ended{.outcome = world.outcome(), .ticks = world.now(), .hash = world.hash()};
        hold_s_ = end_stands_s / options_.speed;
    } else {
        if (world.outcome() == Outcome::Won) remember_win();
        screens_.ended(world.outcome());
    }
    return {};
}

Status Front::simulate(const input::Input& input, double dt_s) {
    const bool plays = screens_.now() == Screen::Playing;
    rules_ms_ = 0.0;
    if (!plays && !is_backdrop()) return {};
    if (plays) {
        level_s_ += dt_s;
        LookOptions options{.by_mouse = turns_by_mouse(input) && skipped_motions_ == 0,
                            .by_wheel = captured_ || !ui_->wants_mouse(),
                            .mouse_speed = settings_.mouse_speed,
                            .inverted = settings_.mouse_inverted};
        look_ = turned(look_, session_->world().level().camera, input, options, dt_s);
        if (ended_) {
            hold_s_ -= dt_s;
            over_ = hold_s_ <= 0.0;
            return {};
        }
    }
    const auto begin = FrameClock::now();
    if (plays && !watches() && !is_under_way_) {
        // Whoever reads what the level has to say is not caught meanwhile.
        is_under_way_ = pad_of(input) != Pad{};
        if (!is_under_way_) return {};
    }
    const bool captures = capture_ && plays;
    if (captures && picture_due_) return {};  // of how it begins
    const Screen before = screens_.now();
    for (std::uint32_t due = stepper_.advance(dt_s); due > 0; --due) {
        if (const Status ticked = tick(input); !ticked) return ticked;
        if (ended_ || screens_.now() != before) break;
        if (captures && picture_due_) break;
    }
    rules_ms_ = milliseconds_since(begin);
    return {};
}

// Between begin_frame() and end_frame(), of what was drawn.
void Front::show_marks(const shadows::View& view, const glm::uvec2& size,
                       const glm::dvec2& cursor_px) {
    if (drawing_->draw_list() != nullptr) {
        panel::show_bounds(panel_.marks, *drawing_->draw_list(), size);
    }
    const bool asks = panel_.shown && panel_.marks.probe && !captured_ && !ui_->wants_mouse();
    if (!asks) return;
    const Stage& stage = session_->world().stage();
    const auto hit = picker_.pick(stage.scene(), panel::ray_through(view, cursor_px, size));
    if (!hit) return;
    const scene::Registry& registry = stage.scene().registry;
    const panel::Probe probe =
        panel::probe_at(*hit, registry, stage.queries(), panel_.lights, {}, bounds_.diagonal());
    panel::show_probe(probe, registry,
                      {.view = view,
                       .size_px = size,
                       .cursor_px = cursor_px,
                       .bounds = bounds_,
                       .lights = panel_.lights});
}

Status Front::draw(const input::Input& input, double dt_s) {
    const auto begin = FrameClock::now();
    const glm::uvec2 size = picture_size();
    panel_.drawing.width = size.x;
    panel_.drawing.height = size.y;
    panel_.drawing.samples = options_.samples.value_or(settings_.samples);
    panel::SwitchedLights lights = panel::switched(panel_.lights);
    panel_.drawing.off = std::move(lights.off);
    panel_.drawing.unshadowed = std::move(lights.unshadowed);
    if (!drawing_) {
        if (const Status made = make_drawing(); !made) return made;
    }
    if (const Status done = drawing_->configure(panel_.drawing); !done) return done;
    if (const Status fresh = refresh_ui(); !fresh) return fresh;

    World& world = session_->world();
    Look look = look_;
    if (is_backdrop()) look = {.yaw_rad = 0.35 * std::sin(time_s_ * 0.11), .nearer = 1.15};
    const double aspect = static_cast<double>(size.x) / size.y;
    const shadows::View view = follow(world.level(), world.player(), aspect, look);

    // The panel lives in the picture, whose pixels may be larger than the window's.
    input::Input in_picture = input;
    in_picture.move_cursor(input.cursor_px() * glm::dvec2(size) / glm::dvec2(size_px_));
    ui_->begin_frame(in_picture, size, dt_s);
    const Canvas canvas(letters_, size);
    if (screens_.now() == Screen::Playing) {
        draw_hud(canvas, *session_, view,
                 {.shown_s = level_s_, .watches = watches(), .waits = waits()});
    }
    draw_page(canvas, screens_,
              {.levels = lines_,
               .settings = settings_,
               .backend = panel_.backend,
               .adapter = panel_.adapter,
               .shown_s = screen_s_,
               .time_s = time_s_,
               .session = &*session_});
    draw_note(canvas, note_, static_cast<float>(std::min(1.0, note_s_ * 2.0)));

    const bool is_kept = picture_due_ && capture_ && !is_backdrop();
    const auto after_light =
        is_kept ? capture_->after_light(*drawing_) : std::function<Status(std::size_t)>();
    if (const Status drawn = drawing_->draw(world.stage(), world.level(), view, after_light);
        !drawn) {
        return drawn;
    }
    panel_.add_figures(*drawing_);
    // What they change is drawn in the next frame.
    show_marks(view, size, in_picture.cursor_px());
    show_panel(panel_, canvas.unit());
    const gpu::TextureId picture = drawing_->renderer().picture();
    if (const Status drawn = ui_pass_->draw(ui_->end_frame(), picture, size.x, size.y); !drawn) {
        return drawn;
    }
    has_drawn_ = true;
    if (is_kept) {
        if (const Status kept = capture_->keep(*drawing_, session_->inputs()); !kept) return kept;
        if (ended_) ended_->pictures = capture_->pictures();
    }
    picture_due_ = false;
    const auto drawn = FrameClock::now();
    const Status shown = window_.present(picture);
    const double shadows_ms = panel_.shadows.detect_ms + panel_.shadows.build_ms;
    const auto number = [](double ms) { return static_cast<float>(std::max(ms, 0.0)); };
    panel_.add_times({number(rules_ms_), number(shadows_ms),
                      number(milliseconds_between(begin, drawn) - shadows_ms),
                      number(milliseconds_since(drawn))},
                     number(dt_s * 1e3));
    return shown;
}

Status Front::frame(const input::Input& input, double dt_s) {
    for (const std::string& command : input.commands) {
        if (const Status done = obey(command); !done) return done;
    }
    const glm::uvec2 size_px = window_.size_px();
    if (size_px.x == 0 || size_px.y == 0) return {};
    size_px_ = size_px;
    if (const Status fresh = refresh_ui(); !fresh) return fresh;
    buttons_.see(input);
    time_s_ += dt_s;
    screen_s_ += dt_s;
    note_s_ = std::max(0.0, note_s_ - dt_s);

    if (const Status handled = handle_keys(input); !handled) return handled;
    const Screen before = screens_.now();
    const std::size_t level_before = screens_.level();
    const Order order = screens_.press(press_of(input));
    if (const Status done = obey(order); !done) return done;
    if (over_) return {};
    rested_s_ = screens_.level() == level_before ? rested_s_ + dt_s : 0.0;
    // Behind the title is the level that is chosen there, once the choice rests.
    if (is_backdrop() && backdrop_ != screens_.level() && rested_s_ > backdrop_after_s) {
        if (const Status shown = show_backdrop(); !shown) return shown;
    }
    if (const Status done = simulate(input, dt_s); !done) return done;
    if (screens_.now() != before) screen_s_ = 0.0;
    update_cursor();
    skipped_motions_ = std::max(0, skipped_motions_ - 1);
    return draw(input, dt_s);
}

// Menus and ends have no ticks, but as many frames.
double Front::until_due_s() const {
    const bool runs = (screens_.now() == Screen::Playing && !ended_ && !waits()) || is_backdrop();
    return runs ? stepper_.until_next_s() : tick_s;
}

Status Front::run() {
    FrameClock::time_point before = FrameClock::now();
    int losses = 0;  // one after the other
    const auto sleep = [](double s) {
        std::this_thread::sleep_for(std::chrono::duration<double>(s));
    };
    const bool by_clock = !script_ && !options_.frames;
    while (!is_over()) {
        if (by_clock) {
            // What is polled is drawn: so the wait comes first.
            const double early_s = least_frame_s - milliseconds_since(before) * 1e-3;
            if (early_s > 0.0) sleep(early_s);
        }
        const input::Input& live = window_.poll();
        if (script_) {
            scripted_.begin_frame();
            script_->play(frames_, scripted_);
        }
        const auto now = FrameClock::now();
        if (window_.is_minimised() && !script_) {
            if (screens_.now() == Screen::Playing) {
                static_cast<void>(screens_.press({.interrupted = true}));
            }
            update_cursor();
            before = now;
            continue;
        }
        const double dt_s = milliseconds_between(before, now) * 1e-3;
        const double nap = nap_s(dt_s, until_due_s());
        if (by_clock && nap > 0.0 && !live.anything_happened()) {
            sleep(nap);
            continue;
        }
        before = now;
        Status done = frame(script_ ? scripted_ : live,
                            by_clock ? std::min(dt_s, Stepper::longest_s) : tick_s);
        if (done) losses = 0;
        while (!done && done.error().code == ErrorCode::DeviceLost &&
               ++losses < most_device_losses) {
            done = exchange(window_.backend());
        }
        if (!done) {
            // What failed costs nobody what was pressed, or set.
            if (!watches()) static_cast<void>(keep_recording());
            save_what_is_sound();
            return done;
        }
        ++frames_;
    }
    save_what_is_sound();
    if (!watches()) {
        if (const Status kept = keep_recording(); !kept) return kept;
    }
    return options_.screenshot.empty() ? Status() : save_picture(options_.screenshot);
}

}  // namespace gnomon::game
