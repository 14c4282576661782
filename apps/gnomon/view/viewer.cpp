// SPDX-License-Identifier: MIT
#include "view/viewer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include <gnomon/core/expects.hpp>

#include "files.hpp"
#include "view/marks.hpp"
#include "view/panel.hpp"

namespace gnomon::cli {

namespace {

using Clock = std::chrono::steady_clock;

/// Of a script's frames, so that what it plays is the same on every machine.
constexpr double scripted_frame_s = 1.0 / 60.0;
/// On a plain screen.
constexpr float font_px = 15.0F;
/// How long to sleep where nothing happens and nothing plays.
constexpr double idle_wait_s = 0.5;
/// A device that is lost as often without a frame between will be lost again.
constexpr int most_losses = 3;
constexpr std::size_t most_script_bytes = 8U << 20U;
constexpr std::array<std::string_view, 3> commands{"size", "backend", "screenshot"};

std::optional<window::Backend> backend_named(std::string_view name) {
    for (const window::Backend backend : window::backends()) {
        if (window::name_of(backend) == name) return backend;
    }
    return std::nullopt;
}

std::string stem_of(const std::string& source) {
    const std::size_t colon = source.rfind(':');
    const std::string name = colon == std::string::npos ? source : source.substr(colon + 1);
    std::string stem = std::filesystem::path(name).stem().string();
    if (stem.ends_with(".scene")) stem.resize(stem.size() - 6);
    return stem.empty() ? "scene" : stem;
}

// The first that is not there yet.
std::filesystem::path free_name(const std::string& stem) {
    for (int i = 1;; ++i) {
        std::filesystem::path path = fmt::format("gnomon-{}-{}.png", stem, i);
        std::error_code error;
        if (!std::filesystem::exists(path, error) || error) return path;
    }
}

// Of a script, when it is read.
Status check_command(std::string_view command) {
    const std::size_t blank = std::min(command.find(' '), command.size());
    const std::string_view word = command.substr(0, blank);
    const std::string_view rest = command.substr(std::min(blank + 1, command.size()));
    if (word == "size") {
        const auto size = parse_size(rest);
        return size ? Status() : forward_error(size);
    }
    if (word == "screenshot") return rest.empty() ? Status() : check_writable(rest);
    if (word != "backend" || backend_named(rest)) return {};
    return fail(ErrorCode::InvalidInput,
                fmt::format("\"{}\": there is no such backend in this build.", command));
}

Result<std::optional<input::Script>> read_script(const std::filesystem::path& path) {
    if (path.empty()) return std::optional<input::Script>();
    const auto text = read_file(path, "the script", most_script_bytes);
    if (!text) return forward_error(text);
    auto script = input::Script::parse(*text, path.string(), commands, check_command);
    if (!script) return forward_error(script);
    return std::optional(std::move(*script));
}

}  // namespace

Viewer::Viewer(const ViewOptions& options, window::Window window, Stage stage,
               std::optional<input::Script> script)
    : options_(options),
      window_(std::move(window)),
      stage_(std::move(stage)),
      script_(std::move(script)),
      ui_({.font_px = font_px * window_.content_scale()}) {
    state_.unit = window_.content_scale();
    state_.can_switch = window::backends().size() > 1;
    state_.panel = state_.help = state_.marks.probe = options.panel;
}

Canvas Viewer::canvas() const {
    return {.size_px = size_px_, .covered_left_px = panel_width_px(state_)};
}

// What lives on the device, on the one that the window has now.
Status Viewer::attach() {
    gpu::Device& device = window_.device();
    state_.backend = device.caps().backend;
    state_.adapter = device.caps().adapter;
    const glm::uvec2 size = glm::max(size_px_, glm::uvec2(1));
    if (const Status made = stage_.set_device(device, size); !made) return made;
    auto pass = ui::UiPass::create(device, ui_.fonts());
    if (!pass) return forward_error(pass);
    ui_pass_.emplace(std::move(*pass));
    return {};
}

// Fails where no device is left to go on with. Otherwise window_.backend() says whose it is: the
// one before where this one cannot take over, and the note says why.
Status Viewer::exchange(window::Backend backend) {
    const auto let_go = [&] {
        stage_.drop_device();
        ui_pass_.reset();
    };
    const auto exchanged = window::exchange(window_, backend, let_go, [&] { return attach(); });
    if (!exchanged) return forward_error(exchanged);
    state_.shadow_times.clear();
    state_.frame_times.clear();
    state_.say(*exchanged ? one_line(**exchanged) : state_.adapter);
    return {};
}

// Takes the stage on, its camera, its animations; not the device.
void Viewer::show(Stage stage, const std::string& source) {
    stage_ = std::move(stage);
    const RenderOptions& asked = stage_.options();
    const Shot& shot = stage_.shot();
    camera_ = OrbitCamera(shot.camera, shot.world_from_camera, shot.near_m, shot.bounds);
    bool has_camera = asked.eye || asked.target;
    shot.scene.registry.each<scene::Camera>([&](auto, const auto&) { has_camera = true; });
    if (!has_camera) camera_.frame(shot.bounds, canvas(), true);
    state_.source = source;
    state_.selection = {};
    state_.probe.reset();
    state_.time_s = asked.time_s.value_or(0.0);
    state_.playing = !shot.scene.animations.empty() && !asked.time_s;
    state_.shadow_times.clear();
    state_.frame_times.clear();
    drag_.reset();
    if (state_.playing && shot.animations.empty()) {
        stage_.play(scene::find_animations(shot.scene));
    }
    window_.set_title(fmt::format("{} - gnomon", one_line(source)));
}

// A scene that cannot be read, or that the device cannot hold, is said so in the window, where the
// one before stays.
Status Viewer::load(const std::string& source) {
    RenderOptions options = stage_.options();
    options.scene = source;
    if (source != state_.source) {
        options.eye.reset();
        options.target.reset();
        options.near_m.reset();
        options.animation.reset();
        options.time_s.reset();
        options.casters.reset();
        options.receivers.reset();
        options.lights.clear();
    }
    const bool ground = stage_.has_ground();
    auto stage = Stage::load(options);
    if (!stage) {
        state_.say(one_line(stage.error().message));
        return {};
    }
    stage->show_ground(ground);
    const Status held = stage->set_device(window_.device(), glm::max(size_px_, glm::uvec2(1)));
    if (!held && held.error().code != ErrorCode::DeviceLost) {
        state_.say(one_line(held.error().message));
        return {};
    }
    show(std::move(*stage), source);
    // The next device gets it.
    if (!held) return held;
    if (!stage_.shot().scene.messages.empty()) {
        state_.say(one_line(stage_.shot().scene.messages.front()));
    }
    return {};
}

Status Viewer::start() {
    size_px_ = window_.size_px();
    stage_.show_ground(options_.ground);
    show(std::move(stage_), options_.render.scene);
    return attach();
}

Status Viewer::obey(const std::string& command) {
    const std::size_t blank = std::min(command.find(' '), command.size());
    const std::string word = command.substr(0, blank);
    const std::string rest = blank < command.size() ? command.substr(blank + 1) : std::string();
    if (word == "size") {
        const auto size = parse_size(rest);
        if (!size) return forward_error(size);
        window_.set_size({size->width, size->height});
        // What the desktop does with it arrives when it likes; a script's frames shall not differ.
        for (int i = 0; i < 100 && window_.size_px() != glm::uvec2(size->width, size->height);
             ++i) {
            window_.poll(0.01);
        }
        return {};
    }
    if (word == "screenshot") {
        return save(rest.empty() ? free_name(stem_of(state_.source)) : std::filesystem::path(rest));
    }
    const auto backend = backend_named(rest);
    GNOMON_EXPECTS(backend.has_value());  // check_command() saw it
    if (const Status exchanged = exchange(*backend); !exchanged) return exchanged;
    if (window_.backend() == *backend) return {};
    return fail(ErrorCode::Unsupported,
                fmt::format("The script's command \"{}\": {}", command, state_.note));
}

Status Viewer::save(const std::filesystem::path& path) {
    if (!stage_.has_drawn()) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{}: nothing has been drawn yet.", path.string()));
    }
    const auto bytes = window_.device().read_texture(stage_.picture());
    if (!bytes) return forward_error(bytes);
    OutputFiles files;
    if (const Status added = files.add_png(path, size_px_.x, size_px_.y, *bytes); !added) {
        return added;
    }
    return files.commit();
}

Status Viewer::grant_wishes() {
    const Wishes wishes = std::exchange(state_.wishes, {});
    if (wishes.screenshot) {
        const std::filesystem::path path = free_name(stem_of(state_.source));
        const Status saved = save(path);
        state_.say(saved ? fmt::format("Saved {}", path.string())
                         : one_line(saved.error().message));
    }
    if (wishes.frame_all) camera_.frame(stage_.shot().bounds, canvas(), false);
    if (wishes.reload) {
        if (const Status loaded = load(state_.source); !loaded) return loaded;
    }
    if (wishes.other_backend && state_.can_switch) {
        return exchange(window_.backend() == window::Backend::Gl ? window::Backend::Vk
                                                                 : window::Backend::Gl);
    }
    return {};
}

Status Viewer::draw(const input::Input& input, double dt_s) {
    if (state_.playing) {
        state_.time_s += dt_s * state_.speed;
        if (const Status posed = stage_.set_time(state_.time_s); !posed) return posed;
    }
    ui_.begin_frame(input, size_px_, dt_s);
    view_ = camera_.view(canvas());
    if (const Status handled = handle_mouse(input); !handled) return handled;
    if (const Status shown = show_panel(state_, stage_); !shown) return shown;
    forget_what_is_gone();
    view_ = camera_.view(canvas());
    if (const Status drawn = stage_.draw(view_, size_px_); !drawn) return drawn;
    state_.add_times(stage_.figures());

    state_.cursor_px = input.cursor_px();
    state_.probe.reset();
    if (state_.marks.probe && cursor_seen_ && !drag_ && !ui_.wants_mouse()) {
        auto probe = stage_.probe(panel::ray_through(view_, input.cursor_px(), size_px_));
        if (!probe) return forward_error(probe);
        state_.probe = std::move(*probe);
    }
    state_.note_s = std::max(0.0, state_.note_s - dt_s);
    show_marks(state_, stage_, view_, size_px_);
    return ui_pass_->draw(ui_.end_frame(), stage_.picture(), size_px_.x, size_px_.y);
}

Status Viewer::frame(const input::Input& input, double dt_s) {
    for (const std::string& file : input.dropped_files) {
        if (const Status loaded = load(file); !loaded) return loaded;
    }
    for (const std::string& command : input.commands) {
        if (const Status done = obey(command); !done) return done;
    }
    const glm::uvec2 size_px = window_.size_px();
    if (size_px.x == 0 || size_px.y == 0) return {};
    size_px_ = size_px;
    if (!ui_.wants_keyboard()) {
        if (const Status handled = handle_keys(input); !handled) return handled;
    }
    if (const Status drawn = draw(input, dt_s); !drawn) return drawn;
    if (const Status granted = grant_wishes(); !granted) return granted;
    return stage_.has_drawn() ? window_.present(stage_.picture()) : Status();
}

bool Viewer::is_over() const {
    if (options_.frames && frames_ >= *options_.frames) return true;
    if (script_ && !options_.frames && frames_ > script_->last_frame() + 2) return true;
    return script_ ? scripted_.close_requested : window_.input().close_requested;
}

bool Viewer::has_work(const input::Input& live) const {
    return script_ || options_.frames || state_.playing || frames_due_ > 0 || drag_ ||
           live.anything_happened() || window_.size_px() != size_px_ || state_.note_s > 0.0;
}

Status Viewer::run() {
    Clock::time_point before = Clock::now();
    int losses = 0;  // one after the other
    while (!is_over()) {
        const bool busy = has_work(window_.input());
        const input::Input& live = window_.poll(busy ? 0.0 : idle_wait_s);
        if (window_.input().close_requested && !script_) break;
        if (script_) {
            scripted_.begin_frame();
            script_->play(frames_, scripted_);
        }
        if (window_.is_minimised() && !script_) continue;
        if (!has_work(live)) continue;
        const input::Input& input = script_ ? scripted_ : live;
        if (live.anything_happened()) frames_due_ = 3;
        frames_due_ = std::max(0, frames_due_ - 1);
        cursor_seen_ = cursor_seen_ || input.cursor_motion_px() != glm::dvec2(0.0);
        const auto now = Clock::now();
        // After a pause the scene goes on where it was.
        const double dt_s = std::min(0.1, std::chrono::duration<double>(now - before).count());
        before = now;
        Status done = frame(input, script_ || options_.frames ? scripted_frame_s : dt_s);
        if (done) losses = 0;
        while (!done && done.error().code == ErrorCode::DeviceLost && ++losses < most_losses) {
            done = exchange(window_.backend());
        }
        if (!done) return done;
        ++frames_;
    }
    return options_.screenshot.empty() ? Status() : save(options_.screenshot);
}

Status run_view(const ViewOptions& asked) {
    ViewOptions options = asked;
    if (options.render.scene.empty()) options.render.scene = "builtin:pillars";
    if (!options.screenshot.empty()) {
        if (const Status writable = check_writable(options.screenshot); !writable) return writable;
    }
    // Of a wrong name, before a window opens.
    if (shadows::find_strategy(options.render.silhouette) == nullptr) {
        const auto refused =
            shadows::ShadowSystem::create({.silhouette = options.render.silhouette});
        return forward_error(refused);
    }
    auto script = read_script(options.script);
    if (!script) return forward_error(script);
    auto stage = Stage::load(options.render);
    if (!stage) return forward_error(stage);
    auto window =
        window::Window::open({.title = "gnomon",
                              .size_px = {options.render.size.width, options.render.size.height},
                              .backend = backend_named(options.render.backend)});
    if (!window) return forward_error(window);
    if (!options.render.quiet) {
        for (const std::string& note : stage->shot().scene.messages) {
            fmt::print(stderr, "{}\n", one_line(note));
        }
    }
    Viewer viewer(options, std::move(*window), std::move(*stage), std::move(*script));
    if (const Status started = viewer.start(); !started) return started;
    return viewer.run();
}

}  // namespace gnomon::cli
