// SPDX-License-Identifier: MIT
#include "tests/hard_cases/known_limits.hpp"

#include <algorithm>
#include <array>

namespace gnomon::test {

namespace {

// Mesa 22.3 draws a sliver that clipping and snapping leave almost without area by neither pass of
// the two-pass path (docs/backends.md).
constexpr std::string_view two_pass = "gl_osmesa_two_pass";
constexpr std::string_view lost_sliver = "a sliver is lost";

// SwiftShader has four sub-pixel bits, where Mesa has eight (docs/hard-cases.md). None of these is
// wrong on any of Mesa's rasterisers.
constexpr std::string_view swiftshader = "SwiftShader";
constexpr std::string_view near_side =
    "a side that the eye almost touches, seen edge-on; right by depth-fail";
constexpr std::string_view far_edge = "the ground's far edge, seen edge-on by depth-pass";
constexpr std::string_view samples = "samples 1 and 2 of four disagree with the standard places";
constexpr std::string_view not_traced = "edges and grazing faces; not explained one by one";

constexpr std::array limits{
    KnownLimit{"29_four_samples_wall_of_bricks", two_pass, 1, lost_sliver},

    KnownLimit{"01_light_in_the_plane_of_1000_needles", swiftshader, 60, not_traced},
    KnownLimit{"04_1000_closed_faces_on_one_edge", swiftshader, 5, not_traced},
    KnownLimit{"05_repeated_faces", swiftshader, 20, not_traced},
    KnownLimit{"07_sweep_through_a_side_fov_50", swiftshader, 12000, near_side},
    KnownLimit{"07_sweep_through_a_side_fov_120", swiftshader, 12000, near_side},
    KnownLimit{"07_sweep_through_a_side_fov_170", swiftshader, 12000, near_side},
    KnownLimit{"07_sweep_through_a_side_far_plane", swiftshader, 12000, near_side},
    KnownLimit{"09_caster_close_to_the_lamp_d32f_s8", swiftshader, 5, not_traced},
    KnownLimit{"09_caster_far_away_d32f_s8", swiftshader, 2000, not_traced},
    KnownLimit{"09_caster_far_from_a_large_view_d32f_s8", swiftshader, 600, not_traced},
    KnownLimit{"09_caster_far_from_a_small_view", swiftshader, 25000, not_traced},
    KnownLimit{"10_eye_in_the_shadow_of_a_knot", swiftshader, 15,
               "edges of volumes clipped near the eye move by more than 1/8 pixel"},
    KnownLimit{"10_far_vertices_in_the_eye_plane", swiftshader, 12000,
               "triangles with a corner at clip w = 0; a camera turned by 1e-3 is right"},
    KnownLimit{"16_lamp_on_a_cube", swiftshader, 1300, not_traced},
    KnownLimit{"18_more_vertices_than_16_bits_number", swiftshader, 5, not_traced},
    KnownLimit{"23_moved_by_", swiftshader, 12, far_edge},
    KnownLimit{"25_shears", swiftshader, 10, not_traced},
    KnownLimit{"25_one_axis_scaled_by_", swiftshader, 3, not_traced},
    KnownLimit{"27_caster_far_larger_than_view_and_range", swiftshader, 2000, not_traced},
    KnownLimit{"29_four_samples_", swiftshader, 450, samples},
    KnownLimit{"30_caps_in_and_out_of_view", swiftshader, 5, not_traced},
    KnownLimit{"34_wall_of_1000_bricks", swiftshader, 120, not_traced},

    // Last, so that what is said of one device alone is found first.
    KnownLimit{"04_1000_closed_faces_on_one_edge", "llvmpipe", 1,
               "more than 255 layers, so the volume is cut along the edge: a pixel on it is dark"},
    KnownLimit{"09_caster_far_from_a_small_view", "every device", 500,
               "a caster 1,000 km away is placed to 6 cm in single precision: three pixels here"},
};

}  // namespace

const KnownLimit* known_limit(std::string_view hard_case, std::string_view device,
                              std::string_view rasteriser) {
    const auto* found = std::find_if(limits.begin(), limits.end(), [&](const KnownLimit& limit) {
        return hard_case.starts_with(limit.hard_case) &&
               (limit.device == device || limit.device == rasteriser ||
                limit.device == "every device");
    });
    return found == limits.end() ? nullptr : found;
}

}  // namespace gnomon::test
