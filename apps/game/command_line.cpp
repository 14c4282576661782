// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "assets.hpp"
#include "autopilot.hpp"
#include "devices.hpp"
#include "files.hpp"
#include "headless.hpp"
#include "recording.hpp"

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
    app.add_option("--record", o.record, "Write what is pressed to this file")->type_name("FILE");
    app.add_flag("--autopilot", o.autopilot,
                 "Look for a way through the level that is dark, and walk it");
    app.add_flag("--headless", o.headless, "Without a window, as fast as it goes");
    app.add_option("--capture", o.capture.folder, "Write pictures to this folder")
        ->type_name("DIR");
    app.add_option("--every", o.capture.every, "Ticks from picture to picture; default 60")
        ->check(CLI::Range(1, 216000));
    app.add_option("--backend", o.capture.backend, "The device that draws; default one that works")
        ->check(CLI::IsMember(cli::backend_names()));
    app.add_option("--size", o.size, "Of the pictures; default 1280x720")->type_name("WxH");
    app.add_option("--samples", o.capture.samples, "A pixel; default 4")
        ->check(CLI::IsMember({1, 4}));
    app.add_option("--assets", o.assets,
                   "A folder with levels/*.json; default what came with the program")
        ->type_name("DIR");
}

/// "1280x720".
bool parse_size(const std::string& text, CaptureOptions& into) {
    const auto read = [](const char* begin, const char* end, std::uint32_t& value) {
        const auto [stop, error] = std::from_chars(begin, end, value);
        return error == std::errc{} && stop == end && value >= 1 && value <= 16384;
    };
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos) return false;
    const char* begin = text.data();
    return read(begin, begin + cross, into.width) &&
           read(begin + cross + 1, begin + text.size(), into.height);
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

int play_headless(const Options& o) {
    const std::filesystem::path assets = assets_of(o);
    Recording recording;
    if (!o.replay.empty()) {
        auto read = load_recording(o.replay);
        if (!read) return report(read.error());
        recording = std::move(*read);
    } else {
        recording.level = o.level;
        const auto names = level_names(assets);
        if (!names) return report(names.error());
        if (recording.level.empty() && !names->empty()) recording.level = names->front();
    }
    const auto level = load_named_level(assets, recording.level);
    if (!level) return report(level.error());
    if (!o.record.empty()) {
        if (const Status writable = cli::check_writable(o.record); !writable) {
            return report(writable.error());
        }
    }
    if (o.autopilot) {
        auto played = play_by_itself(*level, recording.level);
        if (!played) return report(played.error());
        recording = std::move(*played);
    }
    // First, so that a device that fails costs nobody what was pressed.
    if (!o.record.empty()) {
        cli::OutputFiles files;
        Status written = files.add(o.record, to_text(recording));
        if (written) written = files.commit();
        if (!written) return report(written.error());
    }
    const auto ended = play(*level, recording, o.capture);
    if (!ended) return report(ended.error());
    fmt::print("{}: {} after {:.2f} s\n", level->name, words_of(ended->outcome),
               seconds(ended->ticks));
    if (ended->pictures > 0) {
        fmt::print("{} pictures in {}\n", ended->pictures, o.capture.folder.string());
    }
    fmt::print("hash: {:016x}\n", ended->hash);
    return 0;
}

}  // namespace

int run(int argc, char** argv) {
    CLI::App app{"A small game of stealth: what you see is what they see.", "gnomon-game"};
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
    if (o.capture.folder.empty()) {
        for (const char* name : {"--every", "--backend", "--size", "--samples"}) {
            if (app.count(name) == 0) continue;
            return refuse(fmt::format(
                "{} is about pictures, which are kept by --capture DIR alone; give both.", name));
        }
    }
    if (!parse_size(o.size, o.capture)) {
        return refuse(fmt::format(
            "--size is \"{}\", but must be two numbers from 1 to 16384 with an x between, such as "
            "1280x720.",
            o.size));
    }
    if (!o.replay.empty() && o.autopilot) {
        return refuse("--replay and --autopilot both say what is pressed; give one of them.");
    }
    if (!o.replay.empty() && !o.level.empty()) {
        return refuse("--level goes without --replay: a recording names its own level.");
    }
    if (!o.headless) {
        return report({ErrorCode::Unsupported,
                       "This build has no window; --headless plays --replay FILE or --autopilot "
                       "without one."});
    }
    if (o.replay.empty() && !o.autopilot) {
        return refuse("--headless needs --replay FILE or --autopilot: nobody can press anything.");
    }
    return play_headless(o);
}

}  // namespace gnomon::game
