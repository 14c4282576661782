// SPDX-License-Identifier: MIT
#include "report_command.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gnomon/report/report.hpp>
#include <gnomon/report/writers.hpp>

#include <gnomon_revision.hpp>

#include "devices.hpp"
#include "files.hpp"
#include "plots.hpp"
#include "report_scenes.hpp"

namespace gnomon::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// The program's file and, where they are shared, gnomon's libraries: each once.
std::set<std::string> files_of_this_program() {
    std::set<std::string> files{"/proc/self/exe"};
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
        const std::size_t path = line.find('/');
        if (path != std::string::npos && line.find("/libgnomon") != std::string::npos) {
            files.insert(line.substr(path));
        }
    }
    return files;
}

// Any other program may measure otherwise.
std::string build_of_this_program() {
    std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a
    std::vector<char> block(std::size_t{1} << 20U);
    for (const std::string& name : files_of_this_program()) {
        std::ifstream file(name, std::ios::binary);
        while (file) {
            file.read(block.data(), static_cast<std::streamsize>(block.size()));
            for (std::streamsize i = 0; i < file.gcount(); ++i) {
                hash = (hash ^ static_cast<unsigned char>(block[static_cast<std::size_t>(i)])) *
                       0x100000001b3ULL;
            }
        }
    }
    return fmt::format("{:016x}", hash);
}

// The first that draws on a graphics chip, else the empty name: the first that works.
std::string best_backend() {
    for (const std::string& name : backend_names()) {
        if (name == "null") continue;
        const auto device = create_device({.backend = name});
        if (device && !report::draws_in_software(device->caps().adapter)) return name;
    }
    return {};
}

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string minutes(double seconds) {
    if (seconds < 100.0) return fmt::format("{:.0f} s", seconds);
    return fmt::format("{:.0f} min", seconds / 60.0);
}

class ReportRun {
public:
    explicit ReportRun(const ReportOptions& options) : options_(options) {}
    Status prepare();
    Status measure_all();
    Status write_tables();
    Status finish();

private:
    Status measure_one(const WantedScene& wanted, gpu::Device& device, double begins, double share);
    void tell(double done, const std::string& what);

    const ReportOptions& options_;
    report::Report report_;
    std::vector<WantedScene> scenes_;
    std::vector<std::pair<std::string, gpu::Device>> devices_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_told_{};
    double taken_over_ = 0.0;  // share of the work that an earlier run did
    std::size_t cells_taken_over_ = 0;
};

Status ReportRun::prepare() {
    report::Options& o = report_.options;
    o.quick = options_.quick;
    o.version = options_.version;
    if (*GNOMON_REVISION != '\0') o.version += fmt::format(" ({})", GNOMON_REVISION);
    o.build = build_of_this_program();
    const Size size = options_.size.value_or(options_.quick ? Size{320, 180} : Size{960, 540});
    o.width = size.width;
    o.height = size.height;
    o.rounds = options_.rounds.value_or(options_.quick ? 3 : 5);
    if (!options_.rounds) o.least_seconds = options_.quick ? 1.0 : 5.0;
    // Far enough for each tolerance to be used up.
    o.frames = options_.frames.value_or(options_.quick ? 4 : 12);
    o.only = options_.techniques;
    const std::vector<std::string> known = report::technique_names();
    for (const std::string& name : o.only) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("--technique: there is no technique \"{}\"; --list-techniques "
                                    "names all.",
                                    name));
        }
    }
    std::error_code error;
    fs::create_directories(options_.out / "cells", error);
    if (error) {
        return fail(ErrorCode::Io, fmt::format("{} cannot be made: {}.",
                                               (options_.out / "cells").string(), error.message()));
    }
    if (const Status writable = check_writable(options_.out / "report.html"); !writable) {
        return writable;
    }
    scenes_ = options_.scenes.empty() ? standard_scenes(options_.quick, report_.left_out)
                                      : given_scenes(options_.scenes);
    // Whoever asks for a first look knows that it is one.
    if (!options_.quiet && !options_.quick && !report_.left_out.empty()) {
        std::string list;
        for (const report::LeftOut& scene : report_.left_out) {
            list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", scene.scene, scene.source);
        }
        fmt::print(stderr, "Left out of the standard set, since {}: {}.\n",
                   report_.left_out.front().reason, list);
    }
    const std::vector<std::string> backends =
        options_.backends.empty() ? std::vector<std::string>{best_backend()} : options_.backends;
    for (const std::string& backend : backends) {
        auto device = create_device({.backend = backend});
        if (!device) return forward_error(device);
        if (device->caps().backend == "null") {
            return fail(ErrorCode::InvalidInput,
                        "--backend: \"null\" draws nothing, so that nothing can be judged.");
        }
        const std::uint32_t limit = device->caps().limits.max_texture_dimension_2d;
        if (o.width > limit || o.height > limit) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("--size: {}x{} is larger than {} takes; its limit is {}.",
                                    o.width, o.height, device->caps().adapter, limit));
        }
        std::string name = device->caps().backend;
        devices_.emplace_back(std::move(name), std::move(*device));
    }
    report_.machine = machine::this_machine();
    report_.command = options_.command;
    return {};
}

void ReportRun::tell(double done, const std::string& what) {
    if (options_.quiet) return;
    const auto now = Clock::now();
    if (done < 1.0 && now - last_told_ < std::chrono::milliseconds(200)) return;
    last_told_ = now;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const double own = done - taken_over_;
    const std::string left =
        own > 0.01 ? fmt::format("{} left", minutes(seconds / own * (1.0 - done))) : "…";
    fmt::print(stderr, "\r{:3.0f} %, {}: {}\x1b[K", done * 100.0, left, one_line(what));
    if (done >= 1.0) fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
}

Status ReportRun::measure_one(const WantedScene& wanted, gpu::Device& device, double begins,
                              double share) {
    auto subject = load_subject(wanted, report_.options);
    if (!subject) return forward_error(subject);
    const std::string key = report::cell_key(*subject, report_.options, report_.machine,
                                             device.caps().backend, device.caps().adapter);
    const fs::path kept = options_.out / "cells" / (key + ".json");
    std::error_code error;
    if (fs::is_regular_file(kept, error)) {
        // One that cannot be read is measured again.
        if (auto cell = report::cell_from_json(text_of(kept))) {
            report_.cells.push_back(std::move(*cell));
            taken_over_ += share;
            ++cells_taken_over_;
            return {};
        }
    }
    auto cell =
        report::measure(device, *subject, report_.options, [&](const report::Progress& progress) {
            tell(begins + share * progress.done,
                 fmt::format("{} on {}: {}", wanted.name, device.caps().backend, progress.what));
        });
    if (!cell) return forward_error(cell);
    OutputFiles file;
    if (const Status added = file.add(kept, report::cell_to_json(*cell)); !added) return added;
    report_.cells.push_back(std::move(*cell));
    if (const Status kept_now = file.commit(); !kept_now) return kept_now;
    return write_tables();
}

Status ReportRun::measure_all() {
    const double share = 1.0 / static_cast<double>(scenes_.size() * devices_.size());
    double begins = 0.0;
    for (const WantedScene& wanted : scenes_) {
        for (auto& [name, device] : devices_) {
            if (const Status done = measure_one(wanted, device, begins, share); !done) return done;
            begins += share;
        }
    }
    tell(1.0, "done");
    return {};
}

// After each scene, so that an interrupted run leaves what it has.
Status ReportRun::write_tables() {
    OutputFiles files;
    const fs::path json = options_.out / "report.json";
    for (const auto& [path, text] :
         {std::pair{json, report::to_json(report_)},
          std::pair{options_.out / "report.csv", report::to_csv(report_)},
          std::pair{options_.out / "report.html", report::to_html(report_)}}) {
        if (const Status added = files.add(path, text); !added) return added;
    }
    return files.commit();
}

Status ReportRun::finish() {
    if (const Status written = write_tables(); !written) return written;
    const std::string note = draw_plots(options_.out / "report.json", options_.out / "plots");
    if (!options_.quiet) {
        if (cells_taken_over_ > 0) {
            fmt::print(stderr,
                       "{} of {} measurements were taken over: this program made them before, on "
                       "this machine, with the same arguments.\n",
                       cells_taken_over_, report_.cells.size());
        }
        if (!note.empty()) fmt::print(stderr, "{}\n", one_line(note));
        fmt::print(stderr, "{}\n", (options_.out / "report.html").string());
    }
    return {};
}

}  // namespace

Status run_report(const ReportOptions& options) {
    ReportRun run(options);
    if (const Status ready = run.prepare(); !ready) return ready;
    if (const Status measured = run.measure_all(); !measured) return measured;
    return run.finish();
}

}  // namespace gnomon::cli
