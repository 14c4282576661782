// SPDX-License-Identifier: MIT
//
// Stage: a level as a scene of gnomon's own, and where everything in it is at a tick. It has no
// rules: the world tells it where the player is. What it poses is at once what is drawn and what
// shadow queries are asked about.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/shadows/shadow_query.hpp>

#include "collision.hpp"
#include "exposure.hpp"
#include "figure.hpp"
#include "level.hpp"
#include "lights.hpp"
#include "player.hpp"
#include "textures.hpp"
#include "timing.hpp"

namespace gnomon::game {

/// What a tick looks like.
struct Scenery {
    Tick tick = 0;
    const Player* player = nullptr;      ///< none: nobody is there
    const Meter* meter = nullptr;        ///< shown as a ring about the player's feet
    std::span<const double> doors = {};  ///< how far each is open, 0 to 1; fewer: shut
};

class Stage {
public:
    /// Fails as load_skeleton() and where a mesh is refused.
    [[nodiscard]] static Result<Stage> create(const Level& level);

    /// Gives it the pictures that only drawing needs; again does nothing. Before upload().
    void dress();

    /// Moves everything there and brings lights and queries up to date. Fails as scene::deform()
    /// and ShadowAdapter::casters().
    [[nodiscard]] Status pose(const Scenery& scenery);

    [[nodiscard]] const scene::Scene& scene() const { return scene_; }
    /// The one that made the queries' meshes: whoever draws the scene and takes it, too, has no
    /// shadow mesh of a figure made twice.
    [[nodiscard]] scene::ShadowAdapter& adapter() { return adapter_; }
    [[nodiscard]] const shadows::ShadowQueries& queries() const { return queries_; }
    [[nodiscard]] std::span<const MeterLight> lights() const { return lights_; }

    /// Keys of the casters that are the player.
    [[nodiscard]] std::span<const std::uint64_t> player_keys() const { return player_keys_; }
    /// Points of the player's figure as it stands now, from head to foot.
    [[nodiscard]] std::vector<glm::dvec3> player_points() const;

    /// What stands in the way and does not move.
    [[nodiscard]] std::span<const Obstacle> obstacles() const { return obstacles_; }

private:
    friend class StageBuilder;
    Stage() = default;

    void pose_figures(const Scenery& scenery);
    void pose_movers(const Scenery& scenery);
    void pose_ring(const Scenery& scenery);

    Level level_;
    scene::Scene scene_;
    scene::ShadowAdapter adapter_;
    shadows::ShadowQueries queries_;
    std::vector<MeterLight> lights_;
    std::vector<Obstacle> obstacles_;
    std::vector<std::uint64_t> player_keys_;

    std::uint32_t ground_material_ = 0;
    std::vector<std::pair<std::uint32_t, Grain>> grains_;  ///< which material has which
    Skeleton skeleton_;
    Figure player_;
    std::vector<Figure> guards_;
    std::vector<scene::Entity> guard_lamps_;
    std::vector<scene::Entity> searchlights_;
    std::vector<scene::Entity> doors_;
    std::vector<scene::Entity> crane_arms_;
    std::vector<scene::Entity> crane_loads_;
    std::vector<scene::Entity> wheels_;
    std::optional<scene::Entity> sun_;
    scene::Entity ring_;
    /// Each segment as it looks when hidden, lit and alarmed: one of the three is drawn.
    std::vector<std::array<scene::Entity, 3>> segments_;
};

}  // namespace gnomon::game
