// SPDX-License-Identifier: MIT
#include "internal/walker.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <gnomon/core/expects.hpp>

#include "internal/compose.hpp"

namespace gnomon::scene::internal {
namespace {

constexpr double full_circle = 2.0 * std::numbers::pi;

enum WalkerJoint : std::uint8_t {
    Pelvis,
    Chest,
    Head,
    LeftHip,
    LeftKnee,
    LeftAnkle,
    LeftToes,
    RightHip,
    RightKnee,
    RightAnkle,
    RightToes,
    LeftShoulder,
    LeftElbow,
    LeftWrist,
    RightShoulder,
    RightElbow,
    RightWrist,
    WalkerJointCount
};

struct WalkerBone {
    const char* name;
    int parent;
    glm::dvec3 place;  // where the mesh is bound, in the figure's space
};
constexpr double thigh_m = 0.43;
constexpr double shin_m = 0.41;
constexpr double ankle_height_m = 0.085;
constexpr double hip_height_m = thigh_m + shin_m + ankle_height_m;
constexpr double knee_height_m = shin_m + ankle_height_m;
constexpr double ball_m = 0.125;   // of the foot, before the ankle
constexpr double heel_m = -0.055;  // behind it
constexpr double ball_height_m = 0.025;

constexpr std::array<WalkerBone, WalkerJointCount> bones{{
    {"pelvis", -1, {0.0, 0.98, 0.0}},
    {"chest", Pelvis, {0.0, 1.12, 0.0}},
    {"head", Chest, {0.0, 1.5, 0.0}},
    {"left hip", Pelvis, {0.09, hip_height_m, 0.0}},
    {"left knee", LeftHip, {0.09, knee_height_m, 0.0}},
    {"left ankle", LeftKnee, {0.09, ankle_height_m, 0.0}},
    {"left toes", LeftAnkle, {0.09, ball_height_m, ball_m}},
    {"right hip", Pelvis, {-0.09, hip_height_m, 0.0}},
    {"right knee", RightHip, {-0.09, knee_height_m, 0.0}},
    {"right ankle", RightKnee, {-0.09, ankle_height_m, 0.0}},
    {"right toes", RightAnkle, {-0.09, ball_height_m, ball_m}},
    {"left shoulder", Chest, {0.195, 1.41, 0.0}},
    {"left elbow", LeftShoulder, {0.225, 1.12, 0.0}},
    {"left wrist", LeftElbow, {0.235, 0.87, 0.0}},
    {"right shoulder", Chest, {-0.195, 1.41, 0.0}},
    {"right elbow", RightShoulder, {-0.225, 1.12, 0.0}},
    {"right wrist", RightElbow, {-0.235, 0.87, 0.0}},
}};

// --- the mesh -----------------------------------------------------------------------------------

/// A cross-section of a limb: an ellipse about `center`, half as wide in x as `across` says, and
/// in the limb's other direction `deep`. `bend` is how far the lower joint has taken over.
struct Section {
    glm::dvec3 center;
    double across;
    double deep;
    double bend;
};

Section between(const std::array<Section, 4>& s, double t) {
    // Catmull-Rom: through s[1] at 0 and s[2] at 1.
    const auto smooth = [t](auto a, auto b, auto c, auto d) {
        return 0.5 * (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) +
                      t * t * t * (3.0 * b - a - 3.0 * c + d));
    };
    return {smooth(s[0].center, s[1].center, s[2].center, s[3].center),
            smooth(s[0].across, s[1].across, s[2].across, s[3].across),
            smooth(s[0].deep, s[1].deep, s[2].deep, s[3].deep),
            glm::clamp(smooth(s[0].bend, s[1].bend, s[2].bend, s[3].bend), 0.0, 1.0)};
}

class WalkerMesh {
public:
    /// A closed tube through the sections. A limb that hangs has `deep_along` +Z, a foot +Y; the
    /// ends are drawn together to points.
    void limb(const std::vector<Section>& sections, WalkerJoint upper, WalkerJoint lower,
              const glm::dvec3& deep_along = {0.0, 0.0, 1.0}) {
        constexpr std::uint32_t round = 24;
        constexpr int steps = 4;  // from one section to the next
        std::vector<Section> rings;
        const auto at = [&](std::size_t i) { return sections[std::min(i, sections.size() - 1)]; };
        for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
            const std::array<Section, 4> four{at(i == 0 ? 0 : i - 1), at(i), at(i + 1), at(i + 2)};
            for (int k = 0; k < steps; ++k) {
                rings.push_back(between(four, static_cast<double>(k) / steps));
            }
        }
        rings.push_back(sections.back());

        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const auto ring_vertex = [&](std::size_t ring, std::uint32_t s) {
            return first + 1 + static_cast<std::uint32_t>(ring - 1) * round + s % round;
        };
        const std::size_t last = rings.size() - 1;
        add(rings.front().center, rings.front().bend, upper, lower);
        for (std::size_t ring = 1; ring < last; ++ring) {
            const Section& section = rings[ring];
            for (std::uint32_t s = 0; s < round; ++s) {
                const double angle = full_circle * s / round;
                glm::dvec3 p = section.center +
                               glm::dvec3(section.across * std::cos(angle), 0.0, 0.0) +
                               section.deep * std::sin(angle) * deep_along;
                p.y = std::max(p.y, sole_m);
                add(p, section.bend, upper, lower);
            }
        }
        add(rings.back().center, rings.back().bend, upper, lower);
        const auto end = static_cast<std::uint32_t>(mesh.positions.size()) - 1;

        const std::size_t first_index = mesh.indices.size();
        for (std::uint32_t s = 0; s < round; ++s) {
            triangle(first, ring_vertex(1, s), ring_vertex(1, s + 1));
            for (std::size_t ring = 1; ring + 1 < last; ++ring) {
                const std::uint32_t a = ring_vertex(ring, s);
                const std::uint32_t b = ring_vertex(ring, s + 1);
                triangle(a, ring_vertex(ring + 1, s), ring_vertex(ring + 1, s + 1));
                triangle(a, ring_vertex(ring + 1, s + 1), b);
            }
            triangle(ring_vertex(last - 1, s + 1), ring_vertex(last - 1, s), end);
        }
        if (volume_from(first_index) < 0.0) turn_over_from(first_index);
    }

    std::shared_ptr<const Mesh> finish(std::uint32_t material) {
        mesh.name = "walker";
        mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0F));
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto [a, b, c] = corners(i);
            const glm::vec3 normal = glm::cross(b - a, c - a);  // long where the face is large
            for (std::size_t k = 0; k < 3; ++k) mesh.normals[mesh.indices[i + k]] += normal;
        }
        for (glm::vec3& normal : mesh.normals) normal = glm::normalize(normal);
        mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), material}};
        source.influences_per_vertex = 2;
        auto deformation = make_mesh_deformation(mesh, std::move(source));
        GNOMON_EXPECTS(deformation.has_value());
        mesh.deformation = *std::move(deformation);
        return std::make_shared<const Mesh>(std::move(mesh));
    }

private:
    static constexpr double sole_m = 0.002;  // feet do not lie in the ground's plane

    void add(const glm::dvec3& p, double bend, WalkerJoint upper, WalkerJoint lower) {
        mesh.positions.emplace_back(p);
        source.joints.insert(source.joints.end(), {upper, lower});
        const auto weight = static_cast<float>(bend);
        source.weights.insert(source.weights.end(), {1.0F - weight, weight});
    }
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    }
    [[nodiscard]] std::array<glm::vec3, 3> corners(std::size_t index) const {
        return {mesh.positions[mesh.indices[index]], mesh.positions[mesh.indices[index + 1]],
                mesh.positions[mesh.indices[index + 2]]};
    }
    [[nodiscard]] double volume_from(std::size_t first_index) const {
        double volume = 0.0;
        for (std::size_t i = first_index; i < mesh.indices.size(); i += 3) {
            const auto [a, b, c] = corners(i);
            volume += glm::dot(glm::dvec3(a), glm::cross(glm::dvec3(b), glm::dvec3(c)));
        }
        return volume;
    }
    void turn_over_from(std::size_t first_index) {
        for (std::size_t i = first_index; i < mesh.indices.size(); i += 3) {
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
        }
    }

    Mesh mesh;
    MeshDeformationSource source;
};

void add_leg(WalkerMesh& mesh, double x, WalkerJoint hip) {
    const auto knee = static_cast<WalkerJoint>(hip + 1);
    const auto ankle = static_cast<WalkerJoint>(hip + 2);
    const auto toes = static_cast<WalkerJoint>(hip + 3);
    const auto at = [x](double inwards, double y, double z) {
        return glm::dvec3(x > 0 ? x - inwards : x + inwards, y, z);
    };
    mesh.limb({{at(0.0, 0.99, 0.0), 0.0, 0.0, 0.0},
               {at(0.0, 0.965, 0.0), 0.062, 0.066, 0.0},
               {at(0.0, 0.88, 0.0), 0.083, 0.092, 0.0},
               {at(0.0, 0.76, 0.006), 0.078, 0.086, 0.0},
               {at(0.0, 0.62, 0.008), 0.060, 0.066, 0.0},
               {at(0.0, 0.54, 0.006), 0.051, 0.056, 0.15},
               {at(0.0, 0.495, 0.004), 0.049, 0.054, 0.5},
               {at(0.0, 0.45, 0.0), 0.047, 0.051, 0.85},
               {at(0.0, 0.36, -0.012), 0.051, 0.056, 1.0},
               {at(0.0, 0.24, -0.010), 0.041, 0.044, 1.0},
               {at(0.0, 0.12, -0.002), 0.030, 0.033, 1.0},
               {at(0.0, 0.07, 0.0), 0.030, 0.033, 1.0},
               {at(0.0, 0.05, 0.0), 0.0, 0.0, 1.0}},
              hip, knee);
    mesh.limb({{at(0.0, 0.035, -0.07), 0.0, 0.0, 0.0},
               {at(0.0, 0.035, -0.062), 0.024, 0.030, 0.0},
               {at(0.0, 0.040, -0.035), 0.033, 0.042, 0.0},
               {at(0.0, 0.045, 0.01), 0.035, 0.050, 0.0},
               {at(0.0, 0.036, 0.06), 0.037, 0.038, 0.0},
               {at(0.0, 0.026, 0.11), 0.043, 0.026, 0.25},
               {at(0.0, 0.022, 0.145), 0.043, 0.020, 0.8},
               {at(0.0, 0.018, 0.18), 0.034, 0.016, 1.0},
               {at(0.0, 0.016, 0.2), 0.0, 0.0, 1.0}},
              ankle, toes, {0.0, 1.0, 0.0});
}

void add_arm(WalkerMesh& mesh, double side, WalkerJoint shoulder) {
    const auto elbow = static_cast<WalkerJoint>(shoulder + 1);
    const auto wrist = static_cast<WalkerJoint>(shoulder + 2);
    const auto at = [side](double x, double y, double z) { return glm::dvec3(side * x, y, z); };
    mesh.limb({{at(0.185, 1.465, 0.0), 0.0, 0.0, 0.0},
               {at(0.19, 1.45, 0.0), 0.040, 0.042, 0.0},
               {at(0.197, 1.40, 0.0), 0.052, 0.056, 0.0},
               {at(0.207, 1.30, 0.0), 0.044, 0.050, 0.0},
               {at(0.219, 1.18, 0.0), 0.037, 0.041, 0.1},
               {at(0.225, 1.12, 0.0), 0.036, 0.039, 0.5},
               {at(0.228, 1.06, 0.0), 0.037, 0.040, 0.9},
               {at(0.231, 0.98, 0.0), 0.033, 0.036, 1.0},
               {at(0.235, 0.88, 0.0), 0.024, 0.028, 1.0},
               {at(0.235, 0.86, 0.0), 0.0, 0.0, 1.0}},
              shoulder, elbow);
    mesh.limb({{at(0.235, 0.895, 0.0), 0.0, 0.0, 1.0},
               {at(0.235, 0.885, 0.0), 0.019, 0.025, 1.0},
               {at(0.236, 0.83, 0.004), 0.022, 0.040, 1.0},
               {at(0.234, 0.77, 0.008), 0.018, 0.034, 1.0},
               {at(0.230, 0.72, 0.010), 0.012, 0.018, 1.0},
               {at(0.229, 0.71, 0.010), 0.0, 0.0, 1.0}},
              elbow, wrist);
}

// --- the gait -----------------------------------------------------------------------------------

using Rotations = std::array<double, WalkerJointCount>;  // about x, in radians; forward is negative

struct Stance {
    double hip_height_m = 0.0;
    Rotations swing{};
    double chest_turn_rad = 0.0;  // about y
};

double mix(double a, double b, double t) { return a + (b - a) * t; }
double ease(double t) {
    t = glm::clamp(t, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// Of a foot: the ankle, seen from below the hip, and how far the toes point down.
struct Foot {
    double forward_m = 0.0;
    double height_m = 0.0;
    double pitch_rad = 0.0;
    double toes_rad = 0.0;  // bent up, against the foot
};

constexpr double lift_off = 0.62;      // the share of a cycle in which a foot carries
constexpr double under_the_hip = 0.3;  // when a foot that stands flat is below its hip
constexpr double strike_rad = -0.36;
constexpr double push_rad = 0.95;

/// A foot that carries: it rolls over the heel, stands, and rolls over the ball.
Foot carrying_foot(double phase) {
    const double ankle_m = walker_stride_m * (under_the_hip - phase);  // if it stood flat
    Foot foot;
    double pivot_m = ball_m;
    double pivot_height_m = ball_height_m;
    if (phase < 0.12) {
        foot.pitch_rad = strike_rad * (1.0 - ease(phase / 0.12));
        pivot_m = heel_m;
        pivot_height_m = 0.0;
    } else if (phase > 0.34) {
        const double share = (phase - 0.34) / (lift_off - 0.34);
        foot.pitch_rad = push_rad * share * share;
        foot.toes_rad = foot.pitch_rad;
    }
    const double s = std::sin(foot.pitch_rad);
    const double c = std::cos(foot.pitch_rad);
    const double up_m = ankle_height_m - pivot_height_m;
    foot.forward_m = ankle_m + pivot_m - c * pivot_m + s * up_m;
    foot.height_m = pivot_height_m + s * pivot_m + c * up_m;
    return foot;
}

Foot foot_at(double phase) {
    phase -= std::floor(phase);
    if (phase <= lift_off) return carrying_foot(phase);
    const Foot from = carrying_foot(lift_off);
    const Foot to = carrying_foot(0.0);
    const double share = (phase - lift_off) / (1.0 - lift_off);
    const double t = ease(share);
    // Through the middle it is lifted a little, and bends from toes down to toes up.
    return {mix(from.forward_m, to.forward_m, t),
            mix(from.height_m, to.height_m, share) + 0.055 * std::sin(std::numbers::pi * share),
            mix(from.pitch_rad, to.pitch_rad, ease(1.35 * share)),
            from.toes_rad * (1.0 - ease(3.0 * share))};
}

/// The leg that puts the ankle there: knee forward.
void bend_leg(Stance& stance, const Foot& foot, WalkerJoint hip) {
    const double down_m = stance.hip_height_m - foot.height_m;
    const double reach_m =
        std::min(std::hypot(foot.forward_m, down_m), 0.9999 * (thigh_m + shin_m));
    const auto angle = [](double opposite, double a, double b) {
        return std::acos(
            glm::clamp((a * a + b * b - opposite * opposite) / (2.0 * a * b), -1.0, 1.0));
    };
    const double towards_foot = std::atan2(foot.forward_m, down_m);
    const double thigh = towards_foot + angle(shin_m, thigh_m, reach_m);
    const double knee = std::numbers::pi - angle(reach_m, thigh_m, shin_m);
    stance.swing[hip] = -thigh;
    stance.swing[hip + 1U] = knee;
    stance.swing[hip + 2U] = foot.pitch_rad - (knee - thigh);
    stance.swing[hip + 3U] = -foot.toes_rad;
}

Stance stance_at(double phase) {
    Stance stance;
    // Highest over a leg that stands, lowest while both carry.
    stance.hip_height_m = 0.896 + 0.024 * std::cos(2.0 * full_circle * (phase - under_the_hip));
    bend_leg(stance, foot_at(phase), LeftHip);
    bend_leg(stance, foot_at(phase + 0.5), RightHip);
    const double arms = std::cos(full_circle * (phase - 0.02));  // the right one is in front at 0
    stance.swing[Chest] = 0.05;
    stance.swing[Head] = -0.02;
    stance.chest_turn_rad = 0.13 * arms;
    stance.swing[RightShoulder] = -0.08 - 0.46 * arms;
    stance.swing[LeftShoulder] = -0.08 + 0.46 * arms;
    stance.swing[RightElbow] = -0.34 - 0.22 * arms;
    stance.swing[LeftElbow] = -0.34 + 0.22 * arms;
    return stance;
}

glm::dquat rotation_of(const Stance& stance, std::size_t joint) {
    const glm::dquat swing = glm::angleAxis(stance.swing[joint], glm::dvec3(1.0, 0.0, 0.0));
    if (joint == Chest || joint == Head) {
        const double turn = joint == Chest ? stance.chest_turn_rad : -stance.chest_turn_rad;
        return glm::angleAxis(turn, glm::dvec3(0.0, 1.0, 0.0)) * swing;
    }
    return swing;
}

glm::dvec3 pelvis_place(const Stance& stance, double cycles) {
    return {0.0, bones[Pelvis].place.y - hip_height_m + stance.hip_height_m,
            walker_stride_m * cycles};
}

}  // namespace

std::shared_ptr<const Mesh> make_walker_mesh(std::uint32_t material) {
    WalkerMesh mesh;
    mesh.limb({{{0.0, 0.86, 0.0}, 0.0, 0.0, 0.0},
               {{0.0, 0.875, 0.0}, 0.075, 0.062, 0.0},
               {{0.0, 0.92, -0.004}, 0.142, 0.098, 0.0},
               {{0.0, 0.98, -0.004}, 0.152, 0.103, 0.0},
               {{0.0, 1.07, 0.0}, 0.128, 0.088, 0.3},
               {{0.0, 1.15, 0.002}, 0.122, 0.084, 0.7},
               {{0.0, 1.26, 0.006}, 0.148, 0.100, 1.0},
               {{0.0, 1.36, 0.004}, 0.166, 0.103, 1.0},
               {{0.0, 1.43, -0.004}, 0.150, 0.082, 1.0},
               {{0.0, 1.475, -0.008}, 0.082, 0.060, 1.0},
               {{0.0, 1.49, -0.008}, 0.0, 0.0, 1.0}},
              Pelvis, Chest);
    mesh.limb({{{0.0, 1.44, -0.006}, 0.0, 0.0, 0.0},
               {{0.0, 1.45, -0.006}, 0.05, 0.05, 0.0},
               {{0.0, 1.50, -0.002}, 0.046, 0.048, 0.2},
               {{0.0, 1.56, 0.006}, 0.046, 0.050, 1.0},
               {{0.0, 1.59, 0.008}, 0.0, 0.0, 1.0}},
              Chest, Head);
    mesh.limb({{{0.0, 1.525, 0.035}, 0.0, 0.0, 1.0},
               {{0.0, 1.535, 0.032}, 0.036, 0.036, 1.0},
               {{0.0, 1.58, 0.022}, 0.062, 0.074, 1.0},
               {{0.0, 1.65, 0.014}, 0.075, 0.094, 1.0},
               {{0.0, 1.71, 0.008}, 0.070, 0.088, 1.0},
               {{0.0, 1.755, 0.002}, 0.038, 0.048, 1.0},
               {{0.0, 1.765, 0.0}, 0.0, 0.0, 1.0}},
              Chest, Head);
    for (const WalkerJoint hip : {LeftHip, RightHip}) add_leg(mesh, bones[hip].place.x, hip);
    add_arm(mesh, 1.0, LeftShoulder);
    add_arm(mesh, -1.0, RightShoulder);
    return mesh.finish(material);
}

void add_walker(Scene& scene, const std::string& name, const std::shared_ptr<const Mesh>& mesh,
                const LocalTransform& local, double cycles, Animation& animation,
                std::vector<AnimationSampler>& samplers) {
    constexpr int keys = 48;
    const Entity figure = scene.create_node(name, local);
    const Stance first = stance_at(cycles);
    Skin skin;
    std::vector<glm::dmat4> inverse_bind;
    for (std::size_t joint = 0; joint < bones.size(); ++joint) {
        const WalkerBone& bone = bones[joint];
        const bool root = bone.parent < 0;
        const glm::dvec3 offset =
            root ? pelvis_place(first, cycles)
                 : bone.place - bones[static_cast<std::size_t>(bone.parent)].place;
        const Entity parent = root ? figure : skin.joints[static_cast<std::size_t>(bone.parent)];
        skin.joints.push_back(
            scene.create_node(name + " " + bone.name,
                              {offset, rotation_of(first, joint), glm::dvec3(1.0), {}}, parent));
        glm::dmat4 inverse(1.0);
        inverse[3] = glm::dvec4(-bone.place, 1.0);
        inverse_bind.push_back(inverse);
    }

    std::vector<float> times_s;
    for (int key = 0; key <= keys; ++key) {
        times_s.push_back(static_cast<float>(walker_cycle_s * key / keys));
    }
    const auto add_channel = [&](std::size_t joint, AnimationPath path, std::size_t width,
                                 const auto& value_at) {
        AnimationSampler sampler{Interpolation::Linear, times_s, width, {}};
        for (int key = 0; key <= keys; ++key) {
            const double at = cycles + static_cast<double>(key) / keys;
            for (const double number : value_at(stance_at(at), at)) {
                sampler.values.push_back(static_cast<float>(number));
            }
        }
        animation.channels.push_back(
            {skin.joints[joint], path, static_cast<std::uint32_t>(samplers.size())});
        samplers.push_back(std::move(sampler));
    };
    add_channel(Pelvis, AnimationPath::Translation, 3, [](const Stance& stance, double at) {
        const glm::dvec3 p = pelvis_place(stance, at);
        return std::array{p.x, p.y, p.z};
    });
    for (std::size_t joint = Chest; joint < bones.size(); ++joint) {
        add_channel(joint, AnimationPath::Rotation, 4, [joint](const Stance& stance, double) {
            const glm::dquat q = rotation_of(stance, joint);
            return std::array{q.x, q.y, q.z, q.w};
        });
    }
    animation.duration_s = times_s.back();
    skin.inverse_bind_matrices =
        std::make_shared<const std::vector<glm::dmat4>>(std::move(inverse_bind));
    const Entity body = add_instance(scene, name + " body", mesh, {}, figure);
    scene.registry.emplace<Skin>(body, std::move(skin));
}

}  // namespace gnomon::scene::internal
