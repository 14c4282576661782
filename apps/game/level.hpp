// SPDX-License-Identifier: MIT
//
// Level: what a level file says, as plain data in metres, seconds, radians and lux. The ground is
// y = 0; plan coordinates are (x, z), x to the east and z to the south, so that a camera that looks
// north has x to its right. Angles of the plan turn about +Y: 0 looks south (+Z), a quarter looks
// east (+X). The format is described in docs/game.md.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>

namespace gnomon::game {

struct Mood {
    glm::vec3 sky{0.030F, 0.042F, 0.075F};  ///< what comes from above without a light; linear
    glm::vec3 ground{0.014F, 0.014F, 0.018F};
    glm::vec3 background{0.010F, 0.014F, 0.026F};
    float exposure = 0.5F;  ///< radiance of a white surface under one lux, before tone mapping
    glm::vec3 floor{0.22F, 0.21F, 0.20F};
    glm::vec3 walls{0.34F, 0.31F, 0.29F};
    glm::vec3 outside{0.09F, 0.095F, 0.075F};  ///< the ground around the level
};

struct CameraRig {
    double pitch_rad = 0.95;  ///< below the horizon
    double yaw_rad = 0.0;     ///< 0 looks north
    double distance_m = 14.0;
    double fovy_rad = 0.65;
};

/// What stands on the ground, or hangs above it, and does not move. A box.
struct Block {
    glm::dvec2 at{0.0};
    glm::dvec3 size_m{1.0};
    double turn_rad = 0.0;
    double base_m = 0.0;  ///< of its lower side above the ground
    bool is_wall = false;
    glm::vec3 color{0.3F};
};

struct Column {
    glm::dvec2 at{0.0};
    double radius_m = 0.4;
    double height_m = 3.0;
};

/// A directional light that swings from one place in the sky to the other and back.
struct Sun {
    glm::dvec2 from_rad{0.0, 0.7};  ///< azimuth (a plan angle: where it stands), elevation
    glm::dvec2 to_rad{0.0, 0.7};
    double period_s = 120.0;  ///< there and back
    double lux = 1.0;
    glm::vec3 color{1.0F};
};

struct Lamp {
    glm::dvec3 at{0.0, 3.0, 0.0};
    double candela = 20.0;
    double range_m = 10.0;
    glm::vec3 color{1.0F};
};

/// A spot on a mast that follows a closed path on the ground, at even speed between its points.
struct Searchlight {
    glm::dvec3 at{0.0, 7.0, 0.0};
    std::vector<glm::dvec2> path;
    double period_s = 16.0;
    double candela = 400.0;
    double range_m = 40.0;
    double cone_rad = 0.12;  ///< from the axis to where it ends
    glm::vec3 color{1.0F};
};

/// Walks a closed path for ever, waits at each of its points, and carries a lamp that shines ahead.
struct Guard {
    std::vector<glm::dvec2> path;
    double speed_m_s = 1.1;
    double pause_s = 1.0;
    double hearing_m = 4.0;  ///< who runs within it is heard
    double candela = 22.0;
    double range_m = 9.0;
    double cone_rad = 0.5;
    glm::vec3 color{1.0F, 0.75F, 0.45F};
};

/// A leaf that opens for whoever is near.
struct Door {
    glm::dvec2 hinge{0.0};
    double width_m = 1.2;
    double height_m = 2.1;
    double turn_rad = 0.0;  ///< plan angle from the hinge along the leaf when it is shut
    double open_rad = 1.6;  ///< by which it turns
};

/// A mast with an arm that swings between two plan angles and a load that hangs from its end.
struct Crane {
    glm::dvec2 at{0.0};
    double height_m = 7.0;
    double arm_m = 6.0;
    glm::dvec2 swing_rad{-0.7, 0.7};
    double period_s = 24.0;
    glm::dvec3 load_m{1.8, 1.6, 1.8};
    double load_base_m = 2.3;
};

/// An upright wheel with spokes on two posts.
struct Wheel {
    glm::dvec2 at{0.0};
    double radius_m = 2.6;
    std::uint32_t spokes = 8;
    double turn_rad = 0.0;  ///< plan angle of its axle
    double period_s = 18.0;
};

struct Level {
    std::string name;
    std::string hint;         ///< two sentences at most; may be empty
    glm::dvec2 size_m{20.0};  ///< the ground's, centred on the origin
    Mood mood;
    CameraRig camera;
    glm::dvec2 start{0.0};
    double start_facing_rad = 0.0;
    glm::dvec2 exit{0.0};
    glm::dvec2 exit_half_m{0.8};
    double seen_lux = 2.0;        ///< a point under as much is seen as well as can be
    double caught_after_s = 1.2;  ///< when it is all of the figure
    std::optional<Sun> sun;
    std::vector<Block> blocks;  ///< walls first
    std::vector<Column> columns;
    std::vector<Lamp> lamps;
    std::vector<Searchlight> searchlights;
    std::vector<Guard> guards;
    std::vector<Door> doors;
    std::vector<Crane> cranes;
    std::vector<Wheel> wheels;
};

/// The names of the levels that the game comes with, in the order in which they are played.
inline constexpr std::array<std::string_view, 3> playing_order{"courtyard", "barracks", "dockyard"};

/// Reads a level from text; `file` is what errors call it. Fails with ErrorCode::InvalidInput, one
/// sentence that names file, place, value and limit.
[[nodiscard]] Result<Level> read_level(std::string_view text, const std::string& file);

}  // namespace gnomon::game
