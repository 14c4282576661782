// SPDX-License-Identifier: MIT
//
// What the peers are given: the same every time, within everybody's limits, and casting shadows.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <mesh_pieces.hpp>
#include <scenes.hpp>

#include <gnomon/shadows/shadow_mesh.hpp>

namespace gnomon::peers {
namespace {

TEST(PeerScenes, CastersAreClosed) {
    for (const std::string& name : scene_names()) {
        const auto scene = make_scene(name);
        ASSERT_TRUE(scene) << name;
        for (std::size_t i = 0; i < scene->meshes.size(); ++i) {
            if (!scene->casts(i)) continue;
            const PeerMesh& mesh = scene->meshes[i];
            EXPECT_EQ(mesh.positions.size(), mesh.normals.size());
            const auto built = shadows::ShadowMesh::build(
                {.positions = std::as_bytes(std::span(mesh.positions)).data(),
                 .vertex_count = mesh.positions.size(),
                 .indices = mesh.indices});
            ASSERT_TRUE(built) << name << ": " << built.error().message;
            EXPECT_EQ((*built)->report().boundary_edges, 0U) << name << ", mesh " << i;
        }
    }
}

TEST(PeerScenes, AreWhatTheyAreCalled) {
    const auto crowd = make_scene("crowd");
    EXPECT_EQ(crowd->caster_count(), 256U);
    EXPECT_EQ(crowd->lights.size(), 4U);
    for (std::size_t i = 0; i < crowd->meshes.size(); ++i) {
        if (!crowd->casts(i)) continue;
        EXPECT_GE(crowd->meshes[i].triangle_count(), 1000U);
        EXPECT_LE(crowd->meshes[i].triangle_count(), 5000U);
    }
    EXPECT_EQ(make_scene("boxes")->caster_count(), 1000U);
    EXPECT_NEAR(static_cast<double>(make_scene("knot")->meshes.back().triangle_count()), 1e5, 1e3);
    EXPECT_NEAR(static_cast<double>(make_scene("million")->meshes.back().triangle_count()), 1e6,
                1e4);
    const auto none = make_scene("nowhere");
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("crowd"), std::string::npos);
}

// The segment from the lamp to the eye passes through a box in its own space.
bool lies_between(const PeerScene& scene, const Instance& bar, const glm::dvec3& lamp) {
    glm::vec3 half(0.0F);
    for (const glm::vec3& p : scene.meshes[bar.mesh].positions) half = glm::max(half, p);
    const glm::dmat4 local = glm::inverse(bar.world_from_local);
    const glm::dvec3 from(local * glm::dvec4(lamp, 1.0));
    const glm::dvec3 to(local * glm::dvec4(scene.eye, 1.0));
    double enter = 0.0;
    double leave = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (-half[axis] - from[axis]) / (to[axis] - from[axis]);
        const double b = (half[axis] - from[axis]) / (to[axis] - from[axis]);
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter < leave;
}

TEST(PeerScenes, TheEyeOfTheRoomIsInTheShadowOfEveryBarWhateverFrame) {
    const auto scene = make_scene("room");
    for (std::int64_t frame = 0; frame < 100; ++frame) {
        for (std::size_t i = 0; i < scene->lights.size(); ++i) {
            const glm::dvec3 lamp(light_in(*scene, i, Motion::Lights, frame));
            const auto bars = std::ranges::count_if(scene->instances, [&](const Instance& it) {
                return it.casts && lies_between(*scene, it, lamp);
            });
            EXPECT_EQ(bars, 24) << "frame " << frame;
        }
    }
}

TEST(PeerScenes, OnlyWhatAMotionNamesMoves) {
    const auto scene = make_scene("crowd");
    const auto moved = [&](Motion motion) {
        return std::ranges::count_if(scene->instances, [&](const Instance& it) {
            return pose_in(*scene, it, motion, 7) != it.world_from_local;
        });
    };
    const auto lights_moved = [&](Motion motion) {
        int count = 0;
        for (std::size_t i = 0; i < scene->lights.size(); ++i)
            count += light_in(*scene, i, motion, 7) != scene->lights[i].position_world ? 1 : 0;
        return count;
    };
    EXPECT_EQ(moved(Motion::Static), 0);
    EXPECT_EQ(moved(Motion::Lights), 0);
    EXPECT_EQ(moved(Motion::Casters), 32);
    EXPECT_EQ(lights_moved(Motion::Casters), 0);
    EXPECT_EQ(lights_moved(Motion::Light), 1);
    EXPECT_EQ(lights_moved(Motion::Lights), 4);
    // One degree a frame about the scene's centre.
    const glm::dvec4& now = scene->lights[0].position_world;
    const glm::dvec4 later = light_in(*scene, 0, Motion::Lights, 1);
    const double cosine = glm::dot(glm::normalize(glm::dvec2(later.x, later.z)),
                                   glm::normalize(glm::dvec2(now.x, now.z)));
    EXPECT_NEAR(std::acos(cosine), glm::radians(1.0), 1e-9);
}

TEST(MeshPieces, HaveTheTrianglesInTheirOrder) {
    const auto scene = make_scene("knot");
    const PeerMesh& mesh = scene->meshes.back();
    std::vector<glm::vec3> corners;
    const auto pieces = split_mesh(mesh, 32'000);
    EXPECT_GT(pieces.size(), 1U);
    for (const MeshPiece& piece : pieces) {
        EXPECT_LE(piece.positions.size(), 32'000U);
        for (const std::uint16_t index : piece.indices)
            corners.push_back(piece.positions.at(index));
    }
    ASSERT_EQ(corners.size(), mesh.indices.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
        ASSERT_EQ(corners[i], mesh.positions[mesh.indices[i]]) << "corner " << i;
}

}  // namespace
}  // namespace gnomon::peers
