// SPDX-License-Identifier: MIT
//
// gnomon: the command-line tool. Exit codes: 0 done; 2 bad usage or bad input, with one sentence on
// stderr; 1 anything else.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <gnomon/scene/scene_description.hpp>
#include <gnomon/shadows/casting_cost.hpp>
#include <gnomon/shadows/detector.hpp>

#include "devices.hpp"
#include "inspect_command.hpp"
#include "render_options.hpp"
#include "scene_arguments.hpp"
#if GNOMON_HAS_PROFILE
#include "profile/profile_arguments.hpp"
#endif
#if GNOMON_HAS_REPORT
#include "report_arguments.hpp"
#endif
#if GNOMON_HAS_VIEW
#include "view/view_options.hpp"
#endif

namespace {

using namespace gnomon;

int exit_code(ErrorCode code) {
    return code == ErrorCode::InvalidInput || code == ErrorCode::Io ? 2 : 1;
}

int report(const Error& error) {
    fmt::print(stderr, "gnomon: {}\n", cli::one_line(error.message));
    return exit_code(error.code);
}

void add_render(CLI::App& app, cli::RenderOptions& o, bool& list_silhouettes) {
    auto* render = app.add_subcommand(
        "render", "Draw a scene with exact shadows; write the picture and the masks");
    render->footer(fmt::format(
        "SCENE is a .glb, .gltf or .scene.json file, or builtin:NAME with NAME one of {}.\n"
        "Without --eye the file's camera is used, else the scene is framed. Without --light the "
        "file's\n"
        "lights are used, else one sun.\n\n"
        "  gnomon render builtin:pillars --out pillars.png\n"
        "  gnomon render engine.glb --light dir:-1,-2,-1 --out engine.png --stencil engine --stats "
        "engine.json\n"
        "  gnomon render engine.glb --backend vk --show volumes,silhouettes --out volumes.png\n"
        "  gnomon render fox.glb --animation Run --time 0.5 --out fox.png\n"
        "  gnomon render city.glb --frames 100 --animate light:0.5 --stats city.json",
        fmt::join(scene::builtin_scene_names(), ", ")));
    render->add_option("scene", o.scene, "The scene to draw")->type_name("SCENE");
    const CLI::Validator named = cli::not_empty();
    render->add_option("--out", o.out, "Write the picture here (PNG)")
        ->check(named)
        ->type_name("IMAGE.png");
    render
        ->add_option("--stencil", o.stencil_prefix,
                     "Write raw stencil counts to PREFIX.light0.pgm, …; where a light's layers "
                     "had to be split, 0 and 255")
        ->check(named)
        ->type_name("PREFIX");
    auto* stats = render->add_option("--stats", o.stats, "Write measurements here (JSON)")
                      ->check(named)
                      ->type_name("FILE.json");
    render
        ->add_flag("--meter", o.meter,
                   "Have the device count the stencil fragments of each frame, once its time is "
                   "taken, for --stats")
        ->needs(stats);
    render
        ->add_option("--backend", o.backend,
                     fmt::format("One of {}", fmt::join(cli::backend_names(), ", ")))
        ->check(CLI::IsMember(cli::backend_names()));
    render->add_option("--gl-stencil", o.gl_stencil, "Force OpenGL's stencil path")
        ->check(CLI::IsMember({"two-side", "separate", "two-pass"}));
    cli::add_scene_options(*render, o);
    render->add_flag("--list-silhouettes", list_silhouettes, "List the names for --silhouette");
    render->add_option("--frames", o.frames, "How many frames; the last one is written")
        ->check(CLI::Range(1, 1000000));
    render
        ->add_option_function<std::string>(
            "--animate", cli::parsed_into(o.motion, cli::parse_motion),
            "static, camera, light:DEG a frame, casters:K, or time:SECONDS a frame: "
            "the scene's animations, from --time on")
        ->type_name("MOTION");
    render->add_flag("--quiet", o.quiet, "No notes and no progress line");
}

const CLI::App* add_inspect(CLI::App& app, cli::InspectOptions& o) {
    auto* inspect = app.add_subcommand(
        "inspect", "Report what is open, non-manifold or costly in a model's meshes, and why");
    inspect->footer(fmt::format(
        "MODEL is anything that gnomon render takes. No mesh makes shadows leak; what is not "
        "closed "
        "casts\n"
        "two-sided, which costs about twice as much. The report says for each mesh and its "
        "components\n"
        "(faces connected through edges) what is open, non-manifold, inconsistently wound or "
        "without area,\n"
        "how they cast, how large their shadow volumes are over {} light directions, what it means "
        "for\n"
        "shadows and what to do about it. Vertices at equal positions count as one; edges are "
        "judged\n"
        "after that. --json has every component, and \"casts\": one_sided, inside_out, two_sided "
        "or nothing.\n\n"
        "  gnomon inspect engine.glb\n"
        "  gnomon inspect engine.glb --obj edges.obj      then import it over the model\n"
        "  gnomon inspect engine.glb --json | jq '.meshes[] | select(.closed | not) | .name'",
        shadows::sample_direction_count));
    inspect->add_option("model", o.model, "The model")->required()->type_name("MODEL");
    inspect->add_flag("--json", o.json, "As JSON, with every component");
    inspect
        ->add_option("--obj", o.obj,
                     "Write the offending edges here as lines, and the faces without area: one "
                     "object a mesh and kind, in the mesh's own space")
        ->check(cli::not_empty())
        ->type_name("FILE.obj");
    return inspect;
}

int run(int argc, char** argv) {
    CLI::App app{"Exact hard shadows: stencil shadow volumes for any triangle mesh.", "gnomon"};
    app.set_version_flag("--version", GNOMON_VERSION);
    app.require_subcommand(1);
    cli::RenderOptions render;
    bool list_silhouettes = false;
    add_render(app, render, list_silhouettes);
    cli::InspectOptions inspect;
    const CLI::App* inspect_app = add_inspect(app, inspect);

    std::vector<std::string> commands{"render", "inspect"};
#if GNOMON_HAS_REPORT
    cli::ReportOptions report_options{.version = GNOMON_VERSION,
                                      .command = cli::command_line({argv, argv + argc})};
    bool list_techniques = false;
    const CLI::App* report_app = cli::add_report(app, report_options, list_techniques);
    commands.emplace_back("report");
#endif
#if GNOMON_HAS_PROFILE
    cli::ProfileOptions profile;
    const CLI::App* profile_app = cli::add_profile(app, profile);
    commands.emplace_back("profile");
#else
    if (argc > 1 && std::string_view(argv[1]) == "profile") {
        return report({ErrorCode::Unsupported,
                       "This build has no profile: ERFA or cairo was not found when it was made "
                       "(packages liberfa-dev and libcairo2-dev)."});
    }
#endif
#if GNOMON_HAS_VIEW
    cli::ViewOptions view;
    const CLI::App* view_app = cli::add_view(app, view);
    commands.emplace_back("view");
#else
    if (argc > 1 && std::string_view(argv[1]) == "view") {
#if !GNOMON_HAS_BACKEND
        return report({ErrorCode::Unsupported,
                       "This build has no view: it was made without OpenGL and without Vulkan "
                       "(GNOMON_GL, GNOMON_VK), and nothing else draws in a window."});
#else
        return report({ErrorCode::Unsupported,
                       "This build has no view: GLFW or Dear ImGui was not found when it was made "
                       "(packages libglfw3-dev and libimgui-dev)."});
#endif
    }
#endif

#if !GNOMON_HAS_REPORT
    if (argc > 1 && std::string_view(argv[1]) == "report") {
        return report({ErrorCode::Unsupported,
                       "This build has no report: Embree, which traces the truth, was not found "
                       "when it was made (package libembree-dev)."});
    }
#endif

    // Of an unknown one CLI11 would only say that a subcommand is missing.
    if (argc > 1 && argv[1][0] != '-' &&
        std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
        return report(
            {ErrorCode::InvalidInput, fmt::format("There is no subcommand \"{}\"; there are {}.",
                                                  argv[1], fmt::join(commands, ", "))});
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked_for_help) {
        return app.exit(asked_for_help);
    } catch (const CLI::ParseError& error) {
        std::string sentence = error.what();
        if (const auto at = sentence.find_first_not_of(": "); at != std::string::npos)
            sentence.erase(0, at);
        if (!sentence.ends_with('.')) sentence += '.';
        return report({ErrorCode::InvalidInput, std::move(sentence)});
    }

    if (inspect_app->parsed()) {
        const auto text = cli::inspect(inspect);
        if (!text) return report(text.error());
        fmt::print("{}", *text);
        return 0;
    }
#if GNOMON_HAS_REPORT
    if (report_app->parsed()) {
        if (list_techniques) {
            fmt::print("{}", cli::technique_list());
            return 0;
        }
        const Status done = cli::run_report(report_options);
        return done ? 0 : report(done.error());
    }
#endif
#if GNOMON_HAS_PROFILE
    if (profile_app->parsed()) {
        const Status done = cli::run_profile(profile);
        return done ? 0 : report(done.error());
    }
#endif
#if GNOMON_HAS_VIEW
    if (view_app->parsed()) {
        const Status done = cli::run_view(view);
        return done ? 0 : report(done.error());
    }
#endif
    if (list_silhouettes) {
        const auto& automatic = shadows::automatic_strategy();
        fmt::print("{}: {}\n", automatic.name, automatic.summary);
        for (const auto& strategy : shadows::silhouette_strategies()) {
            fmt::print("{}: {}\n", strategy.name, strategy.summary);
        }
        return 0;
    }
    if (render.scene.empty()) {
        fmt::print(stderr, "gnomon: render needs a SCENE; see gnomon render --help.\n");
        return 2;
    }
    const Status done = cli::run_render(render);
    return done ? 0 : report(done.error());
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& unexpected) {
        std::fprintf(stderr, "gnomon: %s\n", unexpected.what());
        return 1;
    }
}
