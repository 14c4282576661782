// SPDX-License-Identifier: MIT
//
// Skins and morphs against an evaluation written the plain way, bits that stay, identities, far
// places, and the shadow meshes that are made of it all.
#include <gnomon/scene/deform.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>

#include "tests/scene/walking_figure.hpp"

namespace gnomon::scene::test {
namespace {

using testing::HasSubstr;

Scene must_load(const GltfBuilder& file) {
    auto scene = file.load();
    EXPECT_TRUE(scene) << scene.error().message;
    return std::move(*scene);
}

void pose(Scene& scene, double time_s) {
    ASSERT_TRUE(animate(scene, 0, time_s));
    update_world_transforms(scene.registry);
    const Status deformed = deform(scene);
    ASSERT_TRUE(deformed) << deformed.error().message;
}

Entity deforming(const Scene& scene) {
    Entity found;
    scene.registry.each<MeshInstance>([&](Entity entity, const MeshInstance& instance) {
        if (instance.mesh->deformation) found = entity;
    });
    return found;
}

const Deformed& deformed_of(const Scene& scene) {
    return scene.registry.get<Deformed>(deforming(scene));
}

glm::dvec3 true_position(const Deformed& deformed, std::size_t v) {
    return deformed.origin + glm::dvec3(deformed.positions[v]);
}

/// glTF's words, one vertex at a time: morph, then the weighted sum of what each joint makes of it.
glm::dvec3 plain_position(const Scene& scene, Entity entity, std::size_t v) {
    const Mesh& mesh = *scene.registry.get<MeshInstance>(entity).mesh;
    const MeshDeformation& deformation = *mesh.deformation;
    glm::dvec3 bound = mesh.origin + glm::dvec3(mesh.positions[v]);
    if (const auto* weights = scene.registry.try_get<MorphWeights>(entity)) {
        for (std::size_t t = 0; t < weights->values.size(); ++t) {
            bound += weights->values[t] * glm::dvec3(deformation.targets[t].positions[v]);
        }
    }
    const auto* skin = scene.registry.try_get<Skin>(entity);
    if (skin == nullptr) return bound;
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = deformation.first_influence[v]; i < deformation.first_influence[v + 1];
         ++i) {
        const Influence& influence = deformation.influences[i];
        const auto& joint = scene.registry.get<WorldTransform>(skin->joints[influence.joint]);
        const glm::dvec4 moved =
            joint.world_from_local *
            ((*skin->inverse_bind_matrices)[influence.joint] * glm::dvec4(bound, 1.0));
        sum += influence.weight * glm::dvec3(moved);
    }
    return sum;
}

TEST(Deform, the_figure_is_where_a_plain_evaluation_puts_it) {
    Scene scene = must_load(walking_figure());
    const Entity entity = deforming(scene);
    ASSERT_TRUE(scene.registry.has<Skin>(entity));
    for (const double time_s : {0.0, 0.2, 0.5, 0.9}) {
        pose(scene, time_s);
        const Deformed& deformed = deformed_of(scene);
        double moved = 0.0;
        for (std::size_t v = 0; v < deformed.positions.size(); ++v) {
            const glm::dvec3 expected = plain_position(scene, entity, v);
            ASSERT_LT(glm::length(true_position(deformed, v) - expected), 2e-7) << "vertex " << v;
            ASSERT_NEAR(glm::length(deformed.normals[v]), 1.0, 1e-6);
            moved =
                std::max(moved, glm::length(expected - glm::dvec3(deformed.mesh->positions[v])));
        }
        EXPECT_GT(moved, 0.2);
    }
}

TEST(Deform, normals_turn_with_their_surface) {
    Scene scene = must_load(walking_figure());
    pose(scene, 0.3);
    const Deformed& deformed = deformed_of(scene);
    const auto& indices = deformed.mesh->indices;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const auto p = [&](std::size_t k) { return true_position(deformed, indices[i + k]); };
        const glm::dvec3 face = glm::normalize(glm::cross(p(1) - p(0), p(2) - p(0)));
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_GT(glm::dot(face, glm::dvec3(deformed.normals[indices[i + k]])), 0.3);
        }
    }
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(Deform, the_same_inputs_give_the_same_bits_and_revisions_tell) {
    Scene scene = must_load(walking_figure());
    Scene other = must_load(walking_figure());
    pose(scene, 0.4);
    const Deformed first = deformed_of(scene);
    pose(scene, 0.4);
    EXPECT_EQ(deformed_of(scene).revision, first.revision);
    pose(scene, 1.4 + 1e-3);
    EXPECT_NE(deformed_of(scene).revision, first.revision);
    pose(scene, 0.4);
    EXPECT_TRUE(same_bytes(deformed_of(scene).positions, first.positions));
    for (const double time_s : {0.9, 0.1, 0.4}) pose(other, time_s);
    EXPECT_TRUE(same_bytes(deformed_of(other).positions, first.positions));
    EXPECT_TRUE(same_bytes(deformed_of(other).normals, first.normals));
    EXPECT_NE(deformed_of(other).revision, deformed_of(scene).revision);
}

TEST(Deform, inputs_that_change_no_number_keep_the_revision) {
    GltfBuilder file = triangle_file();
    const std::size_t still = file.positions({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    const std::size_t moves = file.positions({{0, 0, 1}, {0, 0, 2}, {0, 0, 4}});
    file.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", still}},
                                                          {{"POSITION", moves}}};
    Scene scene = must_load(file);
    auto& weights = scene.registry.get<MorphWeights>(deforming(scene));
    ASSERT_EQ(weights.values.size(), 2U);
    const std::uint64_t revision = deformed_of(scene).revision;
    weights.values[0] = 0.7;
    ASSERT_TRUE(deform(scene));
    EXPECT_EQ(deformed_of(scene).revision, revision);
    weights.values[1] = 0.5;
    ASSERT_TRUE(deform(scene));
    EXPECT_NE(deformed_of(scene).revision, revision);
    EXPECT_EQ(deformed_of(scene).positions[2], glm::vec3(0, 1, 2));
    // Without normals in the file they are those of the faces, in every pose.
    const glm::dvec3 expected =
        glm::normalize(glm::cross(glm::dvec3(1, 0, 0.5), glm::dvec3(0, 1, 1.5)));
    EXPECT_LT(glm::length(glm::dvec3(deformed_of(scene).normals[0]) - expected), 1e-6);
}

TEST(Deform, weights_of_the_node_go_before_those_of_the_mesh) {
    GltfBuilder file = triangle_file();
    const std::size_t up = file.positions({{0, 2, 0}, {0, 2, 0}, {0, 2, 0}});
    const std::size_t normal = file.positions({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
    const std::size_t leaning = file.positions({{1, 0, 0}, {1, 0, 0}, {1, 0, 0}});
    auto& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["NORMAL"] = normal;
    primitive["targets"] = {{{"POSITION", up}, {"NORMAL", leaning}}};
    file.json["meshes"][0]["weights"] = {0.5};
    Scene scene = must_load(file);
    EXPECT_EQ(deformed_of(scene).positions[0], glm::vec3(0, 1, 0));
    EXPECT_NEAR(deformed_of(scene).normals[0].x, 0.5 / std::sqrt(1.25), 1e-6);
    file.json["nodes"][0]["weights"] = {-1};
    scene = must_load(file);
    EXPECT_EQ(deformed_of(scene).positions[0], glm::vec3(0, -2, 0));
    EXPECT_EQ(world_bounds(scene).min.y, -2.0);
}

TEST(Deform, wrong_morphs_and_weights_are_named) {
    const auto refused = [](const char* pointer, const Json& value, const std::string& part) {
        GltfBuilder file = triangle_file();
        const std::size_t target = file.positions({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
        file.positions({{0, 0, 1}, {0, 0, 1}});
        file.positions({{0, 0, 1}, {0, std::nanf(""), 1}, {0, 0, 1}});
        file.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", target}}};
        file.json[Json::json_pointer(pointer)] = value;
        const auto scene = file.load();
        ASSERT_FALSE(scene) << pointer;
        EXPECT_THAT(scene.error().message, HasSubstr(part));
    };
    const char* target = "/meshes/0/primitives/0/targets/0/POSITION";
    refused(target, 3, "has 2 elements, but the primitive has 3 vertices");
    refused(target, 4, "targets[0]: POSITION 1 is (0, nan, 1), but must be finite");
    refused(target, 1, "must be VEC3");
    refused("/meshes/0/weights", {1, 2}, "meshes[0].weights is an array of 2");
    refused("/nodes/0/weights", Json::array(), "nodes[0].weights is an array of 0");
    Json second = triangle_file().json["meshes"][0]["primitives"][0];
    refused("/meshes/0/primitives/1", second, "primitives[1] has 0 morph targets");
}

TEST(Deform, weights_of_joints_are_brought_to_one_form) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, -0.0F, 0}, {0, 0, 0}};
    MeshDeformationSource source;
    source.influences_per_vertex = 3;
    source.joints = {1, 2, 9, 2, 1, 9, 1, 2, 1, 5, 5, 5, 1, 2, 0};
    source.weights = {1, 3, 0, 0.75F, 0.25F, 0, 0.5F, 3, 0.5F, 0, 0, 0, 1, 2, 0};
    const auto made = make_mesh_deformation(mesh, source);
    ASSERT_TRUE(made) << made.error().message;
    const MeshDeformation& d = **made;
    EXPECT_THAT(d.first_influence, testing::ElementsAre(0U, 2U, 4U, 6U, 7U, 9U));
    for (std::size_t v = 0; v < 3; ++v) {
        EXPECT_EQ(d.influences[2 * v], (Influence{1, 0.25})) << v;
        EXPECT_EQ(d.influences[2 * v + 1], (Influence{2, 0.75})) << v;
        EXPECT_EQ(d.identities[v], 0U);
    }
    EXPECT_EQ(d.influences[6], (Influence{0, 1.0}));
    EXPECT_NEAR(d.influences[7].weight + d.influences[8].weight, 1.0, 1e-15);
    EXPECT_EQ(d.joint_count, 3U);
    EXPECT_EQ(d.identities[3], 3U);
    EXPECT_EQ(d.identities[4], 4U);

    for (const float bad : {-0.5F, std::nanf(""), std::numeric_limits<float>::infinity()}) {
        source.weights[4] = bad;
        const auto refused = make_mesh_deformation(mesh, source);
        ASSERT_FALSE(refused);
        EXPECT_THAT(refused.error().message, HasSubstr("Weight 1 of vertex 1"));
    }
    source.weights.pop_back();
    EXPECT_FALSE(make_mesh_deformation(mesh, source));
}

TEST(Deform, far_figures_keep_their_shape) {
    GltfBuilder file = walking_figure();
    Scene near = must_load(file);
    pose(near, 0.3);
    // A root far away: the joints' product is beyond what a float tells apart.
    const Json root{{"name", "far"}, {"translation", {3e6, 0, -5e6}}, {"children", {0}}};
    const std::size_t node = file.node(root);
    file.json["scenes"][0]["nodes"][0] = node;
    Scene far = must_load(file);
    pose(far, 0.3);
    const Deformed& a = deformed_of(near);
    const Deformed& b = deformed_of(far);
    EXPECT_EQ(a.origin, glm::dvec3(0.0));
    EXPECT_GT(glm::length(b.origin), 1e6);
    for (std::size_t v = 0; v < a.positions.size(); ++v) {
        EXPECT_LT(glm::length(b.positions[v]), 4.0F);
        ASSERT_LT(glm::length(true_position(b, v) - glm::dvec3(3e6, 0, -5e6) - true_position(a, v)),
                  2e-6);
    }
}

TEST(Deform, a_model_that_is_moved_as_a_whole_does_not_deform) {
    Scene scene = must_load(walking_figure());
    const Entity entity = deforming(scene);
    const Entity root = scene.create_node("root");
    scene.registry.each<LocalTransform>([&](Entity node, const LocalTransform&) {
        if (node != root && !scene.registry.has<Parent>(node)) {
            scene.registry.emplace<Parent>(node, root);
        }
    });
    pose(scene, 0.6);
    const std::uint64_t revision = deformed_of(scene).revision;
    scene.registry.get<LocalTransform>(root).translation = {7.0, 8.0, 9.0};
    pose(scene, 0.6);
    EXPECT_EQ(deformed_of(scene).revision, revision);
    const Geometry geometry =
        geometry_of(scene.registry, entity, scene.registry.get<MeshInstance>(entity),
                    scene.registry.get<WorldTransform>(entity));
    EXPECT_EQ(geometry.revision, revision);
    const glm::dvec3 drawn(geometry.world_from_positions *
                           glm::dvec4(geometry.positions[100], 1.0));
    EXPECT_LT(glm::length(drawn - plain_position(scene, entity, 100)), 1e-6);
}

TEST(Deform, what_cannot_be_posed_keeps_its_pose_and_is_named) {
    Scene scene = must_load(walking_figure());
    const std::uint64_t revision = deformed_of(scene).revision;
    auto& hips = scene.registry.get<LocalTransform>(find_entity(scene, "hips"));
    hips.scale = glm::dvec3(1e300);
    Status status = deform(scene);
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().message, HasSubstr("Node \"figure\": its joints and weights move"));
    EXPECT_EQ(deformed_of(scene).revision, revision);
    hips.scale = glm::dvec3(1.0);
    scene.registry.get<MorphWeights>(deforming(scene)).values.push_back(1.0);
    EXPECT_THAT(deform(scene).error().message, HasSubstr("2 weights, but its mesh has 1 morph"));
    scene.registry.get<MorphWeights>(deforming(scene)).values.pop_back();
    ASSERT_TRUE(deform(scene));
    scene.registry.destroy(find_entity(scene, "left knee"));
    EXPECT_THAT(deform(scene).error().message, HasSubstr("joint 2 of its skin is gone"));
}

// ---------------------------------------------------------------------------------------------
// Shadow meshes

shadows::MeshReport report_of(ShadowAdapter& adapter, const Scene& scene) {
    const auto casters = adapter.casters(scene);
    EXPECT_TRUE(casters) << casters.error().message;
    EXPECT_EQ(casters->size(), 1U);
    return casters->front().mesh->report();
}

TEST(DeformedShadow, seams_stay_closed_in_every_pose) {
    Scene scene = must_load(walking_figure());
    ShadowAdapter adapter;
    const std::uint64_t welded = report_of(adapter, scene).welded_vertices;
    EXPECT_LT(welded, deformed_of(scene).positions.size());
    for (const double time_s : {0.0, 0.15, 0.35, 0.77}) {
        pose(scene, time_s);
        const shadows::MeshReport report = report_of(adapter, scene);
        EXPECT_TRUE(report.closed()) << time_s;
        EXPECT_EQ(report.components, 6U);
        EXPECT_EQ(report.welded_vertices, welded);
    }
}

TEST(DeformedShadow, the_shadow_mesh_has_the_very_positions_that_are_drawn) {
    Scene scene = must_load(walking_figure());
    pose(scene, 0.2);
    ShadowAdapter adapter;
    const auto casters = adapter.casters(scene);
    ASSERT_TRUE(casters);
    const auto positions = (*casters)[0].mesh->positions();
    for (const glm::vec3& drawn : deformed_of(scene).positions) {
        ASSERT_NE(std::find(positions.begin(), positions.end(), drawn), positions.end());
    }
}

TEST(DeformedShadow, an_unchanged_pose_is_the_same_object) {
    Scene scene = must_load(walking_figure());
    ShadowAdapter adapter;
    const auto mesh = [&] { return adapter.casters(scene).value()[0].mesh; };
    pose(scene, 0.2);
    const auto first = mesh();
    pose(scene, 0.2);
    EXPECT_EQ(mesh(), first);
    pose(scene, 1.2);  // the same, a turn later, up to rounding of the time
    pose(scene, 0.21);
    EXPECT_NE(mesh(), first);
}

/// Two triangles that meet along an edge whose vertices each has for itself; the second one's may
/// follow another joint.
GltfBuilder hinge(bool moves_apart) {
    GltfBuilder file;
    const std::vector<std::uint8_t> joint(24, 0);
    std::vector<std::uint8_t> joints = joint;
    if (moves_apart) joints[12] = joints[16] = joints[20] = 1;
    std::vector<float> weights;
    for (int v = 0; v < 6; ++v) weights.insert(weights.end(), {1, 0, 0, 0});
    const std::size_t position =
        file.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    file.mesh({{"attributes",
                {{"POSITION", position},
                 {"JOINTS_0", file.accessor_of(joints, u8, "VEC4", 4)},
                 {"WEIGHTS_0", file.accessor_of(weights, f32, "VEC4", 4)}}}});
    const std::size_t first = file.root({{"name", "first"}});
    const std::size_t second = file.root({{"name", "second"}});
    file.json["skins"] = {{{"joints", {first, second}}}};
    file.root({{"name", "hinge"}, {"mesh", 0}, {"skin", 0}});
    return file;
}

TEST(DeformedShadow, coincident_vertices_of_different_weights_stay_apart) {
    ShadowAdapter adapter;
    EXPECT_EQ(report_of(adapter, must_load(hinge(false))).welded_vertices, 4U);
    // They coincide in this pose, and still are not one.
    Scene scene = must_load(hinge(true));
    EXPECT_EQ(report_of(adapter, scene).welded_vertices, 6U);
    EXPECT_EQ(report_of(adapter, scene).components, 2U);
    scene.registry.get<LocalTransform>(find_entity(scene, "second")).translation.z = 1.0;
    ASSERT_TRUE(deform(scene));
    EXPECT_EQ(deformed_of(scene).positions[3], glm::vec3(1, 0, 1));
    EXPECT_EQ(deformed_of(scene).positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(report_of(adapter, scene).welded_vertices, 6U);
}

}  // namespace
}  // namespace gnomon::scene::test
