// SPDX-License-Identifier: MIT
#include "report_arguments.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gnomon/report/report.hpp>

#include "devices.hpp"

namespace gnomon::cli {

const CLI::App* add_report(CLI::App& app, ReportOptions& o, bool& list_techniques) {
    auto* report = app.add_subcommand(
        "report", "Measure what ways to draw shadows cost, and how many pixels they get wrong");
    report->footer(
        "Writes DIR/report.html (one page that needs nothing else), report.csv, report.json and, "
        "with\n"
        "python3-matplotlib, plots/*.svg and *.png. Without SCENE a standard set is measured: "
        "scenes that are\n"
        "built in, and models where the package assimp-testmodels or ../shared/models has them. "
        "What is left\n"
        "out is said. Every technique draws the same moving masks, in turn, and each mask is held "
        "against\n"
        "ray-traced truth.\n"
        "A scene that was measured is kept in DIR/cells: an interrupted run goes on where it was, "
        "and a repeated\n"
        "one measures nothing. Other arguments measure anew.\n\n"
        "  gnomon report --quick --out report\n"
        "  gnomon report city.glb --out report --backend vk --size 1280x720\n"
        "  gnomon report --out report --technique auto --technique \"shadow map, 3x3 2048\"");
    report->add_option("scenes", o.scenes, "Scenes, as gnomon render takes them")
        ->type_name("SCENE");
    report
        ->add_option_function<std::string>(
            "--out",
            [&o](const std::string& text) {
                if (text.empty()) throw CLI::ValidationError("", "--out: the name is empty");
                o.out = text;
            },
            "Write into this folder; it is made where it is not there. Default: report")
        ->type_name("DIR");
    report
        ->add_option_function<std::string>(
            "--backend",
            [&o](const std::string& text) {
                std::vector<std::string> names;
                for (std::size_t at = 0; at <= text.size();) {
                    const std::size_t end = std::min(text.find(',', at), text.size());
                    names.push_back(text.substr(at, end - at));
                    at = end + 1;
                }
                const std::vector<std::string> known = backend_names();
                for (const std::string& name : names) {
                    if (std::find(known.begin(), known.end(), name) == known.end()) {
                        throw CLI::ValidationError(
                            "", fmt::format("--backend: there is no backend \"{}\"; there are {}",
                                            name, fmt::join(known, ", ")));
                    }
                    if (std::count(names.begin(), names.end(), name) > 1) {
                        throw CLI::ValidationError(
                            "", fmt::format("--backend: \"{}\" is named twice", name));
                    }
                }
                o.backends = names;
            },
            "One that draws, or several with commas (gl,vk); default: the first that draws on a "
            "graphics chip, else the first that works")
        ->type_name("LIST");
    report
        ->add_option_function<std::string>(
            "--size",
            [&o](const std::string& text) {
                auto size = parse_size(text);
                if (!size) throw CLI::ValidationError("", size.error().message);
                o.size = *size;
            },
            "Pixels; default 960x540, with --quick 320x180")
        ->type_name("WIDTHxHEIGHT");
    report
        ->add_option("--rounds", o.rounds,
                     "How often each technique draws the motion, in turn with the others; default "
                     "5, with --quick 3, and more where frames are so short that a scene's rounds "
                     "take less than 5 s, with --quick 1 s")
        ->check(CLI::Range(1, 1000));
    report
        ->add_option("--frames", o.frames,
                     "Frames of the motion, all of them judged; default 12, with --quick 4")
        ->check(CLI::Range(2, 1000));
    report
        ->add_option("--technique", o.techniques,
                     "Only this one, and auto to compare with; repeatable")
        ->type_name("NAME")
        ->allow_extra_args(false);
    report->add_flag("--quick", o.quick, "A first look: few scenes and techniques, small pictures");
    report->add_flag("--list-techniques", list_techniques, "List the names for --technique");
    report->add_flag("--quiet", o.quiet, "No notes and no progress line");
    return report;
}

std::string technique_list() {
    std::string list;
    for (const std::string& name : report::technique_names()) list += name + "\n";
    return list;
}

std::string command_line(const std::vector<std::string>& arguments) {
    std::string line;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        std::string word =
            i == 0 ? std::filesystem::path(arguments[i]).filename().string() : arguments[i];
        const bool plain = !word.empty() &&
                           word.find_first_of(" \t\n'\"\\$&|;<>()*?[]{}#~`!") == std::string::npos;
        if (!plain) {
            std::string safe = "'";
            for (const char c : word) safe += c == '\'' ? "'\\''" : std::string(1, c);
            word = safe + "'";
        }
        line += (i == 0 ? "" : " ") + word;
    }
    return line;
}

}  // namespace gnomon::cli
