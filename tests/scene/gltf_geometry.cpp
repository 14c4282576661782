// SPDX-License-Identifier: MIT
//
// What becomes of the geometry in a glTF file: every way to store it, exact values.
#include <gmock/gmock.h>

#include "tests/scene/gltf_builder.hpp"

namespace gnomon::scene::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<glm::vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<glm::vec3> towards_z(4, glm::vec3(0, 0, 1));

/// A file with a square, its normals, and indices as given.
template <class T>
GltfBuilder square_file(const std::vector<T>& indices, int component, int mode = 4) {
    GltfBuilder file;
    const std::size_t position = file.positions(square);
    const std::size_t normal = file.positions(towards_z);
    Json primitive{{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}, {"mode", mode}};
    if (!indices.empty()) primitive["indices"] = file.accessor_of(indices, component, "SCALAR", 1);
    file.mesh(primitive);
    file.root({{"mesh", 0}});
    return file;
}

/// The corners of all triangles, as positions.
std::vector<glm::vec3> corners(const Mesh& mesh) {
    std::vector<glm::vec3> result;
    for (const std::uint32_t index : mesh.indices) result.push_back(mesh.positions[index]);
    return result;
}

std::vector<glm::vec3> picked(std::initializer_list<std::size_t> places) {
    std::vector<glm::vec3> result;
    for (const std::size_t place : places) result.push_back(square[place]);
    return result;
}

TEST(GltfGeometry, all_index_types_and_none) {
    const auto check = [](const GltfBuilder& file, const std::vector<glm::vec3>& expected) {
        const auto scene = file.load();
        ASSERT_TRUE(scene) << scene.error().message;
        const auto mesh = only_mesh(*scene);
        EXPECT_EQ(corners(*mesh), expected);
        EXPECT_THAT(mesh->normals, testing::Each(glm::vec3(0, 0, 1)));
    };
    const auto two = picked({0, 1, 2, 0, 2, 3});
    check(square_file<std::uint8_t>({0, 1, 2, 0, 2, 3}, u8), two);
    check(square_file<std::uint16_t>({0, 1, 2, 0, 2, 3}, u16), two);
    check(square_file<std::uint32_t>({0, 1, 2, 0, 2, 3}, u32), two);
    // Without indices the vertices are taken in order; the fourth is not enough for a triangle.
    check(square_file<std::uint8_t>({}, u8), picked({0, 1, 2}));
}

TEST(GltfGeometry, indexed_vertices_stay_shared_and_unused_ones_go) {
    const auto scene = square_file<std::uint16_t>({1, 2, 3, 3, 2, 1}, u16).load();
    ASSERT_TRUE(scene) << scene.error().message;
    const auto mesh = only_mesh(*scene);
    EXPECT_EQ(mesh->positions, picked({1, 2, 3}));
    EXPECT_THAT(mesh->indices, ElementsAre(0, 1, 2, 2, 1, 0));
}

TEST(GltfGeometry, strips_alternate_and_fans_turn) {
    const auto strip = square_file<std::uint16_t>({0, 1, 3, 2}, u16, 5).load();
    ASSERT_TRUE(strip) << strip.error().message;
    EXPECT_EQ(corners(*only_mesh(*strip)), picked({0, 1, 3, 1, 2, 3}));
    const auto fan = square_file<std::uint16_t>({0, 1, 2, 3}, u16, 6).load();
    ASSERT_TRUE(fan) << fan.error().message;
    EXPECT_EQ(corners(*only_mesh(*fan)), picked({0, 1, 2, 0, 2, 3}));
    // Triangles without area stay: they are in the file.
    const auto stitched = square_file<std::uint16_t>({0, 1, 3, 3, 1, 2}, u16, 5).load();
    ASSERT_TRUE(stitched) << stitched.error().message;
    EXPECT_EQ(only_mesh(*stitched)->triangle_count(), 4U);
}

TEST(GltfGeometry, points_and_lines_are_skipped_and_named) {
    for (int mode = 0; mode < 4; ++mode) {
        const auto scene = square_file<std::uint16_t>({0, 1, 2, 3}, u16, mode).load();
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(scene->registry.count<MeshInstance>(), 0U);
        EXPECT_EQ(scene->registry.size(), 1U);
        EXPECT_THAT(scene->messages, testing::Contains(HasSubstr(mode == 0 ? "points" : "lines")));
        EXPECT_THAT(scene->messages, testing::Contains(HasSubstr("no triangles")));
    }
}

TEST(GltfGeometry, interleaved_and_strided_attributes) {
    GltfBuilder file;
    struct Vertex {
        glm::vec3 position;
        glm::vec2 texcoord;
        glm::vec3 normal;
    };
    static_assert(sizeof(Vertex) == 32);
    const std::vector<Vertex> vertices{{{1, 2, 3}, {0.25F, 0.5F}, {0, 1, 0}},
                                       {{4, 2, 3}, {0.75F, 0.5F}, {0, 1, 0}},
                                       {{1, 2, 0}, {0.25F, 1.5F}, {0, 1, 0}}};
    const std::size_t view = file.view(bytes_of(vertices), sizeof(Vertex));
    file.mesh({{"attributes",
                {{"POSITION", file.accessor(view, f32, "VEC3", 3, 0)},
                 {"TEXCOORD_0", file.accessor(view, f32, "VEC2", 3, 12)},
                 {"NORMAL", file.accessor(view, f32, "VEC3", 3, 20)}}}});
    file.root({{"mesh", 0}});
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    const auto mesh = only_mesh(*scene);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(mesh->positions[i], vertices[i].position);
        EXPECT_EQ(mesh->texcoords[i], vertices[i].texcoord);
        EXPECT_EQ(mesh->normals[i], vertices[i].normal);
    }
}

TEST(GltfGeometry, sparse_accessors_with_and_without_a_base) {
    for (const bool with_base : {true, false}) {
        GltfBuilder file;
        const std::size_t position = file.positions({{9, 9, 9}, {1, 0, 0}, {9, 9, 9}});
        if (!with_base) file.json["accessors"][position].erase("bufferView");
        const std::size_t indices = file.view(bytes_of<std::uint8_t>({0, 2}));
        const std::size_t values = file.view(bytes_of<glm::vec3>({{5, 0, 0}, {0, 6, 0}}));
        file.json["accessors"][position]["sparse"] = {
            {"count", 2},
            {"indices", {{"bufferView", indices}, {"componentType", u8}}},
            {"values", {{"bufferView", values}}}};
        file.mesh({{"attributes", {{"POSITION", position}}}});
        file.root({{"mesh", 0}});
        const auto scene = file.load();
        ASSERT_TRUE(scene) << scene.error().message;
        const glm::vec3 middle = with_base ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 0);
        EXPECT_THAT(only_mesh(*scene)->positions,
                    ElementsAre(glm::vec3(5, 0, 0), middle, glm::vec3(0, 6, 0)));
    }
}

/// KHR_mesh_quantization: four bytes a component row, values -2, 3 or their unsigned likes.
template <class T>
std::shared_ptr<const Mesh> quantized(int component, bool normalized,
                                      const std::vector<T>& values) {
    GltfBuilder file;
    const std::size_t position = file.accessor(file.view(bytes_of(values), 4 * sizeof(T)),
                                               component, "VEC3", values.size() / 4);
    file.json["accessors"][position]["normalized"] = normalized;
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    file.mesh({{"attributes", {{"POSITION", position}}}});
    file.root({{"mesh", 0}});
    const auto scene = file.load();
    EXPECT_TRUE(scene) << scene.error().message;
    return scene ? only_mesh(*scene) : nullptr;
}

TEST(GltfGeometry, quantized_positions) {
    const auto expect = [](const std::shared_ptr<const Mesh>& mesh, const glm::vec3& a,
                           const glm::vec3& b, const glm::vec3& c) {
        ASSERT_TRUE(mesh);
        EXPECT_THAT(mesh->positions, ElementsAre(a, b, c));
    };
    expect(quantized<std::int8_t>(i8, false, {-2, 3, 0, 0, 127, 0, 0, 0, 0, 0, -128, 0}),
           {-2, 3, 0}, {127, 0, 0}, {0, 0, -128});
    expect(quantized<std::int8_t>(i8, true, {-127, 127, 0, 0, 127, 0, 0, 0, 0, 0, -128, 0}),
           {-1, 1, 0}, {1, 0, 0}, {0, 0, -1});
    expect(quantized<std::uint8_t>(u8, false, {2, 3, 0, 0, 255, 0, 0, 0, 0, 0, 9, 0}), {2, 3, 0},
           {255, 0, 0}, {0, 0, 9});
    expect(quantized<std::uint8_t>(u8, true, {255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 51, 0}), {1, 0, 0},
           {0, 1, 0}, {0, 0, static_cast<float>(51.0 / 255.0)});
    expect(quantized<std::int16_t>(i16, false, {-300, 3, 0, 0, 400, 0, 0, 0, 0, 0, 500, 0}),
           {-300, 3, 0}, {400, 0, 0}, {0, 0, 500});
    expect(
        quantized<std::int16_t>(i16, true, {-32768, 32767, 0, 0, 32767, 0, 0, 0, 0, 0, 16384, 0}),
        {-1, 1, 0}, {1, 0, 0}, {0, 0, static_cast<float>(16384.0 / 32767.0)});
    expect(quantized<std::uint16_t>(u16, false, {60000, 3, 0, 0, 4, 0, 0, 0, 0, 0, 5, 0}),
           {60000, 3, 0}, {4, 0, 0}, {0, 0, 5});
    expect(quantized<std::uint16_t>(u16, true, {65535, 0, 0, 0, 0, 65535, 0, 0, 0, 0, 13107, 0}),
           {1, 0, 0}, {0, 1, 0}, {0, 0, static_cast<float>(13107.0 / 65535.0)});
}

TEST(GltfGeometry, quantized_normals_and_texture_coordinates) {
    GltfBuilder file;
    const std::size_t position = file.positions({{0, 0, 0}, {1, 0, 0}, {0, 0, -1}});
    const std::vector<std::int8_t> normals{0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0};
    const std::size_t normal = file.accessor(file.view(bytes_of(normals), 4), i8, "VEC3", 3);
    file.json["accessors"][normal]["normalized"] = true;
    const std::vector<std::uint16_t> texcoords{0, 65535, 13107, 0, 0, 0};
    const std::size_t texcoord = file.accessor_of(texcoords, u16, "VEC2", 2);
    file.json["accessors"][texcoord]["normalized"] = true;
    file.mesh(
        {{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", texcoord}}}});
    file.root({{"mesh", 0}});
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    const auto mesh = only_mesh(*scene);
    EXPECT_THAT(mesh->normals, testing::Each(glm::vec3(0, 1, 0)));
    EXPECT_THAT(mesh->texcoords,
                ElementsAre(glm::vec2(0, 1), glm::vec2(static_cast<float>(13107.0 / 65535.0), 0),
                            glm::vec2(0, 0)));
}

TEST(GltfGeometry, without_normals_faces_are_flat) {
    GltfBuilder file;
    const std::size_t position = file.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    const std::size_t index = file.indices({0, 1, 2, 0, 2, 3, 0, 0, 1});
    file.mesh({{"attributes", {{"POSITION", position}}}, {"indices", index}});
    file.root({{"mesh", 0}});
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    const auto mesh = only_mesh(*scene);
    EXPECT_EQ(mesh->positions.size(), 9U);
    EXPECT_TRUE(mesh->texcoords.empty());
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(mesh->normals[i], glm::vec3(0, 0, 1));
        EXPECT_EQ(mesh->normals[3 + i], glm::vec3(1, 0, 0));
        EXPECT_EQ(mesh->normals[6 + i], glm::vec3(0, 1, 0));  // no area: any unit vector
    }
}

TEST(GltfGeometry, bad_normals_are_made_from_the_faces) {
    GltfBuilder file;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::size_t position = file.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const std::size_t normal = file.positions({{0, 0, 5}, {0, 0, 0}, {nan, 0, 1}});
    file.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
    file.root({{"mesh", 0}});
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(only_mesh(*scene)->normals, testing::Each(glm::vec3(0, 0, 1)));
    EXPECT_THAT(scene->messages, testing::Contains(HasSubstr("2 normals")));
}

TEST(GltfGeometry, primitives_of_a_mesh_become_one_mesh) {
    GltfBuilder file;
    const std::size_t position = file.positions(square);
    const std::size_t normal = file.positions(towards_z);
    const Json attributes{{"POSITION", position}, {"NORMAL", normal}};
    const std::size_t first = file.indices({0, 1, 2});
    const std::size_t second = file.indices({0, 2, 3});
    const std::size_t lone = file.positions({{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
    file.json["materials"] = {{{"name", "red"}}, {{"name", "blue"}}};
    file.json["meshes"] = {{{"name", "pair"},
                            {"primitives",
                             {{{"attributes", attributes}, {"indices", first}, {"material", 1}},
                              {{"attributes", attributes}, {"indices", second}},
                              {{"attributes", {{"POSITION", lone}}}, {"material", 0}}}}}};
    file.root({{"mesh", 0}});
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    const auto mesh = only_mesh(*scene);
    EXPECT_EQ(mesh->name, "pair");
    // The first two share their vertices.
    EXPECT_EQ(mesh->positions.size(), 4U + 3U);
    ASSERT_EQ(mesh->sub_meshes.size(), 3U);
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(mesh->sub_meshes[i].first_index, 3 * i);
        EXPECT_EQ(mesh->sub_meshes[i].index_count, 3U);
    }
    EXPECT_EQ(scene->materials[mesh->sub_meshes[0].material].name, "blue");
    EXPECT_EQ(scene->materials[mesh->sub_meshes[1].material].name, "default");
    EXPECT_EQ(scene->materials[mesh->sub_meshes[2].material].name, "red");
}

TEST(GltfGeometry, a_mesh_of_many_nodes_is_one_object) {
    GltfBuilder file = triangle_file();
    file.root({{"mesh", 0}, {"name", "second"}});
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    const Entity a = find_entity(*scene, "triangle");
    const Entity b = find_entity(*scene, "second");
    EXPECT_EQ(scene->registry.get<MeshInstance>(a).mesh, scene->registry.get<MeshInstance>(b).mesh);
    for (const Entity entity : {a, b}) {
        EXPECT_TRUE(scene->registry.has<Caster>(entity));
        EXPECT_TRUE(scene->registry.has<Receiver>(entity));
    }
}

TEST(GltfGeometry, a_mesh_far_from_its_origin_is_moved_exactly) {
    GltfBuilder file;
    const std::vector<glm::vec3> far{{1'000'000.0625F, 0, -3'000'000},
                                     {1'000'001, 0, -3'000'000},
                                     {1'000'000, 0.1F, -2'999'999.75F}};
    file.mesh({{"attributes", {{"POSITION", file.positions(far)}}}});
    file.root({{"mesh", 0}});
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    const auto mesh = only_mesh(*scene);
    EXPECT_NE(mesh->origin.x, 0.0);
    EXPECT_EQ(mesh->origin.y, 0.0);
    EXPECT_NE(mesh->origin.z, 0.0);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT(glm::length(mesh->positions[i]), 4.0F);
        EXPECT_EQ(mesh->origin + glm::dvec3(mesh->positions[i]), glm::dvec3(far[i]));
    }
    const Bounds bounds = world_bounds(*scene);
    EXPECT_EQ(bounds.max.x, 1'000'001.0);
    EXPECT_EQ(bounds.min.z, -3'000'000.0);

    // One that is near keeps its coordinates.
    const auto near = triangle_file().load();
    ASSERT_TRUE(near) << near.error().message;
    EXPECT_EQ(only_mesh(*near)->origin, glm::dvec3(0.0));
}

TEST(GltfGeometry, a_file_without_meshes_is_an_empty_scene) {
    GltfBuilder file;
    for (const char* empty : {"meshes", "accessors", "bufferViews", "nodes"}) {
        file.json.erase(empty);
    }
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->registry.size(), 0U);
    EXPECT_THAT(scene->messages, testing::Contains(HasSubstr("no triangles")));
}

}  // namespace
}  // namespace gnomon::scene::test
