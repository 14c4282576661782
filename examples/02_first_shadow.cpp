// SPDX-License-Identifier: MIT
//
// The first shadow: a torus over a ground, one lamp, no window. Writes first_shadow.ppm and says
// how many pixels the shadow volume covers. It uses gnomon's own scene and renderer;
// 03_bring_your_ecs.cpp does without them.
#include <algorithm>
#include <cstdio>
#include <fstream>

#include <gnomon/gl/backend.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>

using namespace gnomon;

/// A node that is drawn and casts.
void add(scene::Scene& scene, const char* name, scene::Mesh mesh, const glm::dvec3& position) {
    const scene::Entity node = scene.create_node(name, {.translation = position});
    scene.registry.emplace<scene::MeshInstance>(
        node, std::make_shared<const scene::Mesh>(std::move(mesh)));
    scene.registry.emplace<scene::Caster>(node);
    scene.registry.emplace<scene::Receiver>(node);
}

Status first_shadow() {
    // What there is: two meshes, a lamp and a camera.
    scene::Scene scene;
    scene.materials.emplace_back().base_color = {0.60F, 0.26F, 0.15F, 1.0F};
    add(scene, "ground", scene::make_plane(20.0F, 20.0F), {0.0, 0.0, 0.0});
    add(scene, "torus", scene::make_torus(0.9F, 0.35F, 96, 48), {0.0, 1.1, 0.0});
    const scene::Entity lamp = scene.create_node("lamp", {.translation = {1.0, 4.0, 1.5}});
    scene.registry.emplace<scene::PointLight>(lamp, glm::vec3(1.0F, 0.85F, 0.6F), 40.0F);
    scene::update_world_transforms(scene.registry);
    const shadows::View view{shadows::look_at({2.2, 4.2, 4.0}, {0.0, 0.5, 0.0}, {0.0, 1.0, 0.0}),
                             shadows::infinite_perspective(0.7, 640.0 / 360.0, 0.05)};

    // What draws: an OpenGL context without a window, a device on it, a renderer on that.
    auto context = gl::create_headless_context();
    if (!context) return forward_error(context);
    auto backend = gl::create_backend(std::move(*context));
    if (!backend) return forward_error(backend);
    gpu::Device device(std::move(*backend));
    auto renderer = render::Renderer::create(device, {.width = 640, .height = 360});
    if (!renderer) return forward_error(renderer);
    if (const Status uploaded = renderer->upload(scene); !uploaded) return uploaded;

    // A frame: casters and lights go in, a list of shadow volumes comes out, the renderer draws it.
    auto system = shadows::ShadowSystem::create({.receivers = shadows::Receivers::Submitted});
    if (!system) return forward_error(system);
    auto frame = system->begin_frame();
    scene::ShadowAdapter adapter;
    if (const Status submitted = adapter.submit(scene, frame); !submitted) return submitted;
    const shadows::DrawList& volumes = std::move(frame).finish(view);
    if (const Status drawn = renderer->render({scene, view, volumes}); !drawn) return drawn;

    // What came of it: 0 in the mask is light, anything else is shadow.
    const auto mask = render::read_stencil(device, *renderer);
    if (!mask) return forward_error(mask);
    const auto lit = std::count(mask->begin(), mask->end(), std::byte{0});
    std::printf("%td of %zu pixels lie in shadow\n", std::ssize(*mask) - lit, mask->size());
    const auto picture = device.read_texture(renderer->picture());
    if (!picture) return forward_error(picture);
    std::ofstream file("first_shadow.ppm", std::ios::binary);
    file << "P6 640 360 255\n";
    for (std::size_t i = 0; i < picture->size(); i += 4)
        file.write(reinterpret_cast<const char*>(&(*picture)[i]), 3);
    return file ? Status{} : fail(ErrorCode::Io, "first_shadow.ppm could not be written.");
}

int main() {
    const Status status = first_shadow();
    if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
    return status ? 0 : 1;
}
