// SPDX-License-Identifier: MIT
#include "scene_arguments.hpp"

#include <fmt/format.h>

namespace gnomon::cli {

CLI::Validator not_empty() {
    return {[](const std::string& text) {
                return text.empty() ? std::string("the name is empty") : std::string();
            },
            ""};
}

void add_scene_options(CLI::App& app, RenderOptions& o) {
    app.add_option_function<std::string>("--size", parsed_into(o.size, parse_size),
                                         "Pixels; default 1280x720")
        ->type_name("WIDTHxHEIGHT");
    app.add_option("--samples", o.samples, "Samples a pixel: 1 or 4")->check(CLI::IsMember({1, 4}));
    const auto vector = [](const char* what) {
        return [what](const std::string& text) { return parse_vector(text, what); };
    };
    app.add_option_function<std::string>("--eye", parsed_into(o.eye, vector("--eye")),
                                         "Where the camera stands")
        ->type_name("x,y,z");
    app.add_option_function<std::string>("--target", parsed_into(o.target, vector("--target")),
                                         "What it looks at")
        ->type_name("x,y,z");
    app.add_option_function<std::string>(
           "--up",
           parsed_into(o.up,
                       [](const std::string& text) -> Result<glm::dvec3> {
                           auto up = parse_vector(text, "--up");
                           if (up && glm::length(*up) < smallest_length) {
                               return fail(ErrorCode::InvalidInput,
                                           fmt::format("--up: \"{}\" has no direction.", text));
                           }
                           return up;
                       }),
           "Which way is up; default 0,1,0")
        ->type_name("x,y,z");
    const auto number = [](const char* what, double min, double max) {
        return [=](const std::string& text) { return parse_number(text, what, min, max); };
    };
    app.add_option_function<std::string>("--fovy",
                                         parsed_into(o.fovy_deg, number("--fovy", 0.01, 179.0)),
                                         "Vertical field of view in degrees; default 45")
        ->type_name("DEGREES");
    app.add_option_function<std::vector<std::string>>(
           "--light",
           [&o](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   auto light = parse_light(text);
                   if (!light) throw CLI::ValidationError("", light.error().message);
                   o.lights.push_back(*light);
               }
           },
           "point:x,y,z[,range=R] or dir:x,y,z (the way it travels); repeatable")
        ->type_name("LIGHT")
        ->allow_extra_args(false);
    app.add_option("--max-shadowed-lights", o.max_shadowed_lights,
                   "At most this many lights cast shadows: those that bring most to what the "
                   "camera looks at. The others shine through everything")
        ->check(CLI::Range(0, 1000000));
    app.add_option("--casters", o.casters, "Only nodes whose name matches cast")->type_name("GLOB");
    app.add_option("--receivers", o.receivers, "Only nodes whose name matches are drawn")
        ->type_name("GLOB");
    app.add_option_function<std::string>(
           "--cull", [&o](const std::string& text) { o.cull_back = text == "back"; },
           "Which faces are left out of the picture; default none")
        ->check(CLI::IsMember({"none", "back"}));
    app.add_option_function<std::string>(
           "--technique",
           [&o](const std::string& text) {
               if (text == "zpass") o.technique = shadows::Technique::DepthPass;
               if (text == "zfail") o.technique = shadows::Technique::DepthFail;
           },
           "Depth-pass, depth-fail, or chosen per caster and light (auto)")
        ->check(CLI::IsMember({"auto", "zpass", "zfail"}));
    app.add_option_function<std::string>(
           "--caps",
           [&o](const std::string& text) {
               if (text == "averted") o.near_caps = shadows::NearCaps::Averted;
           },
           "Which faces of closed casters carry near caps; averted: those turned away from the "
           "light, which smooth normals alone then shade. Default facing")
        ->check(CLI::IsMember({"facing", "averted"}));
    app.add_option("--silhouette", o.silhouette, "How silhouettes are found")
        ->type_name("auto|NAME");
    app.add_option_function<std::string>(
           "--layers",
           [&o](const std::string& text) {
               if (text == "promised") o.layer_bound = shadows::LayerBound::Promised;
           },
           "Whether it is proved that no point lies under more layers than the stencil counts, or "
           "you promise it, so that nothing is bounded nor split. Default proved")
        ->check(CLI::IsMember({"proved", "promised"}));
    app.add_option_function<std::string>(
           "--without", parsed_into(o.fill, parse_without),
           "Savings of fill to do without, for measurements: view-cull,receiver-cull,umbra-"
           "cull,clamp,scissor,depth-bounds; all")
        ->type_name("LIST");
    app.add_flag_callback(
        "--slabs", [&o] { o.fill.slabs = true; },
        "Leave volumes out where the light meets no receiver on its way as well: fewer fragments, "
        "more draws");
    app.add_option_function<std::string>(
           "--show", parsed_into(o.overlays, parse_overlays),
           "Debug views: volumes,silhouettes,caps,wireframe,count,fill")
        ->type_name("LIST");
    app.add_option_function<std::string>(
           "--time", parsed_into(o.time_s, number("--time", -1e9, 1e9)),
           "Pose the scene as its animations have it at this time; they loop. All frames have "
           "this pose, unless --animate time:SECONDS moves on from it")
        ->type_name("SECONDS");
    app.add_option("--animation", o.animation,
                   "Which animation is played, at --time or at 0: its name, or its number from 0; "
                   "default the first of each model")
        ->check(not_empty())
        ->type_name("NAME|INDEX");
    app.add_option_function<std::string>(
           "--near", parsed_into(o.near_m, number("--near", smallest_length, largest_coordinate)),
           "Near plane in metres; default 1e-5 of the scene's diagonal")
        ->type_name("METRES");
}

}  // namespace gnomon::cli
