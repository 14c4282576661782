// SPDX-License-Identifier: MIT
//
// Real files. The folder of models is $GNOMON_MODELS, else ../shared/models beside the source tree;
// its MANIFEST.md tells what must come out. The other files are those of Debian's
// assimp-testmodels.
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <gnomon/scene/gltf.hpp>

#include "tests/support/models.hpp"

namespace gnomon::scene {
namespace {

namespace fs = std::filesystem;

std::size_t drawn_triangles(const Scene& scene) {
    std::size_t count = 0;
    scene.registry.each<MeshInstance>(
        [&](Entity, const MeshInstance& instance) { count += instance.mesh->triangle_count(); });
    return count;
}

struct Expected {
    std::size_t triangles = 0;
    std::optional<glm::dvec3> box;
    std::size_t lights = 0;
};

/// "160" or "160 (5440)": what is drawn is in the brackets, if any.
std::size_t read_triangles(const std::string& cell) {
    std::istringstream stream(cell);
    std::size_t triangles = 0;
    stream >> triangles;
    if (char bracket = 0; stream >> bracket) stream >> triangles;
    return triangles;
}

/// "1 x 2.5 x 0"
std::optional<glm::dvec3> read_box(const std::string& cell) {
    std::istringstream stream(cell);
    glm::dvec3 box(0.0);
    std::string times;
    if (stream >> box.x >> times >> box.y >> times >> box.z) return box;
    return std::nullopt;
}

Expected expected_of(test::ManifestRow row) {
    Expected expected;
    expected.triangles = read_triangles(row["triangles (drawn)"]);
    expected.box = read_box(row["box x y z"]);
    const std::string counts = row["meshes / nodes / skins / anims / lights"];
    expected.lights = std::stoul(counts.substr(counts.rfind('/') + 1));
    return expected;
}

class Manifest : public testing::Test {
protected:
    void SetUp() override {
        if (!fs::exists(test::models_folder() / "MANIFEST.md")) {
            GTEST_SKIP() << "no models: " << test::models_folder() / "MANIFEST.md"
                         << " is not there";
        }
        files_ = test::model_files();
    }
    std::map<std::string, fs::path> files_;
};

TEST_F(Manifest, every_file_has_the_triangles_and_the_size_that_it_lists) {
    const auto rows = test::read_manifest();
    ASSERT_EQ(rows.size(), files_.size());
    for (const auto& [name, row] : rows) {
        SCOPED_TRACE(name);
        const Expected expected = expected_of(row);
        ASSERT_TRUE(files_.count(name));
        const auto scene = load_gltf(files_[name]);
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(drawn_triangles(*scene), expected.triangles);
        EXPECT_EQ(scene->registry.count<Caster>(), scene->registry.count<MeshInstance>());
        const std::size_t lights = scene->registry.count<PointLight>() +
                                   scene->registry.count<SpotLight>() +
                                   scene->registry.count<DirectionalLight>();
        EXPECT_GE(lights, expected.lights);  // nodes may share one
        EXPECT_EQ(lights == 0, expected.lights == 0);
        // The manifest's box of this one counts vertices that no triangle uses.
        if (!expected.box || name == "hard-open-bowl.glb") continue;
        const Bounds bounds = world_bounds(*scene);
        const glm::dvec3 size = bounds.empty() ? glm::dvec3(0.0) : bounds.max - bounds.min;
        for (int axis = 0; axis < 3; ++axis) {
            // The manifest prints four digits.
            EXPECT_NEAR(size[axis], (*expected.box)[axis], 6e-4 * (*expected.box)[axis] + 1e-9)
                << "axis " << axis;
        }
    }
}

TEST_F(Manifest, meshes_keep_their_promises) {
    for (const auto& [name, path] : files_) {
        SCOPED_TRACE(name);
        const auto scene = load_gltf(path);
        ASSERT_TRUE(scene) << scene.error().message;
        std::set<const Mesh*> seen;
        scene->registry.each<MeshInstance>([&](Entity, const MeshInstance& instance) {
            const Mesh& mesh = *instance.mesh;
            ASSERT_GT(mesh.triangle_count(), 0U);
            if (!seen.insert(&mesh).second) return;
            ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
            if (!mesh.texcoords.empty()) {
                ASSERT_EQ(mesh.texcoords.size(), mesh.positions.size());
            }
            for (const glm::vec3& normal : mesh.normals) {
                ASSERT_NEAR(glm::length(normal), 1.0F, 1e-5F);
            }
            for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.positions.size());
            std::uint32_t next = 0;
            for (const SubMesh& sub_mesh : mesh.sub_meshes) {
                ASSERT_EQ(sub_mesh.first_index, next);
                ASSERT_LT(sub_mesh.material, scene->materials.size());
                next += sub_mesh.index_count;
            }
            ASSERT_EQ(next, mesh.indices.size());
        });
    }
}

TEST_F(Manifest, a_box_a_million_metres_out_is_exact) {
    ASSERT_TRUE(files_.count("hard-far-away.glb"));
    const auto scene = load_gltf(files_["hard-far-away.glb"]);
    ASSERT_TRUE(scene) << scene.error().message;
    std::size_t meshes = 0;
    scene->registry.each<MeshInstance>([&](Entity, const MeshInstance& instance) {
        ++meshes;
        EXPECT_GT(glm::length(instance.mesh->origin), 1e5);
        for (const glm::vec3& position : instance.mesh->positions) {
            EXPECT_LT(glm::length(position), 16.0F);
        }
    });
    EXPECT_EQ(meshes, 1U);
}

class Assimp : public testing::Test {
protected:
    void SetUp() override {
        if (!fs::exists(folder_)) {
            GTEST_SKIP() << "assimp-testmodels is not installed: no " << folder_;
        }
    }
    fs::path folder_ = "/usr/share/assimp/models/glTF2";
};

TEST_F(Assimp, every_file_loads_or_says_why_not) {
    std::size_t loaded = 0;
    std::size_t refused = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
        const auto extension = entry.path().extension();
        if (extension != ".glb" && extension != ".gltf") continue;
        const auto scene = load_gltf(entry.path());
        if (scene) {
            ++loaded;
            continue;
        }
        ++refused;
        const std::string& message = scene.error().message;
        EXPECT_THAT(message, testing::StartsWith(entry.path().string() + ": "));
        EXPECT_THAT(message, testing::EndsWith("."));
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_THAT(scene.error().code, testing::AnyOf(ErrorCode::InvalidInput, ErrorCode::Io));
    }
    EXPECT_GE(loaded, 30U);
    EXPECT_GE(refused, 6U);
}

TEST_F(Assimp, known_bad_files_are_refused_for_the_right_reason) {
    using testing::HasSubstr;
    const auto message = [&](const char* file) {
        const auto scene = load_gltf(folder_ / file);
        return scene ? std::string("loaded") : scene.error().message;
    };
    EXPECT_THAT(message("RecursiveNodes/RecursiveNodes.gltf"), HasSubstr("nodes["));
    EXPECT_THAT(message("IndexOutOfRange/IndexOutOfRange.gltf"), HasSubstr("number of vertices"));
    EXPECT_THAT(message("IndexOutOfRange/AllIndicesOutOfRange.gltf"),
                HasSubstr("number of vertices"));
    EXPECT_THAT(message("MissingBin/BoxTextured.gltf"), HasSubstr("does not exist"));
    EXPECT_THAT(message("BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb"), HasSubstr("finite"));
    EXPECT_THAT(message("draco/2CylinderEngine.gltf"), HasSubstr("KHR_draco_mesh_compression"));
    EXPECT_THAT(message("SchemaFailures/sceneWrongType.gltf"), HasSubstr("must be"));
    EXPECT_THAT(message("wrongTypes/badNumber.gltf"), HasSubstr("normalTexture"));
    for (const char* name : {"badArray", "badExtension", "badObject", "badString", "badUint"}) {
        EXPECT_THAT(message(fmt::format("wrongTypes/{}.gltf", name).c_str()), HasSubstr("must be"))
            << name;
    }
}

TEST_F(Assimp, the_engine_has_its_triangles_and_shares_meshes) {
    const auto scene = load_gltf(folder_ / "2CylinderEngine-glTF-Binary/2CylinderEngine.glb");
    ASSERT_TRUE(scene) << scene.error().message;
    std::set<const Mesh*> meshes;
    std::size_t once = 0;
    scene->registry.each<MeshInstance>([&](Entity, const MeshInstance& instance) {
        if (meshes.insert(instance.mesh.get()).second) once += instance.mesh->triangle_count();
    });
    EXPECT_EQ(meshes.size(), 29U);
    EXPECT_EQ(once, 75'730U);
    EXPECT_EQ(scene->registry.size(), 82U);
}

TEST_F(Assimp, textures_are_decoded_from_all_three_places) {
    for (const char* file :
         {"BoxTextured-glTF-Binary/BoxTextured.glb", "BoxTextured-glTF/BoxTextured.gltf",
          "BoxTextured-glTF-Embedded/BoxTextured.gltf"}) {
        SCOPED_TRACE(file);
        const auto scene = load_gltf(folder_ / file);
        ASSERT_TRUE(scene) << scene.error().message;
        ASSERT_EQ(scene->materials.size(), 2U);
        const auto& image = scene->materials[1].base_color_image;
        ASSERT_TRUE(image);
        EXPECT_GT(image->width, 0U);
        EXPECT_EQ(image->rgba.size(), std::size_t{4} * image->width * image->height);
    }
}

}  // namespace
}  // namespace gnomon::scene
