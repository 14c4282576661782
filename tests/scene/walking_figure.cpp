// SPDX-License-Identifier: MIT
#include "tests/scene/walking_figure.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace gnomon::scene::test {
namespace {

constexpr std::size_t around = 10;
constexpr std::size_t along = 8;

struct Joint {
    const char* name;
    glm::vec3 place;  // in the world, as it is bound
    int parent;
};
constexpr std::array<Joint, 9> joints{{{"hips", {0.0F, 1.0F, 0.0F}, -1},
                                       {"left thigh", {0.13F, 0.95F, 0.0F}, 0},
                                       {"left knee", {0.13F, 0.5F, 0.0F}, 1},
                                       {"right thigh", {-0.13F, 0.95F, 0.0F}, 0},
                                       {"right knee", {-0.13F, 0.5F, 0.0F}, 3},
                                       {"left shoulder", {0.33F, 1.42F, 0.0F}, 0},
                                       {"left elbow", {0.33F, 1.12F, 0.0F}, 5},
                                       {"right shoulder", {-0.33F, 1.42F, 0.0F}, 0},
                                       {"right elbow", {-0.33F, 1.12F, 0.0F}, 7}}};

struct FigureMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> deltas;
    std::vector<std::uint8_t> joints;
    std::vector<float> weights;
    std::vector<std::uint16_t> indices;

    std::uint16_t add(const glm::vec3& p, const glm::vec3& n, int upper, int lower, float bend,
                      const glm::vec3& delta) {
        positions.push_back(p);
        normals.push_back(n);
        deltas.push_back(delta);
        joints.insert(joints.end(),
                      {static_cast<std::uint8_t>(upper), static_cast<std::uint8_t>(lower), 0, 0});
        weights.insert(weights.end(), {1.0F - bend, bend, 0.0F, 0.0F});
        return static_cast<std::uint16_t>(positions.size() - 1);
    }

    /// A closed upright tube from `top` down, which bends in its middle from one joint to the next.
    void limb(const glm::vec3& top, float length, const glm::vec2& radii, int upper, int lower,
              float chest = 0.0F) {
        const auto ring_point = [&](std::size_t ring, std::size_t s) {
            // The last vertex of a ring is at the place of the first, to the bit.
            const double angle =
                2.0 * std::numbers::pi * static_cast<double>(s % around) / double{around};
            const glm::vec3 out(std::sin(angle), 0.0, std::cos(angle));
            const float t = static_cast<float>(ring) / float{along};
            const float bulge = 0.75F + std::sin(t * 3.14159F) * 0.25F;
            const glm::vec3 at(out.x * radii.x * bulge, -t * length, out.z * radii.y * bulge);
            return std::pair(top + at, out);
        };
        const auto bend = [](std::size_t ring) {
            return glm::clamp((static_cast<float>(ring) / float{along} - 0.35F) / 0.3F, 0.0F, 1.0F);
        };
        const auto delta = [&](std::size_t ring, const glm::vec3& out) {
            const float t = static_cast<float>(ring) / float{along};
            return chest * std::max(0.0F, 1.0F - 4.0F * std::abs(t - 0.3F)) * out;
        };
        std::array<std::array<std::uint16_t, around + 1>, along + 1> ring_vertices{};
        for (std::size_t ring = 0; ring <= along; ++ring) {
            for (std::size_t s = 0; s <= around; ++s) {
                const auto [p, out] = ring_point(ring, s);
                ring_vertices[ring][s] = add(p, out, upper, lower, bend(ring), delta(ring, out));
            }
        }
        const auto triangle = [&](std::uint16_t a, std::uint16_t b, std::uint16_t c) {
            indices.insert(indices.end(), {a, b, c});
        };
        for (std::size_t ring = 0; ring < along; ++ring) {
            for (std::size_t s = 0; s < around; ++s) {
                const auto& upper_ring = ring_vertices[ring];
                const auto& lower_ring = ring_vertices[ring + 1];
                triangle(upper_ring[s], lower_ring[s], lower_ring[s + 1]);
                triangle(upper_ring[s], lower_ring[s + 1], upper_ring[s + 1]);
            }
        }
        for (const std::size_t ring : {std::size_t{0}, along}) {
            const glm::vec3 out(0.0F, ring == 0 ? 1.0F : -1.0F, 0.0F);
            const glm::vec3 middle = top - glm::vec3(0.0F, ring == 0 ? 0.0F : length, 0.0F);
            const std::uint16_t center = add(middle, out, upper, lower, bend(ring), {});
            std::array<std::uint16_t, around + 1> rim{};
            for (std::size_t s = 0; s <= around; ++s) {
                const auto [p, radial] = ring_point(ring, s);
                rim[s] = add(p, out, upper, lower, bend(ring), delta(ring, radial));
            }
            for (std::size_t s = 0; s < around; ++s) {
                if (ring == 0) {
                    triangle(center, rim[s], rim[s + 1]);
                } else {
                    triangle(center, rim[s + 1], rim[s]);
                }
            }
        }
    }
};

FigureMesh make_mesh() {
    FigureMesh mesh;
    mesh.limb({0.0F, 1.5F, 0.0F}, 0.6F, {0.28F, 0.17F}, 0, 0, 0.08F);
    mesh.limb({0.0F, 1.75F, 0.0F}, 0.22F, {0.11F, 0.12F}, 0, 0);
    for (const int thigh : {1, 3}) {
        mesh.limb(joints[static_cast<std::size_t>(thigh)].place + glm::vec3(0, 0.02F, 0), 0.96F,
                  {0.11F, 0.12F}, thigh, thigh + 1);
    }
    for (const int shoulder : {5, 7}) {
        mesh.limb(joints[static_cast<std::size_t>(shoulder)].place + glm::vec3(0, 0.03F, 0), 0.64F,
                  {0.07F, 0.08F}, shoulder, shoulder + 1);
    }
    return mesh;
}

/// A turn about x: how a leg swings.
std::array<float, 4> swung(float angle_rad) {
    return {std::sin(angle_rad / 2), 0.0F, 0.0F, std::cos(angle_rad / 2)};
}

class Walk {
public:
    Walk(GltfBuilder& file, const std::vector<std::size_t>& nodes)
        : file_(file), nodes_(nodes), times_(file.accessor_of(key_times(), f32, "SCALAR", 1)) {}

    void swing(std::size_t joint, float amount_rad) {
        std::vector<float> values;
        for (const float t : key_times()) put(values, swung(amount_rad * std::sin(t * turn)));
        add(joint, "rotation", "LINEAR", file_.accessor_of(values, f32, "VEC4", 4));
    }
    /// Knees and elbows bend one way only, along a spline with level tangents.
    void fold(std::size_t joint, float amount_rad, float phase) {
        std::vector<float> values;
        for (const float t : key_times()) {
            put(values, {0, 0, 0, 0});
            put(values, swung(amount_rad * (0.5F + 0.5F * std::sin(t * turn + phase))));
            put(values, {0, 0, 0, 0});
        }
        add(joint, "rotation", "CUBICSPLINE", file_.accessor_of(values, f32, "VEC4", 4));
    }
    void go(float distance_m) {
        std::vector<float> values;
        for (const float t : key_times()) {
            values.insert(values.end(),
                          {0.0F, 1.0F + 0.02F * std::cos(2 * t * turn), (t - 0.5F) * distance_m});
        }
        add(0, "translation", "LINEAR", file_.accessor_of(values, f32, "VEC3", 3));
    }
    void grow() {
        const std::vector<float> values{1, 1, 1, 1.02F, 1.05F, 1,     1, 1,
                                        1, 1, 1, 1,     1.02F, 1.05F, 1};
        add(0, "scale", "STEP", file_.accessor_of(values, f32, "VEC3", 3));
    }
    void breathe(std::size_t node) {
        const std::vector<float> values{0, 0.5F, 1, 0.5F, 0};
        add_to(node, "weights", "LINEAR", file_.accessor_of(values, f32, "SCALAR", 1));
    }
    Json take() { return {{"name", "walk"}, {"samplers", samplers_}, {"channels", channels_}}; }

private:
    static constexpr float turn = 6.2831853F;
    static std::vector<float> key_times() { return {0.0F, 0.25F, 0.5F, 0.75F, 1.0F}; }
    static void put(std::vector<float>& values, const std::array<float, 4>& four) {
        values.insert(values.end(), four.begin(), four.end());
    }
    void add(std::size_t joint, const char* path, const char* mode, std::size_t output) {
        add_to(nodes_[joint], path, mode, output);
    }
    void add_to(std::size_t node, const char* path, const char* mode, std::size_t output) {
        channels_.push_back(
            {{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
        samplers_.push_back({{"input", times_}, {"output", output}, {"interpolation", mode}});
    }

    GltfBuilder& file_;
    const std::vector<std::size_t>& nodes_;
    std::size_t times_;
    Json samplers_ = Json::array();
    Json channels_ = Json::array();
};

}  // namespace

GltfBuilder walking_figure() {
    GltfBuilder file;
    const FigureMesh mesh = make_mesh();
    const std::size_t deltas = file.positions(mesh.deltas);
    file.mesh({{"attributes",
                {{"POSITION", file.positions(mesh.positions)},
                 {"NORMAL", file.positions(mesh.normals)},
                 {"JOINTS_0", file.accessor_of(mesh.joints, u8, "VEC4", 4)},
                 {"WEIGHTS_0", file.accessor_of(mesh.weights, f32, "VEC4", 4)}}},
               {"indices", file.indices(mesh.indices)},
               {"targets", Json::array({{{"POSITION", deltas}}})}});

    std::vector<std::size_t> nodes;
    std::vector<float> bind;
    for (const Joint& joint : joints) {
        glm::vec3 local = joint.place;
        if (joint.parent >= 0) local -= joints[static_cast<std::size_t>(joint.parent)].place;
        const Json members{{"name", joint.name}, {"translation", {local.x, local.y, local.z}}};
        nodes.push_back(joint.parent < 0 ? file.root(members) : file.node(members));
        if (joint.parent >= 0) {
            const std::size_t parent = nodes[static_cast<std::size_t>(joint.parent)];
            file.json["nodes"][parent]["children"].push_back(nodes.back());
        }
        bind.insert(bind.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -joint.place.x, -joint.place.y,
                                 -joint.place.z, 1});
    }
    file.json["skins"] = {
        {{"joints", nodes}, {"inverseBindMatrices", file.accessor_of(bind, f32, "MAT4", 16)}}};
    const std::size_t body = file.root({{"name", "figure"}, {"mesh", 0}, {"skin", 0}});

    Walk walk(file, nodes);
    walk.go(1.2F);
    walk.grow();
    walk.swing(1, -0.6F);
    walk.fold(2, 0.9F, 1.6F);
    walk.swing(3, 0.6F);
    walk.fold(4, 0.9F, -1.6F);
    walk.swing(5, 0.5F);
    walk.fold(6, -0.8F, 0.0F);
    walk.swing(7, -0.5F);
    walk.fold(8, -0.8F, 3.1F);
    walk.breathe(body);
    file.json["animations"] = Json::array({walk.take()});
    return file;
}

}  // namespace gnomon::scene::test
