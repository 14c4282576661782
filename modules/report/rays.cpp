// SPDX-License-Identifier: MIT
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include <embree3/rtcore.h>

#include "internal/baselines.hpp"

namespace gnomon::report::internal {

namespace {

class Rays final : public Technique {
public:
    explicit Rays(const Setup& setup)
        : width_(setup.stage.width()),
          height_(setup.stage.height()),
          eye_(glm::inverse(setup.view.view_from_world)[3]),
          offset_m_(1e-6 * setup.bounds.diagonal()) {}
    ~Rays() override {
        for (RTCScene scene : {receivers_, casters_}) {
            if (scene != nullptr) rtcReleaseScene(scene);
        }
        if (device_ != nullptr) rtcReleaseDevice(device_);
    }
    Rays(const Rays&) = delete;
    Rays& operator=(const Rays&) = delete;

    Status create(const scene::Scene& scene);
    Result<FrameCost> frame(const Moment& moment, bool look) override;
    [[nodiscard]] Result<Masks> masks(std::size_t) override { return masks_; }

private:
    Status add(const scene::Registry& registry, scene::Entity entity,
               const scene::MeshInstance& instance, const scene::WorldTransform& world,
               RTCScene scene);
    void trace_row(const Moment& moment, const glm::dmat4& world_from_clip, std::uint32_t y);

    std::uint32_t width_;
    std::uint32_t height_;
    glm::dvec3 eye_;  // the rays' origin: single precision is finest there
    double offset_m_;
    RTCDevice device_ = nullptr;
    RTCScene receivers_ = nullptr;
    RTCScene casters_ = nullptr;
    Masks masks_;
    std::uint32_t threads_ = machine::usable_cores();
};

Status Rays::add(const scene::Registry& registry, scene::Entity entity,
                 const scene::MeshInstance& instance, const scene::WorldTransform& world,
                 RTCScene scene) {
    const auto geometry = scene::geometry_of(registry, entity, instance, world);
    if (instance.mesh->indices.empty()) return {};
    RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), geometry.positions.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), instance.mesh->triangle_count()));
    if (vertices == nullptr || indices == nullptr) {
        rtcReleaseGeometry(mesh);
        return fail(ErrorCode::OutOfMemory, "Embree has no memory for the scene.");
    }
    for (std::size_t i = 0; i < geometry.positions.size(); ++i) {
        const glm::dvec4 p(glm::dvec3(geometry.positions[i]), 1.0);
        vertices[i] = glm::vec3(glm::dvec3(geometry.world_from_positions * p) - eye_);
    }
    for (std::size_t i = 0; i < instance.mesh->triangle_count() * 3; ++i) {
        indices[i] = instance.mesh->indices[i];
    }
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
    return {};
}

Status Rays::create(const scene::Scene& scene) {
    device_ = rtcNewDevice(nullptr);
    if (device_ == nullptr) return fail(ErrorCode::Internal, "Embree could not be started.");
    receivers_ = rtcNewScene(device_);
    casters_ = rtcNewScene(device_);
    Status status;
    scene.registry.each<scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::MeshInstance& instance,
            const scene::WorldTransform& world) {
            for (const bool cast : {false, true}) {
                const bool wanted = cast ? scene.registry.has<scene::Caster>(entity)
                                         : scene.registry.has<scene::Receiver>(entity);
                if (!status || !wanted) continue;
                status = add(scene.registry, entity, instance, world, cast ? casters_ : receivers_);
            }
        });
    if (!status) return status;
    for (RTCScene tree : {receivers_, casters_}) {
        rtcSetSceneFlags(tree, RTC_SCENE_FLAG_ROBUST);
        rtcCommitScene(tree);
    }
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) {
        return fail(ErrorCode::Internal, "Embree could not build its search trees.");
    }
    return {};
}

void Rays::trace_row(const Moment& moment, const glm::dmat4& world_from_clip, std::uint32_t y) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::uint32_t x = 0; x < width_; ++x) {
        // On the near plane, where depth is 1.
        const glm::dvec4 near =
            world_from_clip *
            glm::dvec4((x + 0.5) / width_ * 2.0 - 1.0, 1.0 - (y + 0.5) / height_ * 2.0, 1.0, 1.0);
        const glm::vec3 start(glm::dvec3(near) / near.w - eye_);
        const glm::vec3 direction = glm::normalize(start);
        RTCRayHit hit{};
        hit.ray = {.org_x = start.x,
                   .org_y = start.y,
                   .org_z = start.z,
                   .tnear = 0.0F,
                   .dir_x = direction.x,
                   .dir_y = direction.y,
                   .dir_z = direction.z,
                   .time = 0.0F,
                   .tfar = std::numeric_limits<float>::infinity(),
                   .mask = ~0U,
                   .id = 0,
                   .flags = 0};
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(receivers_, &context, &hit);
        if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
        const glm::dvec3 place = glm::dvec3(start) + glm::dvec3(direction) * double{hit.ray.tfar};
        const glm::dvec3 normal =
            glm::normalize(glm::dvec3(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z));
        // Off the surface by what single precision may be wrong by.
        const double off_m = offset_m_ + 4e-6 * glm::length(place);
        for (std::size_t i = 0; i < moment.lights.size(); ++i) {
            const glm::dvec4& light = moment.lights[i].position_world;
            glm::dvec3 way = glm::dvec3(light) - light.w * (place + eye_);
            const bool other_side = glm::dot(normal, way) < 0.0;
            const glm::vec3 from(place + normal * (other_side ? -off_m : off_m));
            const float length = light.w == 0.0 ? std::numeric_limits<float>::infinity()
                                                : static_cast<float>(glm::length(way));
            const glm::vec3 to(glm::normalize(way));
            RTCRay ray{.org_x = from.x,
                       .org_y = from.y,
                       .org_z = from.z,
                       .tnear = 0.0F,
                       .dir_x = to.x,
                       .dir_y = to.y,
                       .dir_z = to.z,
                       .time = 0.0F,
                       .tfar = length,
                       .mask = ~0U,
                       .id = 0,
                       .flags = 0};
            rtcOccluded1(casters_, &context, &ray);
            masks_[i][std::size_t{y} * width_ + x] = ray.tfar < 0.0F ? 255 : 0;
        }
    }
}

Result<FrameCost> Rays::frame(const Moment& moment, bool /*look*/) {
    const auto start = Clock::now();
    masks_.resize(moment.lights.size());
    for (auto& mask : masks_) mask.assign(std::size_t{width_} * height_, 0);
    const glm::dmat4 world_from_clip = glm::inverse(moment.view.clip_from_world());
    std::atomic<std::uint32_t> next{0};
    const auto work = [&] {
        for (std::uint32_t y = next++; y < height_; y = next++) {
            trace_row(moment, world_from_clip, y);
        }
    };
    std::vector<std::thread> others;
    for (unsigned i = 1; i < threads_; ++i) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
    FrameCost cost;
    cost.frame_ms = milliseconds_since(start);
    return cost;
}

}  // namespace

Result<std::unique_ptr<Technique>> create_rays(const Setup& setup) {
    auto technique = std::make_unique<Rays>(setup);
    if (const Status created = technique->create(setup.subject.scene); !created) {
        return forward_error(created);
    }
    return technique;
}

}  // namespace gnomon::report::internal
