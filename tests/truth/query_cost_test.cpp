// SPDX-License-Identifier: MIT
//
// What a shadow query costs, beside an occlusion ray of Embree at the same point: the same answers,
// and the ratio of interleaved rounds. A soak test, for a quiet machine.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <random>
#include <vector>

#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/shadows/shadow_query.hpp>

namespace gnomon::test {
namespace {

class EmbreeRays {
public:
    EmbreeRays(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices)
        : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* vertices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof(glm::vec3), positions.size());
        std::copy(positions.begin(), positions.end(), static_cast<glm::vec3*>(vertices));
        void* triangles =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(std::uint32_t), indices.size() / 3);
        std::copy(indices.begin(), indices.end(), static_cast<std::uint32_t*>(triangles));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    ~EmbreeRays() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeRays(const EmbreeRays&) = delete;
    EmbreeRays& operator=(const EmbreeRays&) = delete;

    [[nodiscard]] bool blocked(const glm::vec3& from, const glm::vec3& to) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay ray{};
        ray.org_x = from.x;
        ray.org_y = from.y;
        ray.org_z = from.z;
        ray.dir_x = to.x - from.x;
        ray.dir_y = to.y - from.y;
        ray.dir_z = to.z - from.z;
        ray.tfar = 1.0F;
        ray.mask = 0xFFFFFFFFU;
        rtcOccluded1(scene_, &context, &ray);
        return ray.tfar < 0.0F;
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};

template <class Work>
double nanoseconds_each(std::size_t count, Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::nano> passed =
        std::chrono::steady_clock::now() - start;
    return passed.count() / static_cast<double>(count);
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ssize(values) / 2, values.end());
    return values[values.size() / 2];
}

TEST(QueryCost, BesideEmbreesOcclusionRays) {
    const scene::Mesh knot = scene::make_torus_knot(1.0F, 0.32F, 2, 3, 1024, 48);
    const auto mesh = shadows::ShadowMesh::build(
        {.positions = reinterpret_cast<const std::byte*>(knot.positions.data()),
         .vertex_count = knot.positions.size(),
         .indices = knot.indices});
    ASSERT_TRUE(mesh.has_value());
    std::mt19937 random(1977);
    std::uniform_real_distribution<double> within(-1.0, 1.0);
    const auto in_cube = [&] { return glm::dvec3(within(random), within(random), within(random)); };

    std::vector<shadows::Caster> casters;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (std::uint64_t key = 0; key < 16; ++key) {
        const glm::dmat4 pose = glm::rotate(glm::translate(glm::dmat4(1.0), 6.0 * in_cube()),
                                            3.0 * within(random), glm::normalize(in_cube()));
        casters.push_back({.key = key, .mesh = *mesh, .world_from_local = pose});
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const glm::vec3& p : knot.positions)
            positions.emplace_back(pose * glm::dvec4(glm::dvec3(p), 1.0));
        for (const std::uint32_t i : knot.indices) indices.push_back(first + i);
    }
    const EmbreeRays embree(positions, indices);
    shadows::ShadowQueries queries;
    queries.update(casters);

    const shadows::Light lamp{.position_world = {1.0, 12.0, 2.0, 1.0}};
    const glm::vec3 lamp_at(lamp.position_world);
    std::vector<glm::dvec3> points(100'000);
    for (glm::dvec3& p : points) p = glm::dvec3(glm::vec3(8.0 * in_cube()));
    std::vector<shadows::Exposure> exposures(points.size());
    std::vector<std::uint8_t> blocked(points.size());
    std::vector<double> query_ns;
    std::vector<double> ray_ns;
    std::vector<double> ratios;
    for (int round = 0; round < 9; ++round) {
        query_ns.push_back(nanoseconds_each(points.size(), [&] {
            for (std::size_t i = 0; i < points.size(); ++i)
                exposures[i] = queries.at(lamp, points[i]);
        }));
        ray_ns.push_back(nanoseconds_each(points.size(), [&] {
            for (std::size_t i = 0; i < points.size(); ++i)
                blocked[i] = embree.blocked(glm::vec3(points[i]), lamp_at) ? 1 : 0;
        }));
        ratios.push_back(query_ns.back() / ray_ns.back());
    }
    std::size_t other = 0;
    std::size_t shadowed = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool dark = exposures[i] == shadows::Exposure::Shadowed;
        other += dark != (blocked[i] != 0) ? 1U : 0U;
        shadowed += dark ? 1U : 0U;
    }
    std::printf(
        "%zu triangles in %zu casters, %.1f %% of %zu points in shadow: %.0f ns a query, "
        "%.0f ns a ray, ratio %.2f; %zu answers differ\n",
        indices.size() / 3, casters.size(),
        100.0 * static_cast<double>(shadowed) / static_cast<double>(points.size()), points.size(),
        median(query_ns), median(ray_ns), median(ratios), other);
    EXPECT_LE(other, points.size() / 10'000) << "a few graze an outline in single precision";
    EXPECT_GT(shadowed, points.size() / 10);
    EXPECT_LT(shadowed, points.size() * 9 / 10);
}

}  // namespace
}  // namespace gnomon::test
