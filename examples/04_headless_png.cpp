// SPDX-License-Identifier: MIT
//
// A scene in, a PNG out, on a machine that has no display and perhaps no GPU:
//
//     04_headless_png [SCENE [PICTURE.png [ADAPTER]]]
//
// SCENE is a .glb, .gltf or .scene.json, or builtin:NAME. ADAPTER is "gl", or part of the name of a
// Vulkan device; without it the first that works is taken: Vulkan's best, else OpenGL without a
// window. The picture is seen by the scene's camera, or whole from above. `gnomon render` is this
// with options.
#include <cstdio>
#include <optional>
#include <string>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include <gnomon/gl/backend.hpp>
#include <gnomon/render/camera.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>
#include <gnomon/vk/backend.hpp>

using namespace gnomon;

/// A device that draws. Neither API is linked: what the machine lacks is a sentence, not a crash.
Result<gpu::Device> open_device(const std::string& adapter) {
    std::string why_not;
    if (adapter != "gl") {
        vk::BackendOptions options;
        options.adapter = adapter;
        auto backend = vk::create_backend(options);
        if (backend) return gpu::Device(std::move(*backend));
        if (!adapter.empty()) return forward_error(backend);
        why_not = backend.error().message + " ";
    }
    auto context = gl::create_headless_context();
    if (!context) return fail(context.error().code, why_not + context.error().message);
    auto backend = gl::create_backend(std::move(*context));
    if (!backend) return fail(backend.error().code, why_not + backend.error().message);
    return gpu::Device(std::move(*backend));
}

/// What the scene lacks for a picture: a light, and somebody who looks.
shadows::View complete(scene::Scene& scene, double aspect) {
    scene::Registry& registry = scene.registry;
    scene::update_world_transforms(registry);
    if (registry.count<scene::PointLight>() + registry.count<scene::SpotLight>() +
            registry.count<scene::DirectionalLight>() ==
        0) {
        const glm::dmat4 pose = render::camera_pose({0, 0, 0}, {0.75, -1.0, -0.4}, {0, 1, 0});
        registry.emplace<scene::DirectionalLight>(scene.create_node("sun", {.matrix = pose}));
    }
    std::optional<shadows::View> view;
    registry.each<scene::Camera, scene::WorldTransform>(
        [&](scene::Entity, const scene::Camera& camera, const scene::WorldTransform& world) {
            if (!view) view = render::make_view(camera, world.world_from_local, aspect);
        });
    if (view) return *view;
    const scene::Bounds bounds = scene::world_bounds(scene);
    const scene::PerspectiveCamera lens{.fovy_rad = 0.8, .near_m = 1e-5 * bounds.diagonal()};
    return render::make_view({lens}, render::frame_bounds(bounds, lens.fovy_rad, aspect), aspect);
}

Status draw(const std::string& source, const std::string& picture, const std::string& adapter) {
    constexpr std::uint32_t width = 640;
    constexpr std::uint32_t height = 360;
    auto scene = scene::load_scene(source);
    if (!scene) return forward_error(scene);
    const shadows::View view = complete(*scene, double{width} / height);

    auto device = open_device(adapter);
    if (!device) return forward_error(device);
    const std::uint32_t samples = device->caps().features.multisample_4 ? 4 : 1;
    auto renderer = render::Renderer::create(
        *device, {.width = width, .height = height, .sample_count = samples});
    if (!renderer) return forward_error(renderer);
    if (const Status uploaded = renderer->upload(*scene); !uploaded) return uploaded;

    auto system = shadows::ShadowSystem::create({.receivers = shadows::Receivers::Submitted});
    if (!system) return forward_error(system);
    auto frame = system->begin_frame();
    scene::ShadowAdapter shadow_adapter;
    if (const Status done = shadow_adapter.submit(*scene, frame); !done) return done;
    const shadows::DrawList& volumes = std::move(frame).finish(view);
    if (const Status drawn = renderer->render({*scene, view, volumes}); !drawn) return drawn;

    const auto pixels = device->read_texture(renderer->picture());
    if (!pixels) return forward_error(pixels);
    if (stbi_write_png(picture.c_str(), width, height, 4, pixels->data(), width * 4) == 0)
        return fail(ErrorCode::Io, picture + " could not be written.");
    std::printf("%s: %zu shadow volumes of %llu casters, drawn by %s\n", picture.c_str(),
                volumes.draws.size(), static_cast<unsigned long long>(volumes.stats.casters),
                device->caps().adapter.c_str());
    return {};
}

int main(int argc, char** argv) {
    const auto argument = [&](int i, const char* otherwise) -> std::string {
        return i < argc ? argv[i] : otherwise;
    };
    const Status status =
        draw(argument(1, "builtin:pillars"), argument(2, "headless.png"), argument(3, ""));
    if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
    return status ? 0 : 1;
}
