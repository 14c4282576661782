// SPDX-License-Identifier: MIT
//
// The same frames in a browser and natively: compiled by Emscripten it draws by WebGPU, else by
// Vulkan as browsers do. Both waits for the device belong to a frame. Prints a line of JSON for
// each scene and motion; gnomon-web-frames runs both in turn and compares. It judges nothing: the
// masks of the two are held against each other by tests/web.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/render/camera.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>
#ifdef __EMSCRIPTEN__
#include <gnomon/webgpu/backend.hpp>
#else
#include <gnomon/vk/backend.hpp>
#endif

namespace gnomon::bench {

namespace {

constexpr std::uint32_t width = 640;
constexpr std::uint32_t height = 360;
constexpr int warm_frames = 4;  // which make what the others find
constexpr int frames = 24;
constexpr double step_rad = 0.01;

enum class Motion : std::uint8_t { Nothing, Camera, Light };

const char* to_string(Motion motion) {
    switch (motion) {
        case Motion::Nothing: return "nothing";
        case Motion::Camera: return "camera";
        case Motion::Light: return "light";
    }
    return "";
}

Result<gpu::Device> open_device() {
#ifdef __EMSCRIPTEN__
    auto backend = webgpu::create_backend();
#else
    // The rasteriser that Chromium ships is the one that its pages draw with here.
    auto backend = vk::create_backend({.adapter = "SwiftShader",
                                       .disabled_features = {"depthBounds"},
                                       .y_up = vk::YUp::Viewport});
#endif
    if (!backend) return forward_error(backend);
    return gpu::Device(std::move(*backend));
}

/// Somebody who looks: the scene's camera, else one that sees all of it.
shadows::View view_of(scene::Scene& scene) {
    constexpr double aspect = double{width} / height;
    scene::update_world_transforms(scene.registry);
    std::optional<shadows::View> view;
    scene.registry.each<scene::Camera, scene::WorldTransform>(
        [&](scene::Entity, const scene::Camera& camera, const scene::WorldTransform& world) {
            if (!view) view = render::make_view(camera, world.world_from_local, aspect);
        });
    if (view) return *view;
    const scene::Bounds bounds = scene::world_bounds(scene);
    const scene::PerspectiveCamera lens{.fovy_rad = 0.8, .near_m = 1e-5 * bounds.diagonal()};
    return render::make_view({lens}, render::frame_bounds(bounds, lens.fovy_rad, aspect), aspect);
}

std::vector<scene::Entity> lights_of(const scene::Scene& scene) {
    std::vector<scene::Entity> lights;
    const auto take = [&](scene::Entity entity, const auto&) { lights.push_back(entity); };
    scene.registry.each<scene::PointLight>(take);
    scene.registry.each<scene::SpotLight>(take);
    scene.registry.each<scene::DirectionalLight>(take);
    return lights;
}

class Frames {
public:
    Frames(gpu::Device& device, scene::Scene& scene, render::Renderer& renderer,
           shadows::ShadowSystem& system)
        : device_(device),
          scene_(scene),
          renderer_(renderer),
          system_(system),
          view_(view_of(scene)),
          lights_(lights_of(scene)) {}

    Status draw(const std::string& name, Motion motion) {
        if (const Status warm = draw(warm_frames, motion); !warm) return warm;
        const auto start = std::chrono::steady_clock::now();
        if (const Status done = draw(frames, motion); !done) return done;
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - start;
        std::printf("{\"scene\": \"%s\", \"motion\": \"%s\", \"frame_ms\": %.4f}\n", name.c_str(),
                    to_string(motion), took.count() / frames);
        return {};
    }

private:
    /// One after the other; then waits for the device.
    Status draw(int count, Motion motion) {
        const glm::dvec3 middle = scene::world_bounds(scene_).center();
        for (int i = 0; i < count; ++i) {
            move(motion, middle);
            scene::update_world_transforms(scene_.registry);
            auto frame = system_.begin_frame();
            if (const Status done = adapter_.submit(scene_, frame); !done) return done;
            const shadows::DrawList& volumes = std::move(frame).finish(view_);
            if (const Status drawn = renderer_.render({scene_, view_, volumes}); !drawn) {
                return drawn;
            }
        }
        return device_.wait_idle();
    }

    /// About the scene's middle, by a step to and fro.
    void move(Motion motion, const glm::dvec3& middle) {
        step_ = -step_;
        const glm::dmat4 turned = glm::translate(glm::dmat4(1.0), middle) *
                                  glm::rotate(glm::dmat4(1.0), step_, {0.0, 1.0, 0.0}) *
                                  glm::translate(glm::dmat4(1.0), -middle);
        if (motion == Motion::Camera) view_.view_from_world = view_.view_from_world * turned;
        if (motion != Motion::Light) return;
        for (const scene::Entity light : lights_) {
            auto& local = scene_.registry.get<scene::LocalTransform>(light);
            local.matrix = turned * local.parent_from_local();
        }
    }

    gpu::Device& device_;
    scene::Scene& scene_;
    render::Renderer& renderer_;
    shadows::ShadowSystem& system_;
    scene::ShadowAdapter adapter_;
    shadows::View view_;
    std::vector<scene::Entity> lights_;
    double step_ = step_rad;
};

Status draw_all() {
    auto device = open_device();
    if (!device) return forward_error(device);
    for (const std::string& name : scene::builtin_scene_names()) {
        auto scene = scene::load_scene("builtin:" + name);
        if (!scene) return forward_error(scene);
        auto renderer = render::Renderer::create(*device, {.width = width, .height = height});
        if (!renderer) return forward_error(renderer);
        if (const Status uploaded = renderer->upload(*scene); !uploaded) return uploaded;
        auto system = shadows::ShadowSystem::create({.receivers = shadows::Receivers::Submitted});
        if (!system) return forward_error(system);
        Frames drawn(*device, *scene, *renderer, *system);
        for (const Motion motion : {Motion::Nothing, Motion::Camera, Motion::Light}) {
            if (const Status done = drawn.draw(name, motion); !done) return done;
        }
    }
    return {};
}

}  // namespace

}  // namespace gnomon::bench

int main() {
    const gnomon::Status status = gnomon::bench::draw_all();
    if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
    return status ? 0 : 1;
}
