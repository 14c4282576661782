// SPDX-License-Identifier: MIT
//
// Everything that can be wrong before a window opens, and then the window.
#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "assets.hpp"
#include "files.hpp"
#include "play/front.hpp"
#include "size_text.hpp"

namespace gnomon::game {

namespace {

constexpr std::size_t most_script_bytes = 8U << 20U;
constexpr std::array<std::string_view, 4> script_commands{"size", "backend", "screenshot",
                                                          "report"};

Status check_script_command(std::string_view command) {
    const std::size_t blank = std::min(command.find(' '), command.size());
    const std::string_view word = command.substr(0, blank);
    const std::string_view rest = command.substr(std::min(blank + 1, command.size()));
    const auto refuse = [&](const char* why) {
        return fail(ErrorCode::InvalidInput, fmt::format("\"{}\": {}", command, why));
    };
    if (word == "size" && !size_from_text(rest)) {
        return refuse("the size must be two numbers from 1 to 16384 with an x between.");
    }
    if (word == "backend" && !window_backend_named(rest)) {
        return refuse("there is no such backend in this build.");
    }
    if (word == "report" && !rest.empty()) return refuse("nothing follows that word.");
    if (word == "screenshot") {
        return rest.empty() ? refuse("a file's name must follow.") : cli::check_writable(rest);
    }
    return {};
}

}  // namespace

std::optional<window::Backend> window_backend_named(std::string_view name) {
    for (const window::Backend backend : window::backends()) {
        if (window::name_of(backend) == name) return backend;
    }
    return std::nullopt;
}

Result<std::optional<input::Script>> read_play_script(const std::filesystem::path& path) {
    if (path.empty()) return std::optional<input::Script>();
    const auto text = cli::read_file(path, "the script", most_script_bytes);
    if (!text) return forward_error(text);
    auto script = input::Script::parse(*text, path.string(), script_commands, check_script_command);
    if (!script) return forward_error(script);
    return std::optional(std::move(*script));
}

Result<std::optional<Ended>> play_in_window(const PlayOptions& options) {
    if (options.backend && !window_backend_named(*options.backend)) {
        return fail(
            ErrorCode::InvalidInput,
            fmt::format("--backend: \"{}\" has no windows in this build.", *options.backend));
    }
    for (const std::filesystem::path& path : {options.record, options.screenshot}) {
        if (path.empty()) continue;
        if (const Status writable = cli::check_writable(path); !writable) {
            return forward_error(writable);
        }
    }
    auto script = read_play_script(options.script);
    if (!script) return forward_error(script);
    const auto names = level_names(options.assets);
    if (!names) return forward_error(names);
    if (names->empty()) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{}: there is no level.", (options.assets / "levels").string()));
    }
    const std::string& wanted = options.watched ? options.watched->level : options.level;
    if (!wanted.empty()) {
        // Says which there are, where it is none of them.
        if (const auto level = load_named_level(options.assets, wanted); !level) {
            return forward_error(level);
        }
    }
    std::vector<NamedLevel> levels;
    for (const std::string& name : *names) {
        auto level = load_named_level(options.assets, name);
        if (!level) return forward_error(level);
        levels.push_back({name, std::move(*level)});
    }
    std::optional<Capture> capture;
    if (!options.capture.empty()) {
        auto made = Capture::into(options.capture, options.masks);
        if (!made) return forward_error(made);
        capture.emplace(std::move(*made));
    }
    LoadedSettings loaded = load_settings(options.settings);
    if (!loaded.complaint.empty()) fmt::print(stderr, "gnomon-game: {}\n", loaded.complaint);

    // A backend that was asked for is the only one; one that is only remembered need not work.
    const auto wanted_backend = window_backend_named(options.backend.value_or(std::string()));
    const auto remembered = window_backend_named(loaded.settings.backend);
    window::WindowDesc desc{.title = "gnomon",
                            .size_px = options.size_px.value_or(glm::uvec2(1280, 720)),
                            .backend = wanted_backend ? wanted_backend : remembered,
                            .vsync = loaded.settings.vsync};
    auto window = window::Window::open(desc);
    if (!window && !wanted_backend && remembered) {
        desc.backend.reset();
        window = window::Window::open(desc);
    }
    if (!window) return forward_error(window);
    Front front(options, std::move(levels), std::move(loaded), std::move(*window),
                std::move(*script), std::move(capture));
    if (const Status started = front.start(); !started) return forward_error(started);
    if (const Status done = front.run(); !done) return forward_error(done);
    return front.ended();
}

}  // namespace gnomon::game
