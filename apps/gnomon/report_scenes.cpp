// SPDX-License-Identifier: MIT
#include "report_scenes.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/transforms.hpp>

#include "render_setup.hpp"

namespace gnomon::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_lights = 4;

/// A scene of the standard set.
struct Standard {
    const char* name;
    const char* source;  ///< a file: below one of the folders of models
    report::Kind kind;
    bool quick = false;
    std::optional<Look> look = std::nullopt;
    bool ground = false;  ///< is put below: the model has none
};
// The camera stands where a player would, the sun where it throws long shadows.
constexpr Standard standard_set[] = {
    {"room", "builtin:room", report::Kind::Indoor, true},
    {"duplex-house", "scenes/duplex-house.glb", report::Kind::Indoor, false,
     Look{{-4.0, 1.7, 3.0}, {-4.0, 0.8, 10.0}, 70.0, {false, {-4.0, 2.2, 6.0}}}},
    {"godot-room", "scenes/godot-room.glb", report::Kind::Indoor, false,
     Look{{-0.5, 1.7, 3.6}, {0.5, 1.6, -3.0}, 70.0, {false, {1.9, 1.0, -1.2}}}},
    {"pillars", "builtin:pillars", report::Kind::Outdoor, true},
    {"linz-old-town", "scenes/linz-old-town.glb", report::Kind::Outdoor, false,
     Look{{-150.0, 70.0, 260.0}, {20.0, 5.0, 40.0}, 50.0, {true, {-1.0, -0.9, -0.6}}}},
    {"knot", "builtin:knot", report::Kind::Hero, true},
    {"engine", "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", report::Kind::Hero, false,
     std::nullopt, true},
    {"flight-helmet", "props/flight-helmet.glb", report::Kind::Hero, false, std::nullopt, true},
    {"open-shapes", "builtin:open-shapes", report::Kind::Other},
    {"still-life", "builtin:still-life", report::Kind::Other},
};
constexpr const char* model_folders[] = {"/usr/share/assimp/models", "../shared/models"};

constexpr const char* why_it_is_missing =
    "neither /usr/share/assimp/models (package assimp-testmodels) nor ../shared/models has the "
    "file";

// So much larger than the model that its border is out of sight, and just below it.
void put_on_ground(Shot& shot) {
    const double size_m = 8.0 * shot.bounds.diagonal();
    const glm::dvec3 middle = shot.bounds.center();
    const double height_m = shot.bounds.min.y - 1e-3 * shot.bounds.diagonal();
    const scene::Entity ground =
        shot.scene.create_node("ground", {.translation = {middle.x, height_m, middle.z}});
    scene::Registry& registry = shot.scene.registry;
    registry.emplace<scene::MeshInstance>(
        ground, std::make_shared<const scene::Mesh>(
                    scene::make_plane(static_cast<float>(size_m), static_cast<float>(size_m))));
    registry.emplace<scene::Receiver>(ground);
    scene::update_world_transforms(registry);
}

}  // namespace

std::vector<WantedScene> standard_scenes(bool quick, std::vector<report::LeftOut>& left_out) {
    std::vector<WantedScene> scenes;
    for (const Standard& standard : standard_set) {
        const std::string source = standard.source;
        if (quick && !standard.quick) {
            left_out.push_back(
                {standard.name, source, "a first look (--quick) measures few scenes"});
            continue;
        }
        if (source.starts_with("builtin:")) {
            scenes.push_back({standard.name, source, standard.kind, {}, false});
            continue;
        }
        const auto* const folder = std::ranges::find_if(model_folders, [&](const char* candidate) {
            std::error_code error;
            return fs::is_regular_file(fs::path(candidate) / source, error);
        });
        if (folder == std::end(model_folders)) {
            left_out.push_back({standard.name, source, why_it_is_missing});
            continue;
        }
        scenes.push_back({standard.name, (fs::path(*folder) / source).string(), standard.kind,
                          standard.look, standard.ground});
    }
    return scenes;
}

std::vector<WantedScene> given_scenes(const std::vector<std::string>& sources) {
    std::vector<WantedScene> scenes;
    std::set<std::string> taken;
    for (const std::string& source : sources) {
        std::string name =
            source.starts_with("builtin:") ? source.substr(8) : fs::path(source).stem().string();
        report::Kind kind = report::Kind::Other;
        for (const Standard& standard : standard_set) {
            if (source.ends_with(standard.source)) kind = standard.kind;
        }
        const std::string stem = name;
        for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{} ({})", stem, i);
        scenes.push_back({std::move(name), source, kind, {}, false});
    }
    return scenes;
}

Result<report::Subject> load_subject(const WantedScene& wanted, const report::Options& options) {
    RenderOptions shown{.scene = wanted.source, .size = {options.width, options.height}};
    if (wanted.look) {
        shown.eye = wanted.look->eye;
        shown.target = wanted.look->target;
        shown.fovy_deg = wanted.look->fovy_deg;
        shown.lights = {wanted.look->light};
    }
    auto shot = make_shot(shown);
    if (!shot) return forward_error(shot);
    if (wanted.ground) put_on_ground(*shot);
    report::Subject subject;
    subject.name = wanted.name;
    subject.source = wanted.source;
    subject.kind = wanted.kind;
    subject.scene = std::move(shot->scene);
    subject.camera = shot->camera;
    subject.world_from_camera = shot->world_from_camera;
    subject.near_m = shot->near_m;
    report::keep_lights(subject, options, most_lights);
    return subject;
}

}  // namespace gnomon::cli
