// SPDX-License-Identifier: MIT
//
// Bring your own entities: a host with a plain array of ships, poses and 64-bit ids, and no gnomon
// scene. The host submits everything every frame; the shadow system finds out what changed, and
// says so. What it returns is a list of index ranges to draw: with gnomon::shadow_pass, or with the
// host's own renderer.
#include <array>
#include <cstdio>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/shadows/shadow_system.hpp>

namespace {

using namespace gnomon;

struct Ship {
    std::uint64_t id = 0;
    std::shared_ptr<const shadows::ShadowMesh> hull;
    glm::dmat4 pose{1.0};
};

Result<std::shared_ptr<const shadows::ShadowMesh>> make_hull() {
    const std::array<glm::vec3, 5> corners{
        {{0, 0, -2}, {1, 0, 1}, {-1, 0, 1}, {0, 0.6F, 0.8F}, {0, -0.4F, 0.8F}}};
    const std::array<std::uint32_t, 18> indices{0, 3, 1, 0, 2, 3, 0, 1, 4,
                                                0, 4, 2, 1, 3, 4, 2, 4, 3};
    return shadows::ShadowMesh::build(
        {.positions = reinterpret_cast<const std::byte*>(corners.data()),
         .vertex_count = corners.size(),
         .indices = indices});
}

const shadows::DrawList& submit(shadows::ShadowSystem& system, const std::vector<Ship>& ships,
                                const glm::dvec4& sun, const shadows::View& view) {
    auto frame = system.begin_frame();
    for (const Ship& ship : ships)
        frame.caster({.key = ship.id, .mesh = ship.hull, .world_from_local = ship.pose});
    frame.light({.key = 1, .position_world = sun});
    return std::move(frame).finish(view);
}

void say(const char* what, const shadows::DrawList& list) {
    std::printf("%s: %zu volumes, %llu of %llu silhouettes found anew, because:", what,
                list.draws.size(), static_cast<unsigned long long>(list.stats.pairs_redetected),
                static_cast<unsigned long long>(list.stats.pairs));
    for (const shadows::VolumeDraw& draw : list.draws) {
        const std::string_view reason = to_string(draw.reason);
        std::printf(" %.*s", static_cast<int>(reason.size()), reason.data());
    }
    std::printf("\n");
}

}  // namespace

int main() {
    const auto hull = make_hull();
    auto system = shadows::ShadowSystem::create();
    if (!hull || !system) {
        std::fprintf(stderr, "%s\n", (hull ? system.error() : hull.error()).message.c_str());
        return 1;
    }
    std::vector<Ship> ships;
    for (std::uint64_t i = 0; i < 3; ++i) {
        const glm::dvec3 place(4.0 * static_cast<double>(i), 2.0, 0.0);
        ships.push_back({100 + i, *hull, glm::translate(glm::dmat4(1.0), place)});
    }
    const glm::dvec4 sun(0.4, 1.0, 0.3, 0.0);  // w = 0: the direction towards it
    const auto seen_from = [](double x) {
        return shadows::View{shadows::look_at({x, 6.0, 14.0}, {4.0, 1.0, 0.0}, {0.0, 1.0, 0.0}),
                             shadows::infinite_perspective(0.8, 16.0 / 9.0, 0.1)};
    };

    say("first frame", submit(*system, ships, sun, seen_from(0.0)));
    say("the camera moves", submit(*system, ships, sun, seen_from(5.0)));
    ships[1].pose = glm::translate(ships[1].pose, glm::dvec3(0.0, 0.0, -3.0));
    say("a ship flies on", submit(*system, ships, sun, seen_from(5.0)));
    ships[2].pose = glm::rotate(ships[2].pose, 0.9, glm::dvec3(0.0, 0.0, 1.0));
    say("a ship rolls", submit(*system, ships, sun, seen_from(5.0)));
    ships.pop_back();
    say("a ship is gone", submit(*system, ships, sun, seen_from(5.0)));
    return 0;
}
