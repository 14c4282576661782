// SPDX-License-Identifier: MIT
//
// gnomon-peer-gl and gnomon-peer-vk: the shared scenes by gnomon's own small renderer on one of its
// backends, by its public headers and with its defaults.
#include <gnomon/render/camera.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/shadow_adapter.hpp>

#include <devices.hpp>

#if GNOMON_PEER_IS_GL
#include <gnomon/gl/backend.hpp>

#include "dry_context.hpp"
#endif
#include "peer.hpp"

namespace gnomon::peers {

namespace {

// A device with what is drawn on it. Shadow systems too are its own: what a frame costs depends on
// the one before.
struct Stage {
    explicit Stage(gpu::Device d) : device(std::move(d)) {}

    gpu::Device device;
    std::optional<render::Renderer> renderer;
    std::optional<shadows::ShadowSystem> with_shadows;
    std::optional<shadows::ShadowSystem> without_shadows;
    scene::ShadowAdapter adapter;
};

Result<std::unique_ptr<Stage>> make_stage(Result<gpu::Device> device, const scene::Scene& scene,
                                          Size size) {
    if (!device) return forward_error(device);
    auto stage = std::make_unique<Stage>(std::move(*device));
    auto renderer =
        render::Renderer::create(stage->device, {.width = size.width, .height = size.height});
    if (!renderer) return forward_error(renderer);
    stage->renderer = std::move(*renderer);
    if (const Status uploaded = stage->renderer->upload(scene); !uploaded)
        return forward_error(uploaded);
    for (auto* system : {&stage->with_shadows, &stage->without_shadows}) {
        auto made = shadows::ShadowSystem::create({.receivers = shadows::Receivers::Submitted});
        if (!made) return forward_error(made);
        *system = std::move(*made);
    }
    return stage;
}

class GnomonPeer final : public Peer {
public:
    GnomonPeer(const PeerScene& scene, Size size);
    Status start();

    void move_instance(std::size_t instance, const glm::dmat4& world_from_local) override {
        pose(instances_[instance], world_from_local);
    }
    void move_light(std::size_t light, const glm::dvec4& position_world) override;
    Status draw(bool shadows, bool dry) override;
    Result<std::vector<std::byte>> picture() override {
        return wet_->device.read_texture(wet_->renderer->picture());
    }
    bool runs_dry() const override { return GNOMON_PEER_IS_GL; }
    nlohmann::ordered_json describe() const override;

private:
    Status start_dry();
    void pose(scene::Entity entity, const glm::dmat4& world_from_local) {
        scene_.registry.get<scene::WorldTransform>(entity).world_from_local = world_from_local;
    }

    Size size_;
    scene::Scene scene_;
    std::vector<scene::Entity> instances_;
    std::vector<scene::Entity> lights_;
    shadows::View view_;
    shadows::FrameStats stats_;  // of the last frame with shadows
    std::unique_ptr<Stage> wet_;
    std::unique_ptr<Stage> dry_;
};

std::shared_ptr<const scene::Mesh> share(const PeerMesh& source, bool casts) {
    scene::Mesh mesh;
    mesh.positions = source.positions;
    mesh.normals = source.normals;
    mesh.indices = source.indices;
    mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), casts ? 0U : 1U}};
    return std::make_shared<const scene::Mesh>(std::move(mesh));
}

GnomonPeer::GnomonPeer(const PeerScene& scene, Size size) : size_(size) {
    scene_.materials.resize(2);
    scene_.materials[0].base_color = {0.35F, 0.35F, 0.35F, 1.0F};
    scene_.materials[1].base_color = {0.2F, 0.2F, 0.2F, 1.0F};
    std::vector<std::shared_ptr<const scene::Mesh>> meshes;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        meshes.push_back(share(scene.meshes[i], scene.casts(i)));
    for (const Instance& instance : scene.instances) {
        const scene::Entity entity = scene_.create_node(instance.casts ? "caster" : "ground");
        scene_.registry.emplace<scene::MeshInstance>(entity, meshes[instance.mesh]);
        scene_.registry.emplace<scene::Receiver>(entity);
        if (instance.casts) scene_.registry.emplace<scene::Caster>(entity);
        instances_.push_back(entity);
        pose(entity, instance.world_from_local);
    }
    for (const Light& light : scene.lights) {
        const scene::Entity entity = scene_.create_node("light");
        if (light.position_world.w == 0.0) {
            scene_.registry.emplace<scene::DirectionalLight>(entity);
        } else {
            scene_.registry.emplace<scene::PointLight>(
                entity, scene::PointLight{.intensity = static_cast<float>(light.intensity)});
        }
        lights_.push_back(entity);
        move_light(lights_.size() - 1, light.position_world);
    }
    const scene::Camera camera{scene::PerspectiveCamera{.fovy_rad = scene.fovy_rad}};
    view_ = render::make_view(camera, render::camera_pose(scene.eye, scene.target, {0.0, 1.0, 0.0}),
                              static_cast<double>(size.width) / size.height, scene.near_m);
}

Status GnomonPeer::start() {
    constexpr auto backend = GNOMON_PEER_IS_GL ? "gl" : "vk";
    auto wet = make_stage(cli::create_device({.backend = backend}), scene_, size_);
    if (!wet) return forward_error(wet);
    wet_ = std::move(*wet);
    return {};
}

// Only when it is asked for: it is no part of the set-up that is measured.
Status GnomonPeer::start_dry() {
#if GNOMON_PEER_IS_GL
    auto context = gl::create_headless_context();
    if (!context) return forward_error(context);
    auto backend = gl::create_backend(make_dry(std::move(*context)));
    if (!backend) return forward_error(backend);
    auto dry = make_stage(gpu::Device(std::move(*backend)), scene_, size_);
    if (!dry) return forward_error(dry);
    dry_ = std::move(*dry);
#endif
    return {};
}

void GnomonPeer::move_light(std::size_t light, const glm::dvec4& position_world) {
    glm::dmat4 world(1.0);
    const glm::dvec3 place(position_world);
    if (position_world.w == 0.0) {  // a sun shines along its own -Z
        world = render::camera_pose({0.0, 0.0, 0.0}, -place, {0.0, 0.0, 1.0});
    } else {
        world[3] = glm::dvec4(place, 1.0);
    }
    pose(lights_[light], world);
}

Status GnomonPeer::draw(bool shadows, bool dry) {
    if (dry && !dry_) {
        if (const Status started = start_dry(); !started) return started;
    }
    Stage& stage = dry ? *dry_ : *wet_;
    shadows::ShadowSystem& system = shadows ? *stage.with_shadows : *stage.without_shadows;
    auto frame = system.begin_frame();
    if (shadows) {
        if (const Status given = stage.adapter.submit(scene_, frame); !given) return given;
    } else {
        for (const scene::Entity entity : lights_) {
            if (const auto light = scene::shadow_light(scene_.registry, entity))
                frame.light(*light);
        }
    }
    const shadows::DrawList& list = std::move(frame).finish(view_);
    if (shadows) stats_ = list.stats;
    if (const Status drawn = stage.renderer->render({scene_, view_, list}); !drawn) return drawn;
    return stage.device.wait_idle();
}

nlohmann::ordered_json GnomonPeer::describe() const {
    const gpu::Caps& caps = wet_->device.caps();
    return {{"engine", "gnomon (" + std::string(caps.backend) + ")"},
            {"device", caps.adapter},
            {"zpass_pairs", stats_.zpass_pairs},
            {"zfail_pairs", stats_.zfail_pairs},
            {"silhouette_edges", stats_.silhouette_edges}};
}

Result<std::unique_ptr<Peer>> make(const PeerScene& scene, Size size) {
    auto peer = std::make_unique<GnomonPeer>(scene, size);
    if (const Status started = peer->start(); !started) return forward_error(started);
    return peer;
}

}  // namespace

}  // namespace gnomon::peers

int main(int argc, char** argv) { return gnomon::peers::run_peer(argc, argv, gnomon::peers::make); }
