// SPDX-License-Identifier: MIT
#include "plan_rays.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <utility>

#include <embree3/rtcore.h>

namespace gnomon::bench {

struct PlanRays::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    sun_study::PlanGrid grid;
    shadows::Jobs jobs;

    ~State() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }
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

// One mask's cells and rays.
struct Sun {
    RTCScene scene;
    const sun_study::PlanGrid& grid;
    glm::vec3 towards;
    std::uint8_t* lit;

    [[nodiscard]] float x(std::uint32_t column) const {
        return static_cast<float>((column + 0.5) * grid.cell_m - grid.size_m().x * 0.5);
    }
    [[nodiscard]] float z(std::uint32_t row) const {
        return static_cast<float>((row + 0.5) * grid.cell_m - grid.size_m().y * 0.5);
    }
};

RTCIntersectContext coherent() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay16* rays) {
    rtcOccluded16(valid, scene, context, rays);
}
void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay8* rays) {
    rtcOccluded8(valid, scene, context, rays);
}

// Columns x Rows cells, as a packet.
template <class Packet, std::uint32_t Columns, std::uint32_t Rows>
void trace_packet(const Sun& sun, std::uint32_t column, std::uint32_t row) {
    constexpr std::uint32_t size = Columns * Rows;
    alignas(64) Packet rays;
    alignas(64) std::array<int, size> valid;
    for (std::uint32_t i = 0; i < size; ++i) {
        const std::uint32_t c = column + i % Columns;
        const std::uint32_t r = row + i / Columns;
        valid[i] = c < sun.grid.columns && r < sun.grid.rows ? -1 : 0;
        rays.org_x[i] = sun.x(c);
        rays.org_y[i] = 0.0F;
        rays.org_z[i] = sun.z(r);
        rays.dir_x[i] = sun.towards.x;
        rays.dir_y[i] = sun.towards.y;
        rays.dir_z[i] = sun.towards.z;
        rays.tnear[i] = 0.0F;
        rays.tfar[i] = std::numeric_limits<float>::infinity();
        rays.time[i] = 0.0F;
        rays.mask[i] = ~0U;
        rays.id[i] = 0;
        rays.flags[i] = 0;
    }
    RTCIntersectContext context = coherent();
    occluded(valid.data(), sun.scene, &context, &rays);
    for (std::uint32_t i = 0; i < size; ++i) {
        if (valid[i] == 0) continue;
        const std::size_t cell =
            std::size_t{row + i / Columns} * sun.grid.columns + column + i % Columns;
        sun.lit[cell] = rays.tfar[i] < 0.0F ? 0 : 1;
    }
}

// Rays one by one, or as a stream: Columns x Rows of them.
template <std::uint32_t Columns, std::uint32_t Rows>
void trace_rays(const Sun& sun, std::uint32_t column, std::uint32_t row) {
    alignas(64) std::array<RTCRay, std::size_t{Columns} * Rows> rays;
    unsigned count = 0;
    for (std::uint32_t r = row; r < std::min(row + Rows, sun.grid.rows); ++r) {
        for (std::uint32_t c = column; c < std::min(column + Columns, sun.grid.columns); ++c) {
            RTCRay& ray = rays[count++];
            ray.org_x = sun.x(c);
            ray.org_y = 0.0F;
            ray.org_z = sun.z(r);
            ray.dir_x = sun.towards.x;
            ray.dir_y = sun.towards.y;
            ray.dir_z = sun.towards.z;
            ray.tnear = 0.0F;
            ray.tfar = std::numeric_limits<float>::infinity();
            ray.time = 0.0F;
            ray.mask = ~0U;
            ray.id = r * sun.grid.columns + c;
            ray.flags = 0;
        }
    }
    RTCIntersectContext context = coherent();
    if constexpr (Columns * Rows == 1) {
        rtcOccluded1(sun.scene, &context, rays.data());
    } else {
        rtcOccluded1M(sun.scene, &context, rays.data(), count, sizeof(RTCRay));
    }
    for (unsigned i = 0; i < count; ++i) sun.lit[rays[i].id] = rays[i].tfar < 0.0F ? 0 : 1;
}

using Trace = void (*)(const Sun&, std::uint32_t, std::uint32_t);

struct Pattern {
    Trace trace;
    std::uint32_t columns;
    std::uint32_t rows;
};

Pattern pattern_of(RayPacking packing) {
    switch (packing) {
        case RayPacking::Rows16: return {&trace_packet<RTCRay16, 16, 1>, 16, 1};
        case RayPacking::Squares16: return {&trace_packet<RTCRay16, 4, 4>, 4, 4};
        case RayPacking::Rows8: return {&trace_packet<RTCRay8, 8, 1>, 8, 1};
        case RayPacking::Squares8: return {&trace_packet<RTCRay8, 4, 2>, 4, 2};
        case RayPacking::Stream: return {&trace_rays<16, 16>, 16, 16};
        case RayPacking::Single: break;
    }
    return {&trace_rays<1, 1>, 1, 1};
}

}  // namespace

PlanRays::PlanRays(std::span<const shadows::Caster> casters, const sun_study::PlanGrid& grid,
                   shadows::Jobs jobs)
    : state_(std::make_unique<State>()) {
    state_->grid = grid;
    state_->jobs = std::move(jobs);
    state_->device = rtcNewDevice(nullptr);
    if (state_->device == nullptr) throw std::runtime_error("Embree does not start");
    state_->scene = rtcNewScene(state_->device);
    rtcSetSceneBuildQuality(state_->scene, RTC_BUILD_QUALITY_HIGH);
    const glm::dvec2 middle = grid.min_m + grid.size_m() * 0.5;
    const glm::dvec3 middle_world = sun_study::world_from_plan(glm::dvec3(middle, grid.height_m));
    for (const shadows::Caster& caster : casters) {
        add_caster(state_->device, state_->scene, caster, middle_world);
    }
    rtcCommitScene(state_->scene);
}

PlanRays::~PlanRays() = default;

std::vector<sun_study::PlanMask> PlanRays::lit(std::span<const glm::dvec3> towards_suns,
                                               RayPacking packing) {
    const sun_study::PlanGrid& grid = state_->grid;
    const Pattern pattern = pattern_of(packing);
    std::vector<sun_study::PlanMask> masks(towards_suns.size());
    for (sun_study::PlanMask& mask : masks) mask.resize(grid.cell_count());
    // Bands of some rows, of every mask, are what threads share out.
    constexpr std::uint32_t band_rows = 64;
    const std::uint32_t bands = (grid.rows + band_rows - 1) / band_rows;
    state_->jobs(masks.size() * bands, [&](std::size_t task) {
        const Sun sun{state_->scene, grid,
                      glm::vec3(sun_study::world_from_plan(towards_suns[task / bands])),
                      masks[task / bands].data()};
        const auto first = static_cast<std::uint32_t>(task % bands) * band_rows;
        for (std::uint32_t row = first; row < std::min(first + band_rows, grid.rows);
             row += pattern.rows) {
            for (std::uint32_t column = 0; column < grid.columns; column += pattern.columns) {
                pattern.trace(sun, column, row);
            }
        }
    });
    return masks;
}

}  // namespace gnomon::bench
