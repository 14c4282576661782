// SPDX-License-Identifier: MIT
//
// Shadow queries: a game asks what its player sees. What is under the roof, where does the way out
// leave its shadow, and what does a light meter say that must not count its own bearer? No device
// is needed: the answers are those of the rendered masks.
#include <array>
#include <cstdio>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/shadows/shadow_query.hpp>

namespace {

using namespace gnomon;

Result<std::shared_ptr<const shadows::ShadowMesh>> make_box() {
    std::array<glm::vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
        corners[i] = {(i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1, (i & 4U) != 0 ? 1 : -1};
    }
    const std::array<std::uint32_t, 36> indices{0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5,
                                                0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
                                                0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    return shadows::ShadowMesh::build(
        {.positions = reinterpret_cast<const std::byte*>(corners.data()),
         .vertex_count = corners.size(),
         .indices = indices});
}

/// A box of these half sizes.
glm::dmat4 box_at(const glm::dvec3& middle, const glm::dvec3& half) {
    return glm::scale(glm::translate(glm::dmat4(1.0), middle), half);
}

const char* name_of(shadows::Exposure exposure) {
    switch (exposure) {
        case shadows::Exposure::Lit: return "lit";
        case shadows::Exposure::Shadowed: return "in shadow";
        case shadows::Exposure::OutOfRange: return "out of range";
    }
    return "";
}

}  // namespace

int main() {
    const auto box = make_box();
    if (!box) {
        std::fprintf(stderr, "%s\n", box.error().message.c_str());
        return 1;
    }
    constexpr std::uint64_t ground = 1;
    constexpr std::uint64_t roof = 2;
    constexpr std::uint64_t guard = 3;
    const std::vector<shadows::Caster> casters{
        {ground, *box, box_at({0.0, -1.0, 0.0}, {50.0, 1.0, 50.0})},
        {roof, *box, box_at({0.0, 4.0, 0.0}, {3.0, 0.1, 3.0})},
        {guard, *box, box_at({5.0, 0.9, 0.0}, {0.3, 0.9, 0.2})}};
    const shadows::Light sun{.key = 9, .position_world = {0.0, 1.0, 0.0, 0.0}};

    shadows::ShadowQueries queries;
    queries.update(casters);  // once a frame, with the casters that the shadow system gets

    // Points on the ground are lifted off it, for the ground casts as well.
    const glm::dvec3 up(0.0, 1.0, 0.0);
    const auto say = [&](const char* what, const glm::dvec3& place) {
        const glm::dvec3 feet = shadows::lifted(place, up, sun);
        std::printf("%s: %s, %u surfaces in the way\n", what, name_of(queries.at(sun, feet)),
                    queries.surfaces_between(sun, feet));
    };
    say("under the roof", {1.0, 0.0, 1.0});
    say("in the yard", {5.0, 0.0, 1.0});

    // The way out, at head height.
    std::vector<shadows::SegmentPiece> pieces;
    queries.along(sun, {-3.0, 1.7, 1.0}, {7.0, 1.7, 1.0}, pieces);
    for (const shadows::SegmentPiece& piece : pieces) {
        std::printf("%s until %.2f m, ",
                    piece.exposure == shadows::Exposure::Shadowed ? "hidden" : "seen",
                    10.0 * piece.end);
    }
    std::printf("by then he is there\n");

    // The light meter of the guard in the yard, and what it would say under the roof: the upper
    // half of his body, which must not count as its own shadow.
    const std::array<std::uint64_t, 1> himself{guard};
    for (const double x : {0.0, 5.0}) {
        const shadows::VolumeShare share =
            queries.share_of(sun, shadows::Sphere{{x, 1.3, 0.0}, 0.4}, 8, {himself});
        std::printf("at %.0f m his body is in shadow: %.0f %% of %u points\n", x,
                    100.0 * share.shadowed, share.samples);
    }
    return 0;
}
