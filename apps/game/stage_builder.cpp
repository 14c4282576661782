// SPDX-License-Identifier: MIT
//
// From a level to a stage: meshes, materials, lights, obstacles.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <gnomon/scene/primitives.hpp>

#include "movers.hpp"
#include "props.hpp"
#include "stage.hpp"

namespace gnomon::game {

namespace {

constexpr double border_m = 24.0;   // of ground around a level
constexpr double buried_m = 0.03;   // by which things stand in the ground
constexpr double headroom_m = 1.9;  // what begins above it is no obstacle
constexpr double least_crate_m = 0.2;
constexpr std::size_t ring_segments = 24;

enum class Part : std::uint8_t { Solid, Glow };  // what glows is drawn and casts nothing

std::shared_ptr<const scene::Mesh> share(scene::Mesh mesh) {
    return std::make_shared<const scene::Mesh>(std::move(mesh));
}

}  // namespace

class StageBuilder {
public:
    explicit StageBuilder(const Level& level) { stage_.level_ = level; }

    Result<Stage> build() {
        auto skeleton = load_skeleton();
        if (!skeleton) return forward_error(skeleton);
        stage_.skeleton_ = std::move(*skeleton);
        stage_.scene_.materials.emplace_back().name = "default";
        glow_ = paint({0.1F, 0.1F, 0.1F}, 0.9F, {3.2F, 2.6F, 1.7F});
        iron_ = paint({0.10F, 0.105F, 0.115F}, 0.55F);
        oak_ = painted({0.46F, 0.31F, 0.18F}, Grain::Planks);

        add_ground();
        add_architecture();
        add_lights();
        add_doors();
        for (const Crane& crane : level().cranes) add_crane(crane);
        for (const Wheel& wheel : level().wheels) add_wheel(wheel);
        add_exit();
        add_ring();
        if (const Status added = add_figures(); !added) return forward_error(added);
        const Player player{.at = level().start, .facing_rad = level().start_facing_rad};
        if (const Status posed = stage_.pose({.player = &player}); !posed) {
            return forward_error(posed);
        }
        return std::move(stage_);
    }

private:
    [[nodiscard]] const Level& level() const { return stage_.level_; }
    scene::Registry& registry() { return stage_.scene_.registry; }

    std::uint32_t paint(const glm::vec3& color, float roughness,
                        const glm::vec3& emissive = glm::vec3(0.0F)) {
        scene::Material material;
        material.base_color = glm::vec4(color, 1.0F);
        material.roughness = roughness;
        material.emissive = emissive;
        stage_.scene_.materials.push_back(std::move(material));
        return static_cast<std::uint32_t>(stage_.scene_.materials.size() - 1);
    }

    scene::Entity add(std::string name, std::shared_ptr<const scene::Mesh> mesh,
                      const scene::LocalTransform& local,
                      std::optional<scene::Entity> parent = std::nullopt, Part part = Part::Solid) {
        const scene::Entity entity = stage_.scene_.create_node(std::move(name), local, parent);
        registry().emplace<scene::MeshInstance>(entity, std::move(mesh));
        registry().emplace<scene::Receiver>(entity);
        if (part == Part::Solid) registry().emplace<scene::Caster>(entity);
        return entity;
    }

    void block_way(const glm::dvec2& at, const glm::dvec2& half_m, double turn_rad = 0.0) {
        stage_.obstacles_.push_back({.at = at, .half_m = half_m, .turn_rad = turn_rad});
    }
    void block_way_round(const glm::dvec2& at, double radius_m) {
        stage_.obstacles_.push_back({.at = at, .radius_m = radius_m});
    }

    void add_ground() {
        const std::uint32_t material = paint(glm::vec3(1.0F), 0.92F);
        stage_.ground_material_ = material;
        const glm::vec2 size(level().size_m + 2.0 * border_m);
        // It receives; below it there is nothing that its shadow could fall on.
        add("ground", share(scene::make_plane(size.x, size.y, 8, material)), {}, std::nullopt,
            Part::Glow);
    }

    std::uint32_t painted(const glm::vec3& color, Grain grain) {
        for (const Paint& known : palette_) {
            if (known.color == color && known.grain == grain) return known.material;
        }
        palette_.push_back({color, grain, paint(color, 0.88F)});
        stage_.grains_.emplace_back(palette_.back().material, grain);
        return palette_.back().material;
    }

    static std::shared_ptr<const scene::Mesh> tiled(scene::Mesh mesh) {
        lay_tiles(mesh);
        return share(std::move(mesh));
    }

    void add_architecture() {
        std::size_t number = 0;
        for (const Block& block : level().blocks) {
            const double sunk = block.base_m > 0.0 ? 0.0 : buried_m;
            const glm::dvec3 size(block.size_m.x, block.size_m.y + sunk, block.size_m.z);
            const Grain plain = block.size_m.y > 2.0 ? Grain::Ribs : Grain::Planks;
            const std::uint32_t material =
                painted(block.color, block.is_wall ? Grain::Bricks : plain);
            const scene::LocalTransform local{
                .translation = {block.at.x, block.base_m + size.y * 0.5 - sunk, block.at.y},
                .rotation = turned_in_plan(block.turn_rad)};
            // Narrower than that, the bars of a crate would meet from both sides.
            const bool is_crate = !block.is_wall && block.size_m.y <= 3.0 &&
                                  std::min(block.size_m.x, block.size_m.z) >= least_crate_m;
            add(fmt::format("block {}", ++number),
                tiled(is_crate ? make_crate(size, material)
                               : scene::make_box(glm::vec3(size), material)),
                local);
            if (block.base_m < headroom_m) {
                block_way(block.at, glm::dvec2(block.size_m.x, block.size_m.z) * 0.5,
                          block.turn_rad);
            }
        }
        const std::uint32_t stone = paint(level().mood.walls * 1.15F, 0.85F);
        for (const Column& column : level().columns) {
            const auto radius = static_cast<float>(column.radius_m);
            const auto height = static_cast<float>(column.height_m);
            const scene::Entity foot =
                stage_.scene_.create_node(fmt::format("column {}", ++number),
                                          {.translation = {column.at.x, 0.0, column.at.y}});
            add("shaft", share(scene::make_cylinder(radius, height - 0.2F, 40, stone)),
                {.translation = {0.0, column.height_m * 0.5, 0.0}}, foot);
            const auto slab = share(scene::make_box({radius * 2.7F, 0.24F, radius * 2.7F}, stone));
            add("base", slab, {.translation = {0.0, 0.12 - buried_m, 0.0}}, foot);
            add("capital", slab, {.translation = {0.0, column.height_m - 0.12, 0.0}}, foot);
            block_way(column.at, glm::dvec2(column.radius_m * 1.35));
        }
    }

    void add_lights() {
        if (level().sun) {
            const Sun& sun = *level().sun;
            stage_.sun_ = stage_.scene_.create_node("sun");
            registry().emplace<scene::DirectionalLight>(*stage_.sun_, sun.color,
                                                        static_cast<float>(sun.lux));
        }
        const auto bulb = share(scene::make_sphere(0.11F, 16, 8, glow_));
        for (const Lamp& lamp : level().lamps) {
            const scene::Entity entity =
                stage_.scene_.create_node("lamp", {.translation = lamp.at});
            registry().emplace<scene::PointLight>(entity, lamp.color,
                                                  static_cast<float>(lamp.candela), lamp.range_m);
            add("bulb", bulb, {}, entity, Part::Glow);
            // It hangs from an arm, on the side of its post where the level is.
            const glm::dvec2 at(lamp.at.x, lamp.at.z);
            const glm::dvec2 out =
                glm::length(at) > 0.1 ? glm::normalize(at) : glm::dvec2(0.0, 1.0);
            constexpr double arm_m = 0.55;
            constexpr double over_m = 0.42;
            const double post_m = lamp.at.y + over_m;
            const auto post = static_cast<float>(post_m);
            add("post", share(scene::make_cylinder(0.05F, post, 12, iron_)),
                {.translation = {out.x * arm_m, post_m * 0.5 - lamp.at.y, out.y * arm_m}}, entity);
            add("arm",
                share(scene::make_box({0.05F, 0.05F, static_cast<float>(arm_m) + 0.1F}, iron_)),
                {.translation = {out.x * arm_m * 0.5, over_m - 0.06, out.y * arm_m * 0.5},
                 .rotation = turned_in_plan(plan_angle(out))},
                entity);
            add("shade", share(scene::make_cylinder(0.24F, 0.03F, 24, iron_)),
                {.translation = {0.0, 0.26, 0.0}}, entity);
            block_way_round(at + out * arm_m, 0.12);
        }
        for (const Searchlight& light : level().searchlights) {
            const double mast_m = light.at.y - 0.55;
            add("mast", share(make_lattice(mast_m, 0.8, iron_)),
                {.translation = {light.at.x, 0.0, light.at.z}});
            block_way({light.at.x, light.at.z}, glm::dvec2(0.5));
            const scene::Entity head =
                stage_.scene_.create_node("searchlight", {.translation = light.at});
            registry().emplace<scene::SpotLight>(
                head, light.color, static_cast<float>(light.candela), light.range_m,
                static_cast<float>(light.cone_rad * 0.8), static_cast<float>(light.cone_rad));
            const glm::dquat along_z =
                glm::angleAxis(std::numbers::pi * 0.5, glm::dvec3(1.0, 0.0, 0.0));
            add("housing", share(scene::make_cylinder(0.34F, 0.6F, 24, iron_)),
                {.translation = {0.0, 0.0, 0.36}, .rotation = along_z}, head);
            add("lens", share(scene::make_cylinder(0.29F, 0.04F, 24, glow_)),
                {.translation = {0.0, 0.0, 0.04}, .rotation = along_z}, head, Part::Glow);
            stage_.searchlights_.push_back(head);
        }
    }

    void add_doors() {
        for (const Door& door : level().doors) {
            const scene::Entity hinge = stage_.scene_.create_node(
                "door", {.translation = {door.hinge.x, 0.0, door.hinge.y}});
            const glm::dvec3 size(0.09, door.height_m - 0.04, door.width_m - 0.08);
            add("leaf", tiled(make_crate(size, oak_)),
                {.translation = {0.0, 0.04 + size.y * 0.5, door.width_m * 0.5}}, hinge);
            stage_.doors_.push_back(hinge);
        }
    }

    void add_crane(const Crane& crane) {
        const std::uint32_t yellow = paint({0.46F, 0.27F, 0.05F}, 0.7F);
        const scene::LocalTransform foot{.translation = {crane.at.x, 0.0, crane.at.y}};
        add("crane mast", share(make_lattice(crane.height_m, 1.0, yellow)), foot);
        block_way(crane.at, glm::dvec2(0.62));
        // The arm looks along +Z where its plan angle is 0.
        const scene::Entity arm = stage_.scene_.create_node(
            "crane arm", {.translation = {crane.at.x, crane.height_m, crane.at.y}});
        const glm::dquat lying = glm::angleAxis(std::numbers::pi * 0.5, glm::dvec3(1.0, 0.0, 0.0));
        const double back_m = crane.arm_m * 0.3;
        add("beam", share(make_lattice(crane.arm_m + back_m, 0.62, yellow)),
            {.translation = {0.0, 0.33, -back_m}, .rotation = lying}, arm);
        add("counterweight", share(scene::make_box({1.0F, 0.9F, 0.8F}, iron_)),
            {.translation = {0.0, -0.15, -back_m}}, arm);
        add("cabin", share(scene::make_box({0.95F, 1.0F, 0.95F}, yellow)),
            {.translation = {0.0, -0.55, 0.85}}, arm);
        const double top_m = crane.load_base_m + crane.load_m.y;
        const double rope_m = crane.height_m - top_m;
        const scene::Entity hook =
            stage_.scene_.create_node("hook", {.translation = {0.0, 0.0, crane.arm_m * 0.94}}, arm);
        add("rope", share(scene::make_cylinder(0.035F, static_cast<float>(rope_m), 8, iron_)),
            {.translation = {0.0, -rope_m * 0.5, 0.0}}, hook);
        add("load", tiled(make_crate(crane.load_m, oak_)),
            {.translation = {0.0, -rope_m - crane.load_m.y * 0.5, 0.0}}, hook);
        stage_.crane_arms_.push_back(arm);
        stage_.crane_loads_.push_back(hook);
    }

    void add_wheel(const Wheel& wheel) {
        const double axle_m = wheel.radius_m * 1.06 + 0.12;
        const scene::Entity hub =
            add("wheel", tiled(make_spoked_wheel(wheel.radius_m, wheel.spokes, oak_)),
                {.translation = {wheel.at.x, axle_m, wheel.at.y}});
        stage_.wheels_.push_back(hub);
        const glm::dvec2 axis = plan_direction(wheel.turn_rad);
        const glm::dvec2 across(axis.y, -axis.x);
        const auto post =
            tiled(scene::make_box(glm::vec3(0.16F, static_cast<float>(axle_m + 0.3), 0.16F), oak_));
        for (const double side : {-0.5, 0.5}) {
            for (const double lean : {-0.22, 0.22}) {
                const glm::dvec2 at = wheel.at + axis * side + across * (lean * axle_m * 0.5);
                add("post", post,
                    {.translation = {at.x, axle_m * 0.5, at.y},
                     .rotation = turned_in_plan(wheel.turn_rad) *
                                 glm::angleAxis(lean, glm::dvec3(0.0, 0.0, 1.0))});
            }
        }
        block_way(wheel.at, {wheel.radius_m, 0.6}, wheel.turn_rad);
    }

    void add_exit() {
        const std::uint32_t jade = paint({0.05F, 0.12F, 0.10F}, 0.7F, {0.05F, 0.42F, 0.30F});
        const glm::dvec2 half = level().exit_half_m;
        const glm::dvec2 at = level().exit;
        // A frame on the ground and one beacon: nothing to hide behind.
        for (const double side : {-1.0, 1.0}) {
            add("threshold", share(scene::make_box(glm::vec3(half.x * 2.0 + 0.1, 0.05, 0.1), jade)),
                {.translation = {at.x, 0.02, at.y + side * half.y}}, std::nullopt, Part::Glow);
            add("threshold", share(scene::make_box(glm::vec3(0.1, 0.05, half.y * 2.0 - 0.1), jade)),
                {.translation = {at.x + side * half.x, 0.02, at.y}}, std::nullopt, Part::Glow);
        }
        const scene::Entity beacon =
            stage_.scene_.create_node("exit", {.translation = {at.x, 1.1, at.y}});
        registry().emplace<scene::PointLight>(beacon, glm::vec3(0.2F, 1.0F, 0.75F), 0.7F, 4.0);
    }

    void add_ring() {
        stage_.ring_ = stage_.scene_.create_node("ring");
        const std::array<std::uint32_t, 3> looks{
            paint({0.02F, 0.03F, 0.05F}, 0.9F, {0.015F, 0.05F, 0.12F}),
            paint({0.1F, 0.08F, 0.02F}, 0.9F, {1.1F, 0.72F, 0.16F}),
            paint({0.1F, 0.02F, 0.02F}, 0.9F, {1.6F, 0.10F, 0.04F})};
        std::array<std::shared_ptr<const scene::Mesh>, 3> meshes;
        for (std::size_t k = 0; k < looks.size(); ++k) {
            meshes[k] = share(scene::make_box({0.105F, 0.012F, 0.05F}, looks[k]));
        }
        for (std::size_t i = 0; i < ring_segments; ++i) {
            // Begins in the north and goes on clockwise, as seen from above.
            const double angle = std::numbers::pi - 2.0 * std::numbers::pi *
                                                        (static_cast<double>(i) + 0.5) /
                                                        ring_segments;
            const glm::dvec2 out = plan_direction(angle) * 0.52;
            std::array<scene::Entity, 3> segment;
            for (std::size_t k = 0; k < meshes.size(); ++k) {
                segment[k] =
                    add("segment", meshes[k],
                        {.translation = {out.x, 0.012, out.y}, .rotation = turned_in_plan(angle)},
                        stage_.ring_, Part::Glow);
            }
            stage_.segments_.push_back(segment);
        }
    }

    Status add_figures() {
        scene::Scene& scene = stage_.scene_;
        Dress player{.cloth = paint({0.30F, 0.37F, 0.50F}, 0.8F),
                     .trousers = paint({0.10F, 0.10F, 0.12F}, 0.9F),
                     .skin = paint({0.55F, 0.36F, 0.26F}, 0.6F),
                     .accent = paint({0.62F, 0.07F, 0.045F}, 0.8F, {0.03F, 0.002F, 0.001F}),
                     .hooded = true};
        auto mesh = make_figure_mesh(stage_.skeleton_, player);
        if (!mesh) return forward_error(mesh);
        stage_.player_ = add_figure(scene, stage_.skeleton_, "player", *mesh);
        stage_.player_keys_ = {stage_.player_.body.key()};
        if (level().guards.empty()) return {};

        const Dress guard{.cloth = paint({0.30F, 0.32F, 0.37F}, 0.8F),
                          .trousers = paint({0.16F, 0.16F, 0.18F}, 0.9F),
                          .skin = player.skin,
                          .accent = paint({0.40F, 0.29F, 0.11F}, 0.4F)};
        mesh = make_figure_mesh(stage_.skeleton_, guard);
        if (!mesh) return forward_error(mesh);
        const auto lantern = share(scene::make_cylinder(0.075F, 0.16F, 12, glow_));
        const auto lid = share(scene::make_cylinder(0.095F, 0.03F, 12, iron_));
        for (const Guard& g : level().guards) {
            const Figure figure = add_figure(scene, stage_.skeleton_, "guard", *mesh);
            // Where the hand that holds it out is (pose_figure()).
            const glm::dvec3 hand(-0.235, 0.98, 0.47);
            const scene::Entity lamp =
                scene.create_node("guard lamp", {.translation = hand}, figure.root);
            registry().emplace<scene::SpotLight>(lamp, g.color, static_cast<float>(g.candela),
                                                 g.range_m, static_cast<float>(g.cone_rad * 0.55),
                                                 static_cast<float>(g.cone_rad));
            // What the lamp sheds about itself.
            const scene::Entity shed = scene.create_node(
                "lamp shed", {.translation = hand + glm::dvec3(0.0, 0.06, 0.02)}, figure.root);
            registry().emplace<scene::PointLight>(shed, g.color,
                                                  static_cast<float>(g.candela * 0.012), 2.5);
            add("lantern", lantern, {.translation = hand}, figure.root, Part::Glow);
            add("lid", lid, {.translation = hand + glm::dvec3(0.0, 0.1, 0.0)}, figure.root,
                Part::Glow);
            stage_.guards_.push_back(figure);
            stage_.guard_lamps_.push_back(lamp);
        }
        return {};
    }

    Stage stage_;
    std::uint32_t glow_ = 0;
    std::uint32_t iron_ = 0;
    std::uint32_t oak_ = 0;
    struct Paint {
        glm::vec3 color;
        Grain grain;
        std::uint32_t material;
    };
    std::vector<Paint> palette_;
};

void Stage::dress() {
    scene::Material& ground = scene_.materials[ground_material_];
    if (ground.base_color_image) return;
    ground.base_color_image = make_ground_image(level_, border_m);
    std::array<std::shared_ptr<const scene::Image>, 3> images;
    for (const auto& [material, grain] : grains_) {
        auto& image = images[static_cast<std::size_t>(grain)];
        if (!image) image = make_grain_image(grain);
        scene_.materials[material].base_color_image = image;
    }
}

Result<Stage> Stage::create(const Level& level) { return StageBuilder(level).build(); }

}  // namespace gnomon::game
