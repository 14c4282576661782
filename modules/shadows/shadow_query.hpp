// SPDX-License-Identifier: MIT
//
// ShadowQueries: what a player sees is what the game knows. Is this point in the shadow of that
// light, what lies between, where does a path cross a shadow's edge, how much of a body is in
// shadow? It is told the same casters and lights as the ShadowSystem and decides by the same
// facing, about the same rounded light, in the same space of each caster.
//
//     ShadowQueries queries;
//     queries.update(casters);  // once a frame
//     if (queries.at(sun, lifted(feet, ground_normal, sun)) == Exposure::Shadowed) hide();
//
// A point is in shadow when a casting face lies strictly between it and the light, whichever way
// the face is wound. Volumes that count one side of a closed solid agree: outside of it a line to
// the light leaves it as often as it enters. (Only within a pocket of a solid that its own faces
// turn inside out does such a volume count nothing; a face that is seen there is averted.)
//
// A face does not shadow the points of its own plane, nor does one whose plane contains the light
// cast. All of that is exact in the caster's space; bringing the point there rounds as double
// precision does. See docs/numerics.md, "Shadow queries".
//
// What it is not: it knows neither cones of spot lights nor alpha tests, and no soft edges.
//
// Threads: any number may ask at a time; update() excludes them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/shadows/technique.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// What a light does to a point. OutOfRange: it is farther than the light's range from a point
/// light; neither lit nor in shadow.
enum class Exposure : std::uint8_t {
    Lit,         ///< nothing lies between point and light
    Shadowed,    ///< something does
    OutOfRange,  ///< the point is beyond the light's range
};

/// What a question leaves out.
struct QueryOptions {
    /// Keys of casters that are looked through: those of the character that carries the light
    /// meter. Looked up one by one.
    std::span<const std::uint64_t> ignored_casters = {};
};

/// A part of a segment, by parameters from 0 (its begin) to 1, over which nothing changes.
struct SegmentPiece {
    double begin = 0.0;                 ///< 0 .. 1
    double end = 1.0;                   ///< 0 .. 1
    Exposure exposure = Exposure::Lit;  ///< of all of it
};

/// A body that is asked about.
struct Sphere {
    glm::dvec3 center_world{0.0};  ///< metres
    double radius_m = 1.0;         ///< metres, > 0
};

/// Shares of a volume, by one point in each of `samples` cells of equal volume that fill it.
struct VolumeShare {
    double shadowed = 0.0;      ///< 0 .. 1
    double out_of_range = 0.0;  ///< the rest is lit
    /// The share of cells that have a neighbour with another answer, about those that a shadow's
    /// edge passes: an estimate of how far `shadowed` may be off, without a proof.
    double uncertain = 0.0;
    std::uint32_t samples = 0;  ///< how many points were asked about
};

/// What update() did to the tree of casters.
enum class TreeUpdate : std::uint8_t {
    Unchanged,  ///< nothing moved; cost: the comparison
    Refitted,   ///< casters moved; cost: linear in the casters
    Rebuilt,    ///< casters came or went, or had moved so far apart that searching took longer
};

/// Answers questions about shadows on the CPU, by the same facing as the volumes. Asking is const:
/// many threads may ask at a time, none while update() runs.
class ShadowQueries {
public:
    /// Without casters: all is lit.
    ShadowQueries();
    ShadowQueries(ShadowQueries&&) noexcept;
    ShadowQueries& operator=(ShadowQueries&&) noexcept;
    ~ShadowQueries();

    /// The casters as they are submitted to the ShadowSystem. Full: those that are not among them
    /// are gone. Delta: they are as they were, but for the keys in `removed`. A key given twice:
    /// the last one counts. A pose that is not finite casts nothing. Cost: a look-up and a compare
    /// a caster; a mesh that was never asked about before is sorted into a tree of its own, once in
    /// its life.
    TreeUpdate update(std::span<const Caster> casters, Submission submission = Submission::Full,
                      std::span<const std::uint64_t> removed = {});

    /// The point, in world metres, must be finite. A light that is not finite, which the
    /// ShadowSystem leaves out, shadows nothing. Cost: a descent in the tree of casters, and one in
    /// the tree of faces of each caster whose bounds are on the way; allocates nothing.
    [[nodiscard]] Exposure at(const Light& light, const glm::dvec3& point_world,
                              const QueryOptions& options = {}) const;

    /// The same for many points; `exposures` is as long as `points_world`. Neighbours in the list
    /// that are near each other in space cost less.
    void at(const Light& light, std::span<const glm::dvec3> points_world,
            std::span<Exposure> exposures, const QueryOptions& options = {}) const;

    /// How many surfaces lie strictly between point and light, whatever the light's range. A closed
    /// solid has two or more for a point behind it; its stencil count is then half of that.
    [[nodiscard]] std::uint32_t surfaces_between(const Light& light, const glm::dvec3& point_world,
                                                 const QueryOptions& options = {}) const;

    /// The pieces of a segment, in order, from 0 to 1; neighbours differ. Replaces `pieces`. Each
    /// says what at() says about its middle. Parameters are rounded: by some 1e-15, divided by the
    /// sine of the angle between segment and light; so is what is missed, a sliver or a gap of that
    /// size. A segment of no length has one piece. Cost: that of at() for each piece, plus the
    /// faces that the fan from segment to light meets.
    void along(const Light& light, const glm::dvec3& from_world, const glm::dvec3& to_world,
               std::vector<SegmentPiece>& pieces, const QueryOptions& options = {}) const;

    /// How much of a sphere, or of a box with a pose, is in shadow: the share of cells_per_side^3
    /// points (1 to 256 a side), one in each cell of equal volume, placed within it by a fixed
    /// hash. It is off by no more than the share of cells that a shadow's edge passes; a plane edge
    /// passes less than 3 / cells_per_side of a box's, and the points even out most of that
    /// (docs/numerics.md). A body that casts is in its own shadow unless its key is ignored. Cost:
    /// that of at() for each point.
    [[nodiscard]] VolumeShare share_of(const Light& light, const Sphere& sphere,
                                       std::uint32_t cells_per_side = 8,
                                       const QueryOptions& options = {}) const;
    /// The same of a box with a pose.
    [[nodiscard]] VolumeShare share_of(const Light& light, const OrientedBounds& box,
                                       std::uint32_t cells_per_side = 8,
                                       const QueryOptions& options = {}) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A point of a surface, moved off it along the normal (of any length, of either side) by `lift_m`,
/// to the side where the light is. For receivers that cast themselves: coordinates of a point on
/// the ground are rounded, some of them to below the ground. The lift must exceed that rounding,
/// and hides casters that are nearer to the surface than it.
[[nodiscard]] glm::dvec3 lifted(const glm::dvec3& point_world, const glm::dvec3& normal_world,
                                const Light& light, double lift_m = 1e-4);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
