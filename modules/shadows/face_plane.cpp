// SPDX-License-Identifier: MIT
#include "internal/face_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gnomon/shadows/orientation.hpp>

#include "internal/run_jobs.hpp"

namespace gnomon::shadows::internal {

namespace {

struct FacePlane {
    glm::vec3 normal{0.0F};
    float offset = 0.0F;
    float error = 0.0F;
};

FacePlane make_face_plane(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                          const glm::dvec3& origin) {
    constexpr double u = 0x1p-24;
    constexpr double e = 0x1p-53;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const glm::dvec3 e1 = glm::dvec3(b) - glm::dvec3(a);
    const glm::dvec3 e2 = glm::dvec3(c) - glm::dvec3(a);
    const glm::dvec3 n = glm::cross(e1, e2);
    double permanent = 0.0;  // the largest of the three
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        permanent = std::max(permanent, std::abs(e1[j] * e2[k]) + std::abs(e1[k] * e2[j]));
    }
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (largest <= 5.0 * e * permanent && exactly_collinear(a, b, c)) return {};

    const double length = glm::length(n);
    const double error = 7.0 * u + 10.0 * e * permanent / length;  // infinite where the length is 0
    FacePlane plane;
    plane.error = infinity;
    if (error > static_cast<double>(largest_face_error)) return plane;
    plane.normal = glm::vec3(n / length);
    plane.offset = static_cast<float>(-glm::dot(n, glm::dvec3(a) - origin) / length);
    plane.error = round_up(error);
    return plane;
}

}  // namespace

float round_up(double value) {
    const auto rounded = static_cast<float>(value);
    return static_cast<double>(rounded) < value
               ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
               : rounded;
}

FacePlanes make_face_planes(std::span<const glm::vec3> positions,
                            std::span<const std::array<std::uint32_t, 3>> faces,
                            const glm::vec3& bounds_min, const glm::vec3& bounds_max,
                            const Jobs& jobs) {
    FacePlanes planes;
    planes.origin = bounds_min * 0.5F + bounds_max * 0.5F;
    const glm::dvec3 origin(planes.origin);
    const glm::dvec3 half =
        glm::max(glm::dvec3(bounds_max) - origin, origin - glm::dvec3(bounds_min));
    planes.radius = round_up((half.x + half.y + half.z) * (1.0 + 0x1p-50));
    for (std::vector<float>* values :
         {&planes.normal_x, &planes.normal_y, &planes.normal_z, &planes.offset, &planes.error}) {
        values->resize((faces.size() + 15) / 16 * 16, 0.0F);
    }
    run_pieces(jobs, faces.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const FacePlane plane = make_face_plane(positions[faces[f][0]], positions[faces[f][1]],
                                                    positions[faces[f][2]], origin);
            planes.normal_x[f] = plane.normal.x;
            planes.normal_y[f] = plane.normal.y;
            planes.normal_z[f] = plane.normal.z;
            planes.offset[f] = plane.offset;
            planes.error[f] = plane.error;
        }
    });
    return planes;
}

}  // namespace gnomon::shadows::internal
