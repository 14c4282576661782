// SPDX-License-Identifier: MIT
#include <gnomon/shadows/host_view.hpp>

#include <cmath>
#include <string>

namespace gnomon::shadows {

namespace {

bool all_finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            if (!std::isfinite(m[c][r])) return false;
        }
    }
    return true;
}

// Matrices of hosts are single precision, mostly, and inverses of other matrices: these may end in
// 1 but for a rounding.
bool is_rigid(const glm::dmat4& m) {
    constexpr double slack = 1e-3;
    constexpr double rounding = 1e-6;
    if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0) return false;
    if (std::abs(m[3][3] - 1.0) > rounding) return false;
    for (int a = 0; a < 3; ++a) {
        for (int b = a; b < 3; ++b) {
            const double product = glm::dot(glm::dvec3(m[a]), glm::dvec3(m[b]));
            if (std::abs(product - (a == b ? 1.0 : 0.0)) > slack) return false;
        }
    }
    return true;
}

Status refuse(const std::string& sentence) { return fail(ErrorCode::Unsupported, sentence); }

// Which of the two kinds of projection it is, and that it is one.
Status check_projection(const glm::dmat4& clip) {
    const bool perspective = clip[2][3] != 0.0;
    const bool plain_w = clip[0][3] == 0.0 && clip[1][3] == 0.0 &&
                         (perspective ? clip[3][3] == 0.0 : clip[3][3] > 0.0);
    if (!plain_w) {
        return refuse("clip_from_view has a w of " + std::to_string(clip[0][3]) + " x + " +
                      std::to_string(clip[1][3]) + " y + " + std::to_string(clip[2][3]) + " z + " +
                      std::to_string(clip[3][3]) +
                      ", which is neither a perspective's, a multiple of z, nor an orthographic "
                      "projection's, a positive number: give the camera's pose as view_from_world "
                      "and the projection alone as clip_from_view.");
    }
    if (clip[0][2] != 0.0 || clip[1][2] != 0.0) {
        return refuse("clip_from_view has a depth of " + std::to_string(clip[0][2]) + " x + " +
                      std::to_string(clip[1][2]) +
                      " y + …, an oblique near plane, behind which no far plane is known: clip by "
                      "a clip distance instead and give the projection without it.");
    }
    if (clip[0][0] * clip[1][1] - clip[1][0] * clip[0][1] == 0.0) {
        return fail(ErrorCode::InvalidInput,
                    "clip_from_view maps all of x and y to a line: it is no projection.");
    }
    return {};
}

// The row of depth in gnomon's own direction and range: 1 at the near plane, 0 far away.
glm::dmat4 with_reversed_depth(glm::dmat4 clip, const HostConventions& conventions) {
    for (int c = 0; c < 4; ++c) {
        const double z = conventions.reversed ? clip[c][2] : -clip[c][2];
        const double w = clip[c][3];
        if (conventions.depth == HostDepth::MinusOneToOne) {
            clip[c][2] = 0.5 * (w + z);
        } else {
            clip[c][2] = conventions.reversed ? z : w + z;
        }
    }
    return clip;
}

void negate_y(glm::dmat4& clip) {
    for (int c = 0; c < 4; ++c) clip[c][1] = -clip[c][1];
}

const char* direction_of(bool reversed) {
    return reversed ? "reversed (the greater is nearer)" : "forward (the lesser is nearer)";
}

}  // namespace

Result<HostView> view_of_host(const glm::dmat4& view_from_world, const glm::dmat4& clip_from_view,
                              const HostConventions& conventions) {
    if (conventions.depth == HostDepth::Logarithmic) {
        return forward_error(refuse(
            "Shadow volumes cannot be counted in logarithmic depth, since theirs is linear across "
            "a triangle on the screen and logarithmic depth is not: draw with reversed depth into "
            "32-bit floats instead, which reaches as far."));
    }
    if (!all_finite(view_from_world) || !all_finite(clip_from_view)) {
        return fail(ErrorCode::InvalidInput,
                    "A matrix of the host's camera has an entry that is not finite.");
    }
    if (!is_rigid(view_from_world)) {
        return forward_error(
            refuse("view_from_world is more than a rotation and a translation: put scales into the "
                   "poses of what is drawn, or into clip_from_view."));
    }
    if (const Status checked = check_projection(clip_from_view); !checked) {
        return forward_error(checked);
    }
    glm::dmat4 view = view_from_world;
    glm::dmat4 clip = clip_from_view;
    const bool perspective = clip[2][3] != 0.0;
    // A view of ours looks along -Z: where the host's looks along +Z, two signs change.
    const double growth = with_reversed_depth(clip, conventions)[2][2];
    if (perspective ? clip[2][3] > 0.0 : growth < 0.0) {
        for (int c = 0; c < 4; ++c) view[c][2] = -view[c][2];
        clip[2] = -clip[2];
    }
    glm::dmat4 ours = with_reversed_depth(clip, conventions);
    ProjectionKind kind = ProjectionKind::Orthographic;
    if (perspective) {
        // Depth is (a d + b) / (s d) at the distance d.
        const double a = -ours[2][2];
        const double b = ours[3][2];
        const double s = -ours[2][3];
        if (b < 0.0) {
            return forward_error(refuse(
                std::string("The depth of clip_from_view is ") +
                direction_of(!conventions.reversed) + ", but the conventions say that it is " +
                direction_of(conventions.reversed) + ": set HostConventions::reversed to " +
                (conventions.reversed ? "false" : "true") + ", or exchange near and far."));
        }
        if (!(b > 0.0) || !(s - a > 0.0)) {
            return fail(ErrorCode::InvalidInput,
                        "clip_from_view has no near plane before the eye: its distance would be " +
                            std::to_string(b / (s - a)) +
                            " m. Is HostConventions::depth what the clip space is?");
        }
        kind = a < 0.0 ? ProjectionKind::FinitePerspective : ProjectionKind::InfinitePerspective;
    } else if (ours[2][2] == 0.0) {
        return fail(ErrorCode::InvalidInput,
                    "clip_from_view gives one depth to everything: it is no projection.");
    }
    if (conventions.rows == HostRows::FromMinusOne) {
        negate_y(ours);
        negate_y(clip);
    }
    // Drawn with is what the host has, to the bit.
    HostView host{
        .view = {view, ours, kind}, .as_drawn = {view, clip, kind}, .conventions = conventions};
    host.view.view_from_world[3][3] = 1.0;
    return host;
}

}  // namespace gnomon::shadows
