// SPDX-License-Identifier: MIT
#include "plan_rays.hpp"

#include <atomic>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include <embree3/rtcore.h>

namespace gnomon::bench {

struct PlanRays::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    sun_study::PlanGrid grid;
    glm::dvec3 middle_world{0.0};
    unsigned threads = 1;
};

namespace {

void add_caster(RTCDevice device, RTCScene scene, const shadows::Caster& caster,
                const glm::dvec3& middle) {
    const auto positions = caster.mesh->positions();
    const auto faces = caster.mesh->faces();
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), positions.size()));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), faces.size()));
    if (vertices == nullptr || indices == nullptr) throw std::runtime_error("Embree has no memory");
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec4 world =
            caster.world_from_local * glm::dvec4(glm::dvec3(positions[i]), 1.0);
        vertices[i] = glm::vec3(glm::dvec3(world) - middle);
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) indices[3 * f + k] = faces[f][k];
    }
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
}

// Sixteen cells of one row.
void trace_packet(RTCScene scene, const sun_study::PlanGrid& grid, const glm::vec3& towards,
                  std::uint32_t row, std::uint32_t first, std::uint8_t* lit) {
    alignas(64) RTCRay16 rays;
    alignas(64) int valid[16];
    const glm::dvec2 half = grid.size_m() * 0.5;
    const auto z = static_cast<float>((row + 0.5) * grid.cell_m - half.y);
    for (std::uint32_t i = 0; i < 16; ++i) {
        valid[i] = first + i < grid.columns ? -1 : 0;
        rays.org_x[i] = static_cast<float>((first + i + 0.5) * grid.cell_m - half.x);
        rays.org_y[i] = 0.0F;
        rays.org_z[i] = z;
        rays.dir_x[i] = towards.x;
        rays.dir_y[i] = towards.y;
        rays.dir_z[i] = towards.z;
        rays.tnear[i] = 0.0F;
        rays.tfar[i] = std::numeric_limits<float>::infinity();
        rays.time[i] = 0.0F;
        rays.mask[i] = ~0U;
        rays.id[i] = 0;
        rays.flags[i] = 0;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(valid, scene, &context, &rays);
    for (std::uint32_t i = 0; i < 16 && first + i < grid.columns; ++i) {
        lit[first + i] = rays.tfar[i] < 0.0F ? 0 : 1;
    }
}

}  // namespace

PlanRays::PlanRays(std::span<const shadows::Caster> casters, const sun_study::PlanGrid& grid,
                   unsigned threads)
    : state_(new State{.grid = grid, .threads = threads}) {
    state_->device = rtcNewDevice(nullptr);
    if (state_->device == nullptr) throw std::runtime_error("Embree does not start");
    state_->scene = rtcNewScene(state_->device);
    const glm::dvec2 middle = grid.min_m + grid.size_m() * 0.5;
    state_->middle_world = sun_study::world_from_plan(glm::dvec3(middle, grid.height_m));
    for (const shadows::Caster& caster : casters) {
        add_caster(state_->device, state_->scene, caster, state_->middle_world);
    }
    rtcCommitScene(state_->scene);
}

PlanRays::~PlanRays() {
    rtcReleaseScene(state_->scene);
    rtcReleaseDevice(state_->device);
    delete state_;
}

sun_study::PlanMask PlanRays::lit(const glm::dvec3& towards_sun_plan) {
    const sun_study::PlanGrid& grid = state_->grid;
    sun_study::PlanMask mask(grid.cell_count());
    const glm::vec3 towards(sun_study::world_from_plan(towards_sun_plan));
    std::atomic<std::uint32_t> next{0};
    const auto rows = [&] {
        for (std::uint32_t row = next++; row < grid.rows; row = next++) {
            for (std::uint32_t first = 0; first < grid.columns; first += 16) {
                trace_packet(state_->scene, grid, towards, row, first,
                             mask.data() + std::size_t{row} * grid.columns);
            }
        }
    };
    std::vector<std::thread> others;
    for (unsigned i = 1; i < state_->threads; ++i) others.emplace_back(rows);
    rows();
    for (std::thread& other : others) other.join();
    return mask;
}

}  // namespace gnomon::bench
