// SPDX-License-Identifier: MIT
//
// Hosts' matrices become views: whatever the conventions, what lies at the near and far plane is
// found there, drawing stays the host's to the bit, and what cannot work is refused.
#include <gmock/gmock.h>

#include <gnomon/shadows/host_view.hpp>

namespace gnomon::shadows {
namespace {

using testing::HasSubstr;

const glm::dmat4 view_matrix = look_at({1, 2, 5}, {0, 0.5, 0}, {0, 1, 0});

/// A host's projection, from ours.
glm::dmat4 in_the_hosts_way(glm::dmat4 clip, const HostConventions& conventions) {
    for (int c = 0; c < 4; ++c) {
        if (!conventions.reversed) clip[c][2] = clip[c][3] - clip[c][2];
        if (conventions.depth == HostDepth::MinusOneToOne) {
            clip[c][2] = 2.0 * clip[c][2] - clip[c][3];
        }
    }
    return clip;
}

void expect_near(const glm::dmat4& a, const glm::dmat4& b) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) EXPECT_NEAR(a[c][r], b[c][r], 1e-12) << c << ", " << r;
    }
}

glm::dmat4 y_negated(glm::dmat4 clip) {
    for (int c = 0; c < 4; ++c) clip[c][1] = -clip[c][1];
    return clip;
}

TEST(HostView, every_convention_comes_to_the_same_view) {
    const struct {
        glm::dmat4 clip;
        ProjectionKind kind;
    } cases[] = {{infinite_perspective(0.8, 1.5, 0.1), ProjectionKind::InfinitePerspective},
                 {infinite_frustum(-0.1, 0.3, -0.2, 0.1, 0.1), ProjectionKind::InfinitePerspective},
                 {finite_perspective(0.8, 1.5, 0.1, 50.0), ProjectionKind::FinitePerspective},
                 {orthographic(3.0, 2.0, -1.0, 20.0), ProjectionKind::Orthographic}};
    for (const auto& [clip, kind] : cases) {
        for (const HostDepth depth : {HostDepth::MinusOneToOne, HostDepth::ZeroToOne}) {
            for (const bool reversed : {false, true}) {
                for (const bool along_plus_z : {false, true}) {
                    const HostConventions conventions{depth, reversed};
                    glm::dmat4 host_view = view_matrix;
                    glm::dmat4 host_clip = in_the_hosts_way(clip, conventions);
                    if (along_plus_z) {
                        for (int c = 0; c < 4; ++c) host_view[c][2] = -host_view[c][2];
                        host_clip[2] = -host_clip[2];
                    }
                    const auto got = view_of_host(host_view, host_clip, conventions);
                    ASSERT_TRUE(got) << got.error().message;
                    EXPECT_EQ(got->view.projection, kind);
                    EXPECT_EQ(got->as_drawn.projection, kind);
                    expect_near(got->view.view_from_world, view_matrix);
                    expect_near(got->view.clip_from_view, y_negated(clip));
                    EXPECT_TRUE(is_mirrored(got->as_drawn));
                    // To the bit, but for the sign of y, which vertex stages give back.
                    EXPECT_EQ(y_negated(got->as_drawn.clip_from_world()), host_clip * host_view);
                }
            }
        }
    }
}

TEST(HostView, rows_from_one_leave_y_alone) {
    const glm::dmat4 clip = infinite_perspective(0.8, 1.5, 0.1);
    for (const bool reversed : {false, true}) {
        const HostConventions conventions{HostDepth::ZeroToOne, reversed, HostRows::FromOne};
        const glm::dmat4 host_clip = in_the_hosts_way(clip, conventions);
        const auto got = view_of_host(view_matrix, host_clip, conventions);
        ASSERT_TRUE(got) << got.error().message;
        expect_near(got->view.clip_from_view, clip);
        EXPECT_FALSE(is_mirrored(got->as_drawn));
        EXPECT_EQ(got->as_drawn.clip_from_world(), host_clip * view_matrix);
    }
}

TEST(HostView, what_points_down_is_not_mirrored_when_it_is_drawn) {
    const HostConventions conventions{HostDepth::ZeroToOne, true};
    const auto got =
        view_of_host(view_matrix, y_negated(infinite_perspective(0.8, 1.5, 0.1)), conventions);
    ASSERT_TRUE(got);
    EXPECT_FALSE(is_mirrored(got->as_drawn));
    EXPECT_FALSE(is_mirrored(got->view));
}

TEST(HostView, an_inverse_that_ends_in_all_but_1_is_a_rotation_all_the_same) {
    const HostConventions conventions{HostDepth::ZeroToOne, true};
    const glm::dmat4 clip = infinite_perspective(0.8, 1.5, 0.1);
    for (const double last : {1.0 - 0x1p-53, 1.0 + 0x1p-52, 1.0 - 0x1p-24, 1.0 + 0x1p-23}) {
        glm::dmat4 inverse = view_matrix;
        inverse[3][3] = last;
        const auto got = view_of_host(inverse, clip, conventions);
        ASSERT_TRUE(got) << got.error().message;
        EXPECT_EQ(got->view.view_from_world[3][3], 1.0);
        EXPECT_EQ(got->as_drawn.view_from_world[3][3], last) << "it is drawn as the host draws";
    }
    glm::dmat4 scaled = view_matrix;
    scaled[3][3] = 1.001;
    EXPECT_FALSE(view_of_host(scaled, clip, conventions));
}

TEST(HostView, an_epsilon_before_the_far_plane_is_no_far_plane) {
    const HostConventions conventions{HostDepth::MinusOneToOne, false};
    glm::dmat4 clip = in_the_hosts_way(infinite_perspective(0.8, 1.5, 0.1), conventions);
    for (const double epsilon : {0.0, 2.4e-7}) {
        clip[2][2] = epsilon - 1.0;
        const auto got = view_of_host(view_matrix, clip, conventions);
        ASSERT_TRUE(got) << got.error().message;
        EXPECT_EQ(got->view.projection, ProjectionKind::InfinitePerspective) << epsilon;
    }
    clip[2][2] = -1.0 - 1e-7;
    EXPECT_EQ(view_of_host(view_matrix, clip, conventions)->view.projection,
              ProjectionKind::FinitePerspective);
}

TEST(HostView, what_cannot_work_is_refused) {
    const HostConventions conventions{HostDepth::ZeroToOne, true};
    const glm::dmat4 clip = infinite_perspective(0.8, 1.5, 0.1);
    const auto refusal = [](const glm::dmat4& view, const glm::dmat4& projection,
                            const HostConventions& of_host) {
        const auto got = view_of_host(view, projection, of_host);
        return got ? std::string("taken") : got.error().message;
    };
    EXPECT_EQ(refusal(view_matrix, clip, conventions), "taken");
    EXPECT_THAT(refusal(view_matrix, clip, {HostDepth::Logarithmic, false}),
                HasSubstr("draw with reversed depth into 32-bit floats instead"));
    EXPECT_THAT(refusal(view_matrix, clip, {HostDepth::ZeroToOne, false}),
                HasSubstr("set HostConventions::reversed to true"));
    EXPECT_THAT(refusal(2.0 * view_matrix, clip, conventions), HasSubstr("put scales into"));
    glm::dmat4 oblique = clip;
    oblique[0][2] = 0.3;
    EXPECT_THAT(refusal(view_matrix, oblique, conventions), HasSubstr("clip distance"));
    EXPECT_THAT(refusal(glm::dmat4(1.0), clip * view_matrix, conventions),
                HasSubstr("give the camera's pose as view_from_world"));
    glm::dmat4 broken = clip;
    broken[1][1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refusal(view_matrix, broken, conventions), HasSubstr("not finite"));
    glm::dmat4 flat = clip;
    flat[1][1] = 0.0;
    EXPECT_THAT(refusal(view_matrix, flat, conventions), HasSubstr("no projection"));
    glm::dmat4 nothing_near = clip;
    nothing_near[3][2] = 0.0;
    EXPECT_THAT(refusal(view_matrix, nothing_near, conventions), HasSubstr("no near plane"));
}

}  // namespace
}  // namespace gnomon::shadows
