// SPDX-License-Identifier: MIT
//
// What the ShadowSystem remembers of one pair of caster and light, and how it brings it up to date.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/detector.hpp>
#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/shadows/silhouette.hpp>
#include <gnomon/shadows/volume.hpp>

#include "local_light.hpp"

namespace gnomon::shadows::internal {

struct CasterState {
    Caster caster;
    Pose pose;
    std::uint64_t pose_revision = 0;  ///< changes whenever a bit of the pose does
    std::uint64_t frame = 0;          ///< last submitted in
};

/// How a light's volumes were distributed last.
struct LayerMemory {
    std::vector<std::uint64_t> revisions;  ///< of the light, each volume and each pose
    std::vector<std::uint32_t> batches;    ///< of each draw, parts included; empty: not split
};

struct LightState {
    Light light;
    LayerMemory layers;
    std::uint64_t revision = 0;
    std::uint64_t frame = 0;
};

/// How many layers the volume can lay over a point, and what it was split into.
struct Layers {
    enum class Known : std::uint8_t { Nothing, QuickBound, Bound };
    struct Part {
        std::shared_ptr<const Volume> volume;
        std::uint64_t revision = 0;
        std::uint32_t layers = 0;
    };
    Known known = Known::Nothing;
    std::uint32_t most = 0;
    std::vector<Part> parts = {};
};

struct PairState {
    // What the volume was made from.
    std::shared_ptr<const ShadowMesh> mesh;
    std::shared_ptr<const Volume> volume;
    std::uint64_t volume_revision = 0;
    FarVertices far_vertices = FarVertices::AtInfinity;
    NearCaps near_caps = NearCaps::Facing;
    bool flattened = false;
    /// Of a strategy that keeps state; else null.
    std::unique_ptr<SilhouetteDetector> detector;
    LightLocal detected;  ///< the light that the facing was decided for
    double margin = 0.0;  ///< how far it may move from there
    /// Metres from the light to the nearest casting face; negative until asked for.
    double nearest_face = -1.0;
    Layers layers;  ///< for the light where it is now
    // What the pair looked like last.
    LightLocal current;
    glm::dvec4 current_exact{0.0};  ///< before rounding
    std::uint64_t pose_revision = 0;
    std::uint64_t light_revision = 0;
    std::uint64_t frame = 0;
};

/// What detection reuses from pair to pair.
struct Scratch {
    std::unique_ptr<SilhouetteDetector> detector;  ///< of a strategy that keeps no state
    Facing facing;                                 ///< of singular poses
    Detection flattened;
    std::vector<FaceRun> runs;
    std::vector<std::int8_t> weights;
};

/// Unique in the process, never 0.
[[nodiscard]] std::uint64_t next_volume_revision();

/// Brings the pair up to date and says why. Adds to the stats.
Reason update_pair(PairState& pair, const CasterState& caster, const LightState& light,
                   FarVertices far_vertices, const SilhouetteStrategy& strategy, Scratch& scratch,
                   FrameStats& stats);

/// Distance from a point to the nearest of the faces that the volume's caps are made of, in world
/// metres.
double nearest_face(const Volume& volume, const ShadowMesh& mesh,
                    const glm::dmat4& world_from_local, const glm::dvec3& point_world);

}  // namespace gnomon::shadows::internal
