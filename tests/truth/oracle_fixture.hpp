// SPDX-License-Identifier: MIT
//
// What the oracle's own tests share: small worlds of shapes, a pinhole camera that computes its
// rays without any matrix, and a brute-force ray caster over all triangles. None of it uses the
// oracle's code, so that the two can be held against each other.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/shadows/view.hpp>
#include <gnomon/truth/truth.hpp>

namespace gnomon::truth {

struct Shape {
    scene::Mesh mesh;
    glm::dmat4 pose{1.0};
    bool casts = true;
    bool receives = true;
};

inline glm::dmat4 at(double x, double y, double z) {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

inline shadows::Light sun(const glm::dvec3& towards) { return {.position_world = {towards, 0.0}}; }
inline shadows::Light lamp(const glm::dvec3& place) { return {.position_world = {place, 1.0}}; }

inline scene::Mesh mesh_of(std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices) {
    scene::Mesh mesh;
    mesh.positions = std::move(positions);
    mesh.indices = std::move(indices);
    return mesh;
}

inline std::vector<Instance> instances_of(const std::vector<Shape>& shapes) {
    std::vector<Instance> instances;
    for (const Shape& shape : shapes) {
        instances.push_back(
            {shape.mesh.positions, shape.mesh.indices, shape.pose, shape.casts, shape.receives});
    }
    return instances;
}

inline Picture picture_of(const std::vector<Shape>& shapes, const shadows::View& view,
                          const shadows::Light& light, const Options& options,
                          const glm::dvec3& origin = glm::dvec3(0.0)) {
    const Result<Tracer> tracer = Tracer::build(instances_of(shapes), origin);
    if (!tracer) {
        ADD_FAILURE() << tracer.error().message;
        return {};
    }
    return tracer->trace(view, light, options);
}

struct Counts {
    std::size_t unjudged = 0;
    std::size_t band = 0;
    std::size_t lit = 0;
    std::size_t shadowed = 0;
};
inline Counts count(const Picture& picture) {
    Counts counts;
    for (const Verdict verdict : picture.verdicts) {
        switch (verdict) {
            case Verdict::Unjudged: ++counts.unjudged; break;
            case Verdict::Band: ++counts.band; break;
            case Verdict::Lit: ++counts.lit; break;
            case Verdict::Shadowed: ++counts.shadowed; break;
        }
    }
    return counts;
}
/// A picture proves something only if both answers occur, and the band is a small part of it.
inline void expect_telling(const Picture& picture, double most_band) {
    const Counts counts = count(picture);
    EXPECT_GT(counts.lit, 20U);
    EXPECT_GT(counts.shadowed, 20U);
    EXPECT_LT(static_cast<double>(counts.band),
              most_band * static_cast<double>(picture.verdicts.size()));
}

struct Ray {
    glm::dvec3 from{0.0};
    glm::dvec3 along{0.0};
};

/// A symmetric perspective camera, from first principles.
struct Pinhole {
    glm::dvec3 eye{0.0, 2.0, 6.0};
    glm::dvec3 target{0.0};
    double fovy_rad = 0.8;
    double near_m = 0.01;
    std::uint32_t width = 160;
    std::uint32_t height = 120;

    [[nodiscard]] double aspect() const { return static_cast<double>(width) / height; }
    [[nodiscard]] shadows::View view() const {
        return {.view_from_world = shadows::look_at(eye, target, {0.0, 1.0, 0.0}),
                .clip_from_view = shadows::infinite_perspective(fovy_rad, aspect(), near_m),
                .projection = shadows::ProjectionKind::InfinitePerspective};
    }
    [[nodiscard]] Options options() const { return {.width = width, .height = height}; }
    /// Through a place of the picture in pixels: (0, 0) is its top left corner.
    [[nodiscard]] Ray ray(const glm::dvec2& pixels) const {
        const glm::dvec3 forward = glm::normalize(target - eye);
        const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
        const glm::dvec3 up = glm::cross(right, forward);
        const double half = std::tan(fovy_rad / 2.0);
        const double x = (2.0 * pixels.x / width - 1.0) * half * aspect();
        const double y = (1.0 - 2.0 * pixels.y / height) * half;
        return {eye, forward + x * right + y * up};
    }
    /// The other way round: pixels, and metres ahead of the eye; z <= 0 for what is not ahead.
    [[nodiscard]] glm::dvec3 place_of(const glm::dvec3& point) const {
        const glm::dvec3 forward = glm::normalize(target - eye);
        const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
        const glm::dvec3 up = glm::cross(right, forward);
        const double half = std::tan(fovy_rad / 2.0);
        const double ahead = glm::dot(point - eye, forward);
        const double x = glm::dot(point - eye, right) / (ahead * half * aspect());
        const double y = glm::dot(point - eye, up) / (ahead * half);
        return {(x + 1.0) / 2.0 * width, (1.0 - y) / 2.0 * height, ahead};
    }
};

/// Calls check(x, y, verdict, ray through the centre) for every pixel that is lit or shadowed.
template <class Check>
void each_judged(const Pinhole& camera, const Picture& picture, Check&& check) {
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            const Verdict verdict = picture.verdicts[std::size_t{y} * picture.width + x];
            if (verdict == Verdict::Lit || verdict == Verdict::Shadowed) {
                check(x, y, verdict, camera.ray(glm::dvec2(x, y) + 0.5));
            }
        }
    }
}

/// Every triangle of a world, tested one by one.
class BruteForce {
public:
    explicit BruteForce(const std::vector<Shape>& shapes) {
        for (const Shape& shape : shapes) {
            for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3) {
                Face face{{}, shape.casts, shape.receives};
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::dvec3 p(shape.mesh.positions[shape.mesh.indices[i + k]]);
                    face.corners[k] = glm::dvec3(shape.pose * glm::dvec4(p, 1.0));
                }
                faces_.push_back(face);
                if (face.casts) add_edges(faces_.size() - 1);
            }
        }
    }

    [[nodiscard]] Verdict verdict(const Ray& primary, const shadows::Light& light) const {
        double nearest = std::numeric_limits<double>::infinity();
        const Face* seen = nullptr;
        for (const Face& face : faces_) {
            const std::optional<double> t = face.receives ? hit(face, primary) : std::nullopt;
            if (t && *t > 0.0 && *t < nearest) {
                nearest = *t;
                seen = &face;
            }
        }
        if (seen == nullptr) return Verdict::Unjudged;
        const glm::dvec3 place = primary.from + nearest * primary.along;
        const glm::dvec3 normal =
            glm::cross(seen->corners[1] - seen->corners[0], seen->corners[2] - seen->corners[0]);
        const glm::dvec3 to_light =
            glm::dvec3(light.position_world) - light.position_world.w * place;
        if (glm::dot(normal, to_light) * glm::dot(normal, -primary.along) <= 0.0) {
            return Verdict::Unjudged;
        }
        for (const Face& face : faces_) {
            if (!face.casts || &face == seen) continue;
            const std::optional<double> t = hit(face, {place, to_light});
            if (t && *t > 1e-9 && (light.position_world.w == 0.0 || *t < 1.0)) {
                return Verdict::Shadowed;
            }
        }
        return Verdict::Lit;
    }

    /// Whether an edge that a volume begins at is seen so near to a place of the picture.
    [[nodiscard]] bool has_silhouette(const Pinhole& camera, const shadows::Light& light,
                                      const glm::dvec2& place, double radius_px) const {
        for (const auto& [edge, faces] : edges_) {
            int count = 0;
            for (const auto& [face, direction] : faces) {
                const auto& c = faces_[face].corners;
                const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
                const glm::dvec3 to_light =
                    glm::dvec3(light.position_world) - light.position_world.w * c[0];
                count += glm::dot(normal, to_light) > 0.0 ? direction : -direction;
            }
            if (count == 0) continue;
            const glm::dvec3 a(edge[0], edge[1], edge[2]);
            const glm::dvec3 b(edge[3], edge[4], edge[5]);
            const glm::dvec3 from = camera.place_of(a);
            const glm::dvec3 to = camera.place_of(b);
            if (from.z <= 0.0 || to.z <= 0.0) continue;
            const glm::dvec2 way(to - from);
            const double t = std::clamp(
                glm::dot(place - glm::dvec2(from), way) / std::max(glm::dot(way, way), 1e-300), 0.0,
                1.0);
            if (glm::length(glm::dvec2(from) + t * way - place) > radius_px) continue;
            const double far = (t / to.z) / ((1.0 - t) / from.z + t / to.z);
            if (is_seen({camera.eye, glm::mix(a, b, far) - camera.eye})) return true;
        }
        return false;
    }

private:
    struct Face {
        std::array<glm::dvec3, 3> corners;
        bool casts;
        bool receives;
    };
    using Edge = std::array<double, 6>;
    std::vector<Face> faces_;
    std::map<Edge, std::vector<std::pair<std::size_t, int>>> edges_;  // of those that cast

    void add_edges(std::size_t face) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3& a = faces_[face].corners[k];
            const glm::dvec3& b = faces_[face].corners[(k + 1) % 3];
            const Edge there{a.x, a.y, a.z, b.x, b.y, b.z};
            const Edge back{b.x, b.y, b.z, a.x, a.y, a.z};
            edges_[std::min(there, back)].emplace_back(face, there < back ? 1 : -1);
        }
    }

    // The end of a ray.
    [[nodiscard]] bool is_seen(const Ray& ray) const {
        return std::ranges::none_of(faces_, [&](const Face& face) {
            const std::optional<double> t = face.receives ? hit(face, ray) : std::nullopt;
            return t && *t > 0.0 && *t < 1.0 - 1e-9;
        });
    }

    // By three signed volumes, not by Möller and Trumbore.
    static std::optional<double> hit(const Face& face, const Ray& ray) {
        const glm::dvec3 a = face.corners[0] - ray.from;
        const glm::dvec3 b = face.corners[1] - ray.from;
        const glm::dvec3 c = face.corners[2] - ray.from;
        const double u = glm::dot(glm::cross(b, c), ray.along);
        const double v = glm::dot(glm::cross(c, a), ray.along);
        const double w = glm::dot(glm::cross(a, b), ray.along);
        if (!((u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0))) {
            return std::nullopt;
        }
        const double sum = u + v + w;
        if (sum == 0.0) return std::nullopt;
        const glm::dvec3 place = (u * a + v * b + w * c) / sum;
        return glm::dot(place, ray.along) / glm::dot(ray.along, ray.along);
    }
};

}  // namespace gnomon::truth
