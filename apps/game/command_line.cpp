// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "assets.hpp"
#include "autopilot.hpp"
#include "devices.hpp"
#include "files.hpp"
#include "headless.hpp"
#include "recording.hpp"
#include "size_text.hpp"
#if GNOMON_HAS_PLAY
#include "play/play_options.hpp"
#include "play/settings_file.hpp"
#endif

namespace gnomon::game {

namespace {

struct Options {
    std::string assets;
    std::string level;
    std::string replay;
    std::string record;
    std::string size = "1280x720";
    bool autopilot = false;
    bool headless = false;
    bool list_levels = false;
    CaptureOptions capture;
    // In a window:
    double speed = 1.0;
    std::string script;
    std::string screenshot;
    std::optional<std::uint32_t> frames;
};

int report(const Error& error) {
    fmt::print(stderr, "gnomon-game: {}\n", error.message);
    return error.code == ErrorCode::InvalidInput || error.code == ErrorCode::Io ? 2 : 1;
}

int refuse(std::string sentence) { return report({ErrorCode::InvalidInput, std::move(sentence)}); }

void add_options(CLI::App& app, Options& o) {
    app.add_option("--level", o.level, "The level; default the first, or the recording's")
        ->type_name("NAME");
    app.add_flag("--list-levels", o.list_levels, "List the names for --level");
    app.add_option("--replay", o.replay, "Play a recording; the last line says hash: HEX")
        ->type_name("FILE");
    app.add_option("--record", o.record,
                   "Write what is pressed, in the level that was played last, to this file")
        ->type_name("FILE");
    app.add_flag("--autopilot", o.autopilot,
                 "Look for a way through the level that is dark, and walk it");
    app.add_flag("--headless", o.headless, "Without a window, as fast as it goes");
    app.add_option("--speed", o.speed, "How fast a window plays a recording; default 1")
        ->check(CLI::Range(0.1, 100.0));
    app.add_option("--capture", o.capture.folder, "Write pictures to this folder")
        ->type_name("DIR");
    app.add_flag("--masks", o.capture.masks,
                 "With the pictures, what the stencil held of each light (PGM)");
    app.add_flag("--times", o.capture.times,
                 "Tell at the end what frames took: of every tick, or as --every says");
    app.add_option("--every", o.capture.every, "Ticks from picture to picture; default 60")
        ->check(CLI::Range(1, 216000));
    app.add_option("--backend", o.capture.backend, "The device that draws; default one that works")
        ->check(CLI::IsMember(cli::backend_names()));
    app.add_option("--size", o.size, "Of the window, or of the pictures; default 1280x720")
        ->type_name("WxH");
    app.add_option("--samples", o.capture.samples, "A pixel; default 4")
        ->check(CLI::IsMember({1, 4}));
    app.add_option("--script", o.script,
                   "Input from this file instead of keyboard and mouse; a frame is a tick then")
        ->type_name("FILE");
    app.add_option("--screenshot", o.screenshot, "Write what the window showed last (PNG)")
        ->type_name("IMAGE.png");
    app.add_option("--frames", o.frames, "Close the window after so many")
        ->check(CLI::Range(1, 1000000));
    app.add_option("--assets", o.assets,
                   "A folder with levels/*.json; default what came with the program")
        ->type_name("DIR");
}

const char* words_of(Outcome outcome) {
    switch (outcome) {
        case Outcome::Playing: return "not over";
        case Outcome::Won: return "won";
        case Outcome::Caught: return "caught";
    }
    return "";
}

std::filesystem::path assets_of(const Options& o) {
    return o.assets.empty() ? assets_folder() : std::filesystem::path(o.assets);
}

int list_levels(const std::filesystem::path& assets) {
    const auto names = level_names(assets);
    if (!names) return report(names.error());
    for (const std::string& name : *names) {
        const auto level = load_named_level(assets, name);
        if (!level) return report(level.error());
        fmt::print("{}: {}\n", name, level->name);
    }
    return 0;
}

/// What is played: a recording, or what the autopilot presses. `recording` has a level in any case.
Status choose_inputs(const Options& o, const std::filesystem::path& assets, Recording& recording) {
    if (!o.replay.empty()) {
        auto read = load_recording(o.replay);
        if (!read) return forward_error(read);
        recording = std::move(*read);
    } else {
        recording.level = o.level;
        const auto names = level_names(assets);
        if (!names) return forward_error(names);
        if (recording.level.empty() && !names->empty()) recording.level = names->front();
    }
    const auto level = load_named_level(assets, recording.level);
    if (!level) return forward_error(level);
    if (!o.record.empty()) {
        if (const Status writable = cli::check_writable(o.record); !writable) return writable;
    }
    if (o.autopilot) {
        auto played = play_by_itself(*level, recording.level);
        if (!played) return forward_error(played);
        recording = std::move(*played);
    }
    // First, so that a device that fails costs nobody what was pressed.
    if (o.record.empty()) return {};
    cli::OutputFiles files;
    const Status added = files.add(o.record, to_text(recording));
    return added ? files.commit() : added;
}

int tell_end(const std::string& level_name, const Ended& ended,
             const std::filesystem::path& pictures) {
    fmt::print("{}: {} after {:.2f} s\n", level_name, words_of(ended.outcome),
               seconds(ended.ticks));
    if (const std::string times = to_text(ended.times); !times.empty()) {
        fmt::print("{}\n{}", ended.adapter, times);
    }
    if (ended.pictures > 0) fmt::print("{} pictures in {}\n", ended.pictures, pictures.string());
    fmt::print("hash: {:016x}\n", ended.hash);
    return 0;
}

int play_headless(const Options& o) {
    const std::filesystem::path assets = assets_of(o);
    Recording recording;
    if (const Status chosen = choose_inputs(o, assets, recording); !chosen) {
        return report(chosen.error());
    }
    const auto level = load_named_level(assets, recording.level);
    if (!level) return report(level.error());
    const auto ended = play(*level, recording, o.capture);
    if (!ended) return report(ended.error());
    return tell_end(level->name, *ended, o.capture.folder);
}

#if GNOMON_HAS_PLAY
int play_windowed(const CLI::App& app, const Options& o) {
    PlayOptions options{.assets = assets_of(o),
                        .level = o.level,
                        .speed = o.speed,
                        .record = o.record,
                        .capture = o.capture.folder,
                        .masks = o.capture.masks,
                        .every = o.capture.every,
                        .screenshot = o.screenshot,
                        .script = o.script,
                        .frames = o.frames,
                        .settings = settings_path()};
    if (app.count("--size") > 0) options.size_px = {o.capture.width, o.capture.height};
    if (app.count("--samples") > 0) options.samples = o.capture.samples;
    if (app.count("--backend") > 0) options.backend = o.capture.backend;
    if (o.replay.empty() && !o.autopilot) {
        const auto played = play_in_window(options);
        return played ? 0 : report(played.error());
    }
    Recording recording;
    if (const Status chosen = choose_inputs(o, options.assets, recording); !chosen) {
        return report(chosen.error());
    }
    options.record.clear();  // it is written
    options.watched = std::move(recording);
    const auto watched = play_in_window(options);
    if (!watched) return report(watched.error());
    if (!*watched) {
        fmt::print("The window was closed before the recording was over.\n");
        return 0;
    }
    const auto level = load_named_level(options.assets, options.watched->level);
    return level ? tell_end(level->name, **watched, options.capture) : report(level.error());
}
#else
int play_windowed(const CLI::App&, const Options&) {
    return report({ErrorCode::Unsupported,
                   "This build has no window, for GLFW or Dear ImGui was not found when it was "
                   "made; --headless plays --replay FILE or --autopilot without one."});
}
#endif

}  // namespace

int run(int argc, char** argv) {
    CLI::App app{"A small game of stealth: what you see is what they see.", "gnomon-game"};
    app.footer(
        "Without options it opens a window with its title. Walk by W A S D, the arrows or a stick; "
        "Shift runs, Ctrl sneaks,\nthe mouse turns the camera, R begins anew, Esc pauses, F1 shows "
        "how the shadows are made, F2 goes on with the\nother backend, F11 fills the screen, F12 "
        "keeps a picture.\n\n"
        "  gnomon-game\n"
        "  gnomon-game --level dockyard --backend vk --record mine.replay\n"
        "  gnomon-game --replay mine.replay --speed 2\n"
        "  gnomon-game --headless --replay mine.replay --capture pictures --every 60");
    app.set_version_flag("--version", GNOMON_VERSION);
    Options o;
    add_options(app, o);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked_for_help) {
        return app.exit(asked_for_help);
    } catch (const CLI::ParseError& error) {
        std::string sentence = error.what();
        if (!sentence.ends_with('.')) sentence += '.';
        return refuse(std::move(sentence));
    }
    if (o.list_levels) return list_levels(assets_of(o));
    if (!(o.speed >= 0.1 && o.speed <= 100.0)) {  // a range that is checked lets no number in
        return refuse("--speed must be a number from 0.1 to 100.");
    }
    if (o.capture.times && !o.headless) {
        return refuse("--times is about frames drawn as fast as it goes; give --headless as well.");
    }
    if (o.capture.masks && o.capture.folder.empty()) {
        return refuse("--masks is about what --capture DIR keeps; give that as well.");
    }
    if (o.capture.masks && o.capture.times) {
        return refuse(
            "--masks reads every light back, which --times would count; give one of them.");
    }
    const bool draws = !o.capture.folder.empty() || o.capture.times;
    if (o.capture.times && app.count("--every") == 0) o.capture.every = 1;
    if (o.headless && !draws) {
        for (const char* name : {"--backend", "--size", "--samples"}) {
            if (app.count(name) == 0) continue;
            return refuse(fmt::format(
                "{} is about what is drawn, by --capture DIR or --times alone; give one as well.",
                name));
        }
    }
    if (!draws && app.count("--every") > 0) {
        return refuse(
            "--every is about what is drawn, by --capture DIR or --times alone; give one as well.");
    }
    if (o.headless) {
        for (const char* name : {"--speed", "--script", "--screenshot", "--frames"}) {
            if (app.count(name) == 0) continue;
            return refuse(
                fmt::format("{} is about the window, which --headless goes without.", name));
        }
    }
    const auto size = size_from_text(o.size);
    if (!size) {
        return refuse(fmt::format(
            "--size is \"{}\", but must be two numbers from 1 to 16384 with an x between, such as "
            "1280x720.",
            o.size));
    }
    o.capture.width = size->x;
    o.capture.height = size->y;
    if (!o.replay.empty() && o.autopilot) {
        return refuse("--replay and --autopilot both say what is pressed; give one of them.");
    }
    if (!o.replay.empty() && !o.level.empty()) {
        return refuse("--level goes without --replay: a recording names its own level.");
    }
    if (o.replay.empty() && !o.autopilot && app.count("--speed") > 0) {
        return refuse("--speed is for --replay FILE or --autopilot: nobody plays at another one.");
    }
    if (!o.headless) return play_windowed(app, o);
    if (o.replay.empty() && !o.autopilot) {
        return refuse("--headless needs --replay FILE or --autopilot: nobody can press anything.");
    }
    return play_headless(o);
}

}  // namespace gnomon::game
