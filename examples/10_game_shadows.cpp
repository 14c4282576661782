// SPDX-License-Identifier: MIT
//
// A game's shadows: somebody walks past a wall under a lamp. In each tick the shadow queries say
// how much of them is lit; in each frame the same casters become volumes and a picture. Rules and
// picture share one scene and one adapter, so what is seen is what the game knows. The last frame
// goes to game_shadows.ppm. gnomon-game is this with levels, guards and a window.
#include <array>
#include <cstdio>
#include <fstream>

#include <gnomon/gl/backend.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>
#include <gnomon/shadows/shadow_query.hpp>

using namespace gnomon;

scene::Entity add(scene::Scene& scene, const char* name, scene::Mesh mesh, const glm::dvec3& at) {
    const scene::Entity node = scene.create_node(name, {.translation = at});
    scene.registry.emplace<scene::MeshInstance>(
        node, std::make_shared<const scene::Mesh>(std::move(mesh)));
    scene.registry.emplace<scene::Caster>(node);
    scene.registry.emplace<scene::Receiver>(node);
    return node;
}

Status game() {
    // The level: ground, a wall, a lamp behind it, and the player, who comes from the left.
    scene::Scene scene;
    scene.materials.emplace_back().base_color = {0.45F, 0.42F, 0.38F, 1.0F};
    add(scene, "ground", scene::make_plane(24.0F, 24.0F), {0.0, 0.0, 0.0});
    add(scene, "wall", scene::make_box({3.0F, 2.4F, 0.3F}), {0.0, 1.2, -1.0});
    const glm::dvec3 start(-5.0, 0.9, 1.5);
    const auto player = add(scene, "player", scene::make_box({0.5F, 1.8F, 0.3F}), start);
    const auto lamp = scene.create_node("lamp", {.translation = {0.0, 3.0, -4.0}});
    scene.registry.emplace<scene::PointLight>(lamp, glm::vec3(1.0F, 0.8F, 0.5F), 60.0F);

    // What draws, and what knows.
    auto context = gl::create_headless_context();
    if (!context) return forward_error(context);
    auto backend = gl::create_backend(std::move(*context));
    if (!backend) return forward_error(backend);
    gpu::Device device(std::move(*backend));
    auto renderer =
        render::Renderer::create(device, {.width = 640, .height = 360, .sample_count = 4});
    if (!renderer) return forward_error(renderer);
    if (const Status uploaded = renderer->upload(scene); !uploaded) return uploaded;
    auto system = shadows::ShadowSystem::create({.receivers = shadows::Receivers::Submitted});
    if (!system) return forward_error(system);
    scene::ShadowAdapter adapter;
    shadows::ShadowQueries queries;

    constexpr int ticks_a_second = 60;
    for (int tick = 0; tick <= 5 * ticks_a_second; ++tick) {
        // A tick: the player walks, two metres a second, and the meter is read. Nobody hides in
        // their own shadow.
        const glm::dvec3 at = start + glm::dvec3(2.0 * tick / ticks_a_second, 0.0, 0.0);
        scene.registry.get<scene::LocalTransform>(player).translation = at;
        scene::update_world_transforms(scene.registry);
        const auto casters = adapter.casters(scene);
        if (!casters) return forward_error(casters);
        queries.update(*casters);
        const auto light = scene::shadow_light(scene.registry, lamp);
        if (!light) return fail(ErrorCode::InvalidInput, "The lamp is gone.");
        const std::array own{player.key()};
        const double share =
            queries.share_of(*light, shadows::Sphere{at, 0.8}, 6, {.ignored_casters = own})
                .shadowed;
        if (tick % ticks_a_second != 0) continue;

        // A frame: the camera follows; only what moved is found anew.
        const shadows::View view{
            shadows::look_at(at + glm::dvec3(0.0, 5.0, 7.0), at, {0.0, 1.0, 0.0}),
            shadows::infinite_perspective(0.8, 640.0 / 360.0, 0.1)};
        auto frame = system->begin_frame();
        if (const Status done = adapter.submit(scene, frame); !done) return done;
        const shadows::DrawList& volumes = std::move(frame).finish(view);
        if (const Status drawn = renderer->render({scene, view, volumes}); !drawn) return drawn;
        std::printf("after %d s: %s (%.0f %% in shadow), %ju silhouettes found anew\n",
                    tick / ticks_a_second, share > 0.7 ? "hidden" : "seen", 100.0 * share,
                    static_cast<std::uintmax_t>(volumes.stats.pairs_redetected));
    }
    const auto picture = device.read_texture(renderer->picture());
    if (!picture) return forward_error(picture);
    std::ofstream file("game_shadows.ppm", std::ios::binary);
    file << "P6 640 360 255\n";
    for (std::size_t i = 0; i < picture->size(); i += 4)
        file.write(reinterpret_cast<const char*>(&(*picture)[i]), 3);
    return file ? Status{} : fail(ErrorCode::Io, "game_shadows.ppm could not be written.");
}

int main() {
    const Status status = game();
    if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
    return status ? 0 : 1;
}
