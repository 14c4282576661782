// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gnomon/window/window.hpp>

#include "scene_arguments.hpp"
#include "view/view_options.hpp"

namespace gnomon::cli {

const CLI::App* add_view(CLI::App& app, ViewOptions& o) {
    auto* view = app.add_subcommand("view", "Look at a scene and its shadows in a window");
    view->footer(
        "SCENE is anything that gnomon render takes; a file may also be dropped on the window.\n"
        "Drag turns or moves what is selected: the camera, a light (by its handle) or a caster "
        "(click it first).\n"
        "  T move, R turn, C or Esc camera, L next light; right or middle drag pans, the wheel "
        "zooms, F frames all;\n"
        "  dragging with Shift moves within a level instead of along the picture.\n"
        "  Space plays, Left and Right step, Tab panel, 1 to 6 debug views, Q probe, G ground, P "
        "picture, B "
        "other backend,\n"
        "  F5 reads the file again, F11 full screen.\n\n"
        "  gnomon view engine.glb\n"
        "  gnomon view builtin:walk --backend vk --show silhouettes\n"
        "  gnomon view city.glb --script tour.input --screenshot city.png\n\n"
        "A script has one event a line, FRAME EVENT: move X Y, press|release|tap|click "
        "BUTTON-OR-KEY,\n"
        "scroll N, type TEXT, drop FILE, close; and size WxH, backend gl|vk, screenshot FILE. A "
        "frame is 1/60 s then.");
    view->add_option("scene", o.render.scene, "The scene to look at; default builtin:pillars")
        ->type_name("SCENE");
    std::vector<std::string> names;
    for (const window::Backend backend : window::backends()) {
        names.emplace_back(window::name_of(backend));
    }
    view->add_option("--backend", o.render.backend,
                     fmt::format("One of {}", fmt::join(names, ", ")))
        ->check(CLI::IsMember(names));
    add_scene_options(*view, o.render);
    view->add_option("--script", o.script,
                     "Play input from this file instead of reading mouse and keyboard; ends two "
                     "frames after its last event")
        ->check(not_empty())
        ->type_name("FILE");
    view->add_option("--frames", o.frames, "End after so many frames")
        ->check(CLI::Range(1, 1000000));
    view->add_option("--screenshot", o.screenshot,
                     "Write what the window showed last here (PNG), panel included")
        ->check(not_empty())
        ->type_name("IMAGE.png");
    view->add_flag("--ground", o.ground,
                   "Begin with a floor below everything, for models without one");
    view->add_flag("!--no-panel", o.panel, "Begin without panel, hints and probe");
    view->add_flag("--quiet", o.render.quiet, "No notes");
    return view;
}

}  // namespace gnomon::cli
