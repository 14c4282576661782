// SPDX-License-Identifier: MIT
//
// Write a backend: 09_skeleton_backend.hpp is one to begin with, and here it draws. The same scene
// is drawn on a device, and on the same kind of device with the skeleton in front; the masks have
// to be equal, byte for byte. That is the last step of docs/backends.md; the first ones are the
// small facts of tests/conformance, which run on the skeleton too (ctest -R skeleton).
#include <algorithm>
#include <cstdio>

#include <gnomon/gl/backend.hpp>
#include <gnomon/render/camera.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>

#include "09_skeleton_backend.hpp"

using namespace gnomon;

constexpr std::uint32_t width = 320;
constexpr std::uint32_t height = 180;

Result<gpu::Device> open_api() {
    auto context = gl::create_headless_context();
    if (!context) return forward_error(context);
    auto backend = gl::create_backend(std::move(*context));
    if (!backend) return forward_error(backend);
    return gpu::Device(std::move(*backend));
}

/// The stencil counts of a scene's last light.
Result<std::vector<std::byte>> mask_on(gpu::Device& device) {
    auto scene = scene::load_scene("builtin:pillars");
    if (!scene) return forward_error(scene);
    scene::update_world_transforms(scene->registry);
    const double aspect = double{width} / height;
    const scene::PerspectiveCamera lens{.fovy_rad = 0.8};
    const shadows::View view = render::make_view(
        {lens}, render::frame_bounds(scene::world_bounds(*scene), lens.fovy_rad, aspect), aspect);

    auto renderer = render::Renderer::create(device, {.width = width, .height = height});
    if (!renderer) return forward_error(renderer);
    if (const Status uploaded = renderer->upload(*scene); !uploaded) return forward_error(uploaded);
    auto system = shadows::ShadowSystem::create();
    if (!system) return forward_error(system);
    auto frame = system->begin_frame();
    scene::ShadowAdapter adapter;
    if (const Status done = adapter.submit(*scene, frame); !done) return forward_error(done);
    const shadows::DrawList& volumes = std::move(frame).finish(view);
    if (const Status drawn = renderer->render({*scene, view, volumes}); !drawn)
        return forward_error(drawn);
    return render::read_stencil(device, *renderer);
}

Status compare() {
    auto plain = open_api();
    if (!plain) return forward_error(plain);
    const auto expected = mask_on(*plain);
    if (!expected) return forward_error(expected);

    auto api = open_api();
    if (!api) return forward_error(api);
    gpu::Device device(std::make_unique<skeleton::Backend>(std::move(*api)));
    const auto mask = mask_on(device);
    if (!mask) return forward_error(mask);

    std::size_t differ = 0;
    for (std::size_t i = 0; i < mask->size(); ++i) differ += (*mask)[i] != (*expected)[i] ? 1 : 0;
    const auto lit = std::count(mask->begin(), mask->end(), std::byte{0});
    std::printf("drawn by \"%s\" on %s\n", device.caps().backend.c_str(),
                device.caps().adapter.c_str());
    std::printf("%td of %zu pixels lie in shadow, %zu differ\n", std::ssize(*mask) - lit,
                mask->size(), differ);
    return differ == 0 ? Status{} : fail(ErrorCode::Internal, "The skeleton's mask is another.");
}

int main() {
    const Status status = compare();
    if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
    return status ? 0 : 1;
}
