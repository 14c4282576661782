// SPDX-License-Identifier: MIT
//
// Reach: how far the shadow of a pair has to go, wherever it is looked at from. And what of the
// picture it can change, from one place.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/receiver.hpp>
#include <gnomon/shadows/screen_bounds.hpp>
#include <gnomon/shadows/technique.hpp>
#include <gnomon/shadows/view.hpp>

#include "receiver_tree.hpp"
#include "shadow_hull.hpp"

namespace gnomon::shadows::internal {

/// Where along a normal, between caster and plane, the shadow meets no receiver.
struct Gaps {
    static constexpr std::size_t most = 3;
    /// Behind the caster, ascending, the widest ones. Receivers may lie on either end.
    std::array<Interval, most> gaps{};
    std::size_t count = 0;
    /// What receives before, between and behind them, cut off where the shadow ends.
    std::array<Aabb, most + 1> boxes{};
    /// Nothing receives before the first one, the caster neither.
    bool first = false;
};

struct Reach {
    bool any = true;  ///< a receiver, or receivers are not known
    /// Far vertices go onto a plane, else to infinity: whatever receivers there are.
    bool clamped = false;
    /// No receiver at all lies beyond the plane.
    bool plane_is_last = false;
    /// The plane: dot(normal, p) = plane_distance(); the light and the caster lie below. Unit
    /// length.
    glm::dvec3 normal{0.0};
    double distance = 0.0;
    double first = 0.0;       ///< where the caster begins along the normal
    double least_room = 0.0;  ///< what receivers and caster are away from any plane at least
    /// Null where nothing is to be left out between caster and plane.
    std::shared_ptr<const Gaps> gaps;
    /// What receives, cut off where the shadow ends; all that the shadow covers where receivers may
    /// be anywhere.
    Aabb box = Aabb::nothing();
};

/// `receivers` is null where they may be anywhere. Exact on every receiver: whatever of the shadow
/// lies beyond the plane reaches none. A plane is taken only where every point of the caster's
/// bounds lies below it and well in front of the light along its normal, so that the projection
/// keeps the order of points and their sides of the light.
[[nodiscard]] Reach reach_of(const ShadowHull& hull, const ReceiverTree* receivers,
                             const FillOptions& options);

/// How far a plane must be from receivers at `distance` along the normal, for what single precision
/// may do there and at the eye's distance.
[[nodiscard]] double plane_room(const Reach& reach, double distance, const glm::dvec3& eye);
/// The plane as the view needs it, so far behind the last receiver.
[[nodiscard]] double plane_distance(const Reach& reach, const glm::dvec3& eye);

/// Takes points of a caster's space to the plane, from the light (a point, or a direction towards
/// it) in that space: homogeneous, w > 0 for all that lies in front of the light. `plane` in the
/// caster's space: dot(plane.xyz, p) + plane.w = 0. After J. Blinn, "Me and My (Fake) Shadow"
/// (1988).
[[nodiscard]] glm::dmat4 projection_onto(const glm::dvec4& plane, const glm::dvec4& light);

/// A plane of the world, in the space of a pose: dot(normal, world) = distance.
[[nodiscard]] glm::dvec4 plane_in(const glm::dmat4& world_from_local, const glm::dvec3& normal,
                                  double distance);

/// What of a picture is needed to tell where things are on it.
class Screen {
public:
    explicit Screen(const View& view);

    [[nodiscard]] const glm::dvec3& eye() const { return eye_; }
    /// Whether all that is seen is seen from below a plane: the near rectangle lies there.
    [[nodiscard]] bool begins_below(const glm::dvec3& normal, double distance) const;
    /// What a shadow can change: where it lies, and receivers do. `plane` as plane_distance() has
    /// it. Cost: some hundred flops, some thousand where the eye's plane cuts it.
    [[nodiscard]] ScreenBounds of(const ShadowHull& hull, const Reach& reach, double plane) const;
    /// Of a finite box.
    [[nodiscard]] ScreenBounds of(const Aabb& box) const;
    /// Of the hull of these points, relative to the eye, homogeneous, at most 32: where it is on
    /// the picture.
    [[nodiscard]] ScreenBounds of(std::span<const glm::dvec4> points) const;
    /// And how much of `within` it covers, where the whole picture is 4. Cost: some thousand flops.
    [[nodiscard]] double area_of(std::span<const glm::dvec4> points,
                                 const ScreenBounds& within) const;
    /// The stored depths of what a shadow can change, wherever on the picture: the same volume,
    /// the same receivers. Cost: some hundred flops.
    [[nodiscard]] DepthBounds depth_of(const ShadowHull& hull, const Reach& reach,
                                       double plane) const;

private:
    /// Calls visit(double x, double y, double w), in clip space, for points whose hull on the
    /// picture is that of what the near plane leaves of these points' hull. False where that cannot
    /// be told.
    template <class Visit>
    [[nodiscard]] bool for_each_seen(std::span<const glm::dvec4> points, Visit&& visit) const;
    [[nodiscard]] double stored_depth(double ahead) const;

    glm::dmat4 clip_from_world_;  // relative to the eye
    glm::dvec3 eye_{0.0};
    std::array<glm::dvec3, 4> near_{};
    double nearest_ = 0.0;  // w of what is on the near plane
    // Depth by metres ahead of the eye: clip coordinates z and w as z[0] + z[1] * metres.
    glm::dvec3 forward_{0.0};
    glm::dvec2 z_{0.0};
    glm::dvec2 w_{0.0};
    double across_ = 0.0;  // half the picture in metres, the larger way, where w is 1; 0: unusual
};

/// By what volumes are left out or cut, the same for all pairs of a frame.
struct FillTerms {
    FillOptions options = FillOptions::none();
    const ReceiverTree* receivers = nullptr;  ///< null: anywhere
    const Screen* screen = nullptr;           ///< null: seen from everywhere

    [[nodiscard]] Reach reach(const ShadowHull& hull) const {
        return reach_of(hull, receivers, options);
    }
};

enum class Hidden : std::uint8_t { No, OutOfView, ReachesNothing, InUmbra };
/// Whether a volume may be left out, and where it is cut to.
struct Shown {
    Hidden hidden = Hidden::No;
    ScreenBounds bounds;  ///< empty where hidden
};
[[nodiscard]] Shown shown_of(const FillTerms& terms, const ShadowHull& hull, const Reach& reach);

}  // namespace gnomon::shadows::internal
