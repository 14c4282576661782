// SPDX-License-Identifier: MIT
#include <gnomon/sun_study/surface_points.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <gnomon/sun_study/plan_grid.hpp>

namespace gnomon::sun_study {

namespace {

using Triangle = std::array<glm::dvec3, 3>;

constexpr double lift_m = 1e-3;

// By which of its sides, from corner k to the next, a triangle is halved.
std::size_t longest_side(const Triangle& t) {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        if (glm::distance(t[k], t[(k + 1) % 3]) > glm::distance(t[longest], t[(longest + 1) % 3])) {
            longest = k;
        }
    }
    return longest;
}

// False where there are too many.
bool append_patches(const Triangle& face, const glm::dvec3& normal, double spacing_m,
                    std::size_t most_points, std::vector<SurfacePoint>& points) {
    std::vector<Triangle> rest{face};
    while (!rest.empty()) {
        const Triangle t = rest.back();
        rest.pop_back();
        const std::size_t k = longest_side(t);
        const glm::dvec3& a = t[k];
        const glm::dvec3& b = t[(k + 1) % 3];
        const glm::dvec3& c = t[(k + 2) % 3];
        if (glm::distance(a, b) > spacing_m) {
            if (points.size() + rest.size() >= most_points) return false;
            const glm::dvec3 middle = (a + b) * 0.5;
            rest.push_back({middle, b, c});
            rest.push_back({a, middle, c});
            continue;
        }
        points.push_back(
            {(a + b + c) / 3.0, normal, 0.5 * glm::length(glm::cross(b - a, c - a)), t});
        if (points.size() > most_points) return false;
    }
    return true;
}

}  // namespace

Result<std::vector<SurfacePoint>> sample_surfaces(std::span<const shadows::Caster> receivers,
                                                  double spacing_m, std::size_t most_points) {
    std::vector<SurfacePoint> points;
    for (const shadows::Caster& receiver : receivers) {
        const auto positions = receiver.mesh->positions();
        // A mirrored pose turns the order of corners about.
        const double outwards =
            glm::determinant(glm::dmat3(receiver.world_from_local)) < 0.0 ? -1.0 : 1.0;
        for (const auto& face : receiver.mesh->faces()) {
            Triangle t;
            for (std::size_t k = 0; k < 3; ++k) {
                t[k] = plan_from_world(glm::dvec3(receiver.world_from_local *
                                                  glm::dvec4(glm::dvec3(positions[face[k]]), 1.0)));
            }
            const glm::dvec3 cross = outwards * glm::cross(t[1] - t[0], t[2] - t[0]);
            const double size = glm::length(cross);
            // A wall that leans out has sun while it stands low.
            constexpr double looks_down = -0.999;
            if (!(size > 0.0) || cross.z / size < looks_down) continue;
            if (!append_patches(t, cross / size, spacing_m, most_points, points)) {
                return fail(
                    ErrorCode::InvalidInput,
                    fmt::format("The surfaces have more than {} points at a spacing of {:g} "
                                "m; a larger spacing or fewer receivers fit.",
                                most_points, spacing_m));
            }
        }
    }
    return points;
}

std::vector<std::uint8_t> lit_points(const shadows::ShadowQueries& queries,
                                     std::span<const SurfacePoint> points,
                                     const glm::dvec3& towards_sun_plan,
                                     const shadows::Jobs& jobs) {
    std::vector<std::uint8_t> lit(points.size(), 0);
    const shadows::Light light{
        .key = 1, .position_world = glm::dvec4(world_from_plan(towards_sun_plan), 0.0)};
    constexpr std::size_t a_task = 4096;
    const auto task = [&](std::size_t number) {
        const std::size_t end = std::min((number + 1) * a_task, points.size());
        for (std::size_t i = number * a_task; i < end; ++i) {
            const SurfacePoint& point = points[i];
            if (glm::dot(point.normal_plan, towards_sun_plan) <= 0.0) continue;
            const glm::dvec3 at = world_from_plan(point.at_plan + point.normal_plan * lift_m);
            lit[i] = queries.at(light, at) == shadows::Exposure::Lit ? 1 : 0;
        }
    };
    const std::size_t tasks = (points.size() + a_task - 1) / a_task;
    if (jobs) {
        jobs(tasks, task);
    } else {
        for (std::size_t number = 0; number < tasks; ++number) task(number);
    }
    return lit;
}

}  // namespace gnomon::sun_study
