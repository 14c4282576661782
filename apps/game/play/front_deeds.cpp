// SPDX-License-Identifier: MIT
//
// What the menus' orders and a script's commands want done: levels begun, settings changed and
// kept, pictures, and another backend while the game goes on.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include <gnomon/core/expects.hpp>

#include "assets.hpp"
#include "files.hpp"
#include "play/front.hpp"
#include "process_memory.hpp"
#include "size_text.hpp"

namespace gnomon::game {

namespace {

constexpr double note_stands_s = 4.0;
constexpr float panel_font_units = 15.0F;

}  // namespace

void Front::say(std::string text) {
    note_ = std::move(text);
    note_s_ = note_stands_s;
}

glm::uvec2 Front::picture_size() const {
    const double scale = settings_.scale_percent / 100.0;
    return glm::max(glm::uvec2(glm::round(glm::dvec2(size_px_) * scale)), glm::uvec2(1));
}

Status Front::begin_level(std::size_t level) {
    if (const Status kept = keep_recording(); !kept) say(kept.error().message);
    auto session = Session::begin(levels_[level].level, levels_[level].name);
    if (!session) return forward_error(session);
    session_.emplace(std::move(*session));
    drawing_.reset();
    has_drawn_ = false;
    const scene::Scene& scene = session_->world().stage().scene();
    panel_.lights = panel::lights_of(scene);
    panel_.drawing.off.clear();
    panel_.drawing.unshadowed.clear();
    bounds_ = scene::world_bounds(scene);
    picker_ = {};
    look_ = {};
    stepper_.reset();
    level_s_ = screen_s_ = 0.0;
    is_under_way_ = false;
    picture_due_ = !is_backdrop();
    window_.set_title(fmt::format("{} - gnomon", levels_[level].level.name));
    return {};
}

Status Front::restart_level() {
    is_under_way_ = false;
    if (const Status restarted = session_->restart(); !restarted) return restarted;
    note_input(false);
    return {};
}

// The title's level plays by itself, as its recording has it; where there is none, nobody moves.
Status Front::show_backdrop() {
    backdrop_ = screens_.level();
    if (const Status begun = begin_level(backdrop_); !begun) return begun;
    const std::string& name = levels_[backdrop_].name;
    auto recording = load_recording(options_.assets / "recordings" / (name + ".replay"));
    session_->follow(recording && recording->level == name ? std::move(recording->inputs)
                                                           : std::vector<Input>(6000));
    return {};
}

Status Front::make_drawing() {
    const glm::uvec2 size = picture_size();
    panel_.drawing.width = size.x;
    panel_.drawing.height = size.y;
    panel_.drawing.samples = options_.samples.value_or(settings_.samples);
    auto drawing = Drawing::create(window_.device(), session_->world().stage(), panel_.drawing);
    if (!drawing) return forward_error(drawing);
    drawing_.emplace(std::move(*drawing));
    return {};
}

// Letters are made for the size in which they are drawn, and again where that has changed much.
Status Front::refresh_ui() {
    const float unit = unit_of(picture_size());
    if (!ui_ || std::abs(unit / letters_unit_ - 1.0F) > 0.15F) {
        ui_pass_.reset();
        ui_.reset();
        ui_.emplace(
            ui::ContextDesc{.font_px = std::max(8.0F, std::round(panel_font_units * unit))});
        letters_ = Lettering::add_to(*ui_, unit);
        letters_unit_ = unit;
    }
    if (ui_pass_) return {};
    auto pass = ui::UiPass::create(window_.device(), ui_->fonts());
    if (!pass) return forward_error(pass);
    ui_pass_.emplace(std::move(*pass));
    return {};
}

// What lives on the device, on the one that the window has now.
Status Front::attach() {
    panel_.backend = window_.device().caps().backend;
    panel_.adapter = window_.device().caps().adapter;
    if (const Status made = refresh_ui(); !made) return made;
    return make_drawing();
}

// Fails where no device is left to go on with. Otherwise the game goes on: on the backend before
// where the other one cannot take over, and the note says why.
Status Front::exchange(window::Backend backend) {
    const auto let_go = [&] {
        drawing_.reset();
        ui_pass_.reset();
        has_drawn_ = false;
    };
    const auto exchanged = window::exchange(window_, backend, let_go, [&] { return attach(); });
    if (!exchanged) return forward_error(exchanged);
    panel_.forget_times();
    skipped_motions_ = 3;
    say(exchanged->value_or(panel_.adapter));
    return {};
}

Status Front::switch_backend() {
    if (window::backends().size() < 2) {
        say("There is one backend in this build.");
        return {};
    }
    const window::Backend before = window_.backend();
    const Status exchanged =
        exchange(before == window::Backend::Gl ? window::Backend::Vk : window::Backend::Gl);
    if (exchanged && window_.backend() != before)
        settings_.backend = std::string(window::name_of(window_.backend()));
    return exchanged;
}

Status Front::change(Setting setting, int by) {
    // Goes to the other one and says so where there is none.
    if (setting == Setting::Backend) return switch_backend();
    settings_ = changed(std::move(settings_), setting, by);
    if (setting == Setting::Fullscreen) window_.set_fullscreen(settings_.fullscreen);
    if (setting == Setting::Vsync) window_.set_vsync(settings_.vsync);
    return {};
}

void Front::save() {
    if (settings_ == saved_) return;
    Settings but_for_wins = saved_;
    but_for_wins.won = settings_.won;
    // What nobody could read is only written over when somebody asks for it.
    if (file_is_broken_ && settings_ == but_for_wins) return;
    const Status kept = save_settings(options_.settings, settings_);
    if (!kept) {
        say(kept.error().message);
        return;
    }
    saved_ = settings_;
    file_is_broken_ = false;
}

void Front::remember_win() {
    const std::string& name = session_->played().level;
    if (std::ranges::find(settings_.won, name) == settings_.won.end()) {
        settings_.won.push_back(name);
    }
    lines_[screens_.level()].won = true;
    save_what_is_sound();
}

void Front::save_what_is_sound() {
    if (!file_is_broken_) save();
}

Status Front::keep_recording() const {
    if (options_.record.empty() || !session_ || session_->follows()) return {};
    if (session_->played().inputs.empty()) return {};
    if (session_->is_beyond_recording()) {
        fmt::print(stderr,
                   "gnomon-game: {}: the level was played for {:.1f} minutes, of which a recording "
                   "holds the first {}.\n",
                   options_.record.string(),
                   static_cast<double>(session_->inputs()) * tick_s / 60.0,
                   most_ticks / (60 * ticks_a_second));
    }
    cli::OutputFiles files;
    const Status added = files.add(options_.record, to_text(session_->played()));
    return added ? files.commit() : added;
}

// For who looks for leaks.
void Front::report() {
    const ProcessMemory memory = process_memory();
    fmt::print("report: frame {}, {}, {} GPU objects, {} bytes held, {} resident\n", frames_,
               window::name_of(window_.backend()), window_.device().counters().objects_alive,
               memory.held_bytes, memory.resident_bytes);
    std::fflush(stdout);
}

Status Front::save_picture(const std::filesystem::path& path) {
    if (!has_drawn_) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{}: nothing has been drawn yet.", path.string()));
    }
    const auto rgba = drawing_->read_picture();
    if (!rgba) return forward_error(rgba);
    const render::RendererDesc& drawn = drawing_->renderer().desc();
    cli::OutputFiles files;
    const Status added = files.add_png(path, drawn.width, drawn.height, *rgba);
    return added ? files.commit() : added;
}

Status Front::obey(const Order& order) {
    switch (order.kind) {
        case Order::Kind::None:
        case Order::Kind::Watch: return {};  // which nothing here offers
        case Order::Kind::Begin: return begin_level(order.level);
        case Order::Kind::Restart: return restart_level();
        case Order::Kind::Leave: return show_backdrop();
        case Order::Kind::Change: return change(order.setting, order.by);
        case Order::Kind::Save: save(); return {};
        case Order::Kind::Quit: over_ = true; return {};
    }
    return {};
}

Status Front::obey(const std::string& command) {
    const std::size_t blank = std::min(command.find(' '), command.size());
    const std::string word = command.substr(0, blank);
    const std::string rest = blank < command.size() ? command.substr(blank + 1) : std::string();
    if (word == "screenshot") return save_picture(rest);
    if (word == "report") {
        report();
        return {};
    }
    if (word == "size") {
        const auto size = size_from_text(rest);
        GNOMON_EXPECTS(size.has_value());  // read_play_script() saw it
        window_.set_size(*size);
        // What the desktop does with it arrives when it likes; a script's frames shall not differ.
        for (int i = 0; i < 100 && window_.size_px() != *size; ++i) window_.poll(0.01);
        return {};
    }
    const auto backend = window_backend_named(rest);
    GNOMON_EXPECTS(backend.has_value());
    if (const Status exchanged = exchange(*backend); !exchanged) return exchanged;
    if (window_.backend() == *backend) return {};
    return fail(ErrorCode::Unsupported,
                fmt::format("The script's command \"{}\": {}", command, note_));
}

}  // namespace gnomon::game
