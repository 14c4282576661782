// SPDX-License-Identifier: MIT
//
// Bad files: one sentence each that names the place, the value and the limit.
#include <functional>

#include <gmock/gmock.h>

#include "tests/scene/gltf_builder.hpp"

namespace gnomon::scene::test {
namespace {

using testing::HasSubstr;

struct Fault {
    const char* name;
    std::function<void(GltfBuilder&)> break_it;  ///< a triangle_file()
    std::vector<std::string> says;
};

class Faults : public testing::TestWithParam<Fault> {};

TEST_P(Faults, is_refused_in_one_sentence) {
    ASSERT_TRUE(triangle_file().load()) << "the file is right before it is broken";
    GltfBuilder file = triangle_file();
    GetParam().break_it(file);
    const auto scene = file.load();
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().code, ErrorCode::InvalidInput);
    const std::string& message = scene.error().message;
    EXPECT_THAT(message, testing::StartsWith("test.glb: "));
    EXPECT_THAT(message, testing::EndsWith("."));
    EXPECT_EQ(message.find('\n'), std::string::npos);
    for (const std::string& part : GetParam().says) EXPECT_THAT(message, HasSubstr(part));
}

/// Sets one member anywhere.
std::function<void(GltfBuilder&)> set(const char* pointer, const Json& value) {
    return [=](GltfBuilder& file) { file.json[Json::json_pointer(pointer)] = value; };
}

const std::vector<Fault> faults{
    {"version_1", set("/asset/version", "1.0"), {"asset.version is \"1.0\"", "2.x"}},
    {"no_asset", [](GltfBuilder& f) { f.json.erase("asset"); }, {"no member \"asset\""}},
    {"asset_wrong", set("/asset", 3), {"asset is 3", "object"}},
    {"extension",
     set("/extensionsRequired", {"EXT_meshopt_compression"}),
     {"extensionsRequired[0]", "EXT_meshopt_compression"}},
    {"count_zero", set("/accessors/0/count", 0), {"accessors[0].count is 0", "from 1"}},
    {"count_negative", set("/accessors/0/count", -1), {"accessors[0].count is -1"}},
    {"count_fraction", set("/accessors/0/count", 2.5), {"accessors[0].count is 2.5"}},
    {"count_text", set("/accessors/0/count", "3"), {"accessors[0].count is \"3\""}},
    {"count_too_large",
     set("/accessors/0/count", 4),
     {"accessors[0] reaches byte 48", "bufferViews[0] has only 36"}},
    {"count_huge", set("/accessors/0/count", 2'000'000'000), {"accessors[0] reaches byte"}},
    {"zeros_huge",
     [](GltfBuilder& f) {
         f.json["accessors"][0].erase("bufferView");
         f.json["accessors"][0]["count"] = 2'000'000'000;
     },
     {"accessors[0].count is 2000000000", "at most"}},
    {"component", set("/accessors/0/componentType", 5124), {"accessors[0].componentType is 5124"}},
    {"component_double", set("/accessors/0/componentType", 5130), {"5130"}},
    {"type", set("/accessors/0/type", "VEC5"), {"accessors[0].type is \"VEC5\""}},
    {"position_vec2",
     set("/accessors/0/type", "VEC2"),
     {"accessors[0].type is \"VEC2\"", "VEC3", "meshes[0].primitives[0].attributes.POSITION"}},
    {"position_u32", set("/accessors/0/componentType", 5125), {"5125", "POSITION"}},
    {"indices_float",
     [](GltfBuilder& f) {
         f.json["accessors"][1]["componentType"] = f32;
         f.json["accessors"][1]["count"] = 1;
     },
     {"accessors[1].componentType is 5126", "indices"}},
    {"offset_odd", set("/accessors/0/byteOffset", 2), {"accessors[0]", "multiples of 4"}},
    {"accessor_view",
     set("/accessors/0/bufferView", 2),
     {"accessors[0].bufferView is 2", "0 to 1"}},
    {"view_buffer", set("/bufferViews/0/buffer", 1), {"bufferViews[0].buffer is 1", "0 to 0"}},
    {"view_range",
     set("/bufferViews/0/byteLength", 1000),
     {"bufferViews[0] reaches byte 1000", "buffers[0] has only 42"}},
    {"view_offset", set("/bufferViews/1/byteOffset", 2147483647), {"bufferViews[1] reaches byte"}},
    {"stride_small", set("/bufferViews/0/byteStride", 3), {"bufferViews[0].byteStride is 3"}},
    {"stride_odd", set("/bufferViews/0/byteStride", 14), {"byteStride is 14", "multiple of 4"}},
    {"stride_below_element",
     set("/bufferViews/0/byteStride", 8),
     {"bufferViews[0].byteStride is 8", "at least 12", "accessors[0]"}},
    {"stride_huge", set("/bufferViews/0/byteStride", 256), {"byteStride is 256", "252"}},
    {"buffer_length",
     set("/buffers", {{{"byteLength", 100}}}),
     {"buffers[0].byteLength is 100", "at most 44"}},
    {"buffer_without_source",
     set("/buffers", {{{"byteLength", 42}}, {{"byteLength", 42}}}),
     {"buffers[1]", "uri"}},
    {"buffer_data_uri",
     set("/buffers", {{{"byteLength", 42}, {"uri", "data:application/gltf-buffer;base64,AB*="}}}),
     {"buffers[0].uri", "base64"}},
    {"attribute_reference",
     set("/meshes/0/primitives/0/attributes/POSITION", 7),
     {"meshes[0].primitives[0].attributes.POSITION is 7", "0 to 1"}},
    {"attribute_counts",
     [](GltfBuilder& f) {
         f.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
             f.positions({{0, 0, 1}, {0, 0, 1}});
     },
     {"has 3 elements, but another attribute has 2"}},
    {"indices_reference", set("/meshes/0/primitives/0/indices", 2), {"primitives[0].indices is 2"}},
    {"material_reference",
     set("/meshes/0/primitives/0/material", 0),
     {"primitives[0].material is 0", "no materials"}},
    {"mode", set("/meshes/0/primitives/0/mode", 7), {"primitives[0].mode is 7", "0 to 6"}},
    {"primitives_missing",
     [](GltfBuilder& f) { f.json["meshes"][0].erase("primitives"); },
     {"meshes[0] has no member \"primitives\""}},
    {"mesh_wrong", set("/meshes/0", "x"), {"meshes[0] is \"x\"", "object"}},
    {"meshes_wrong", set("/meshes", 4), {"meshes is 4", "array"}},
    {"node_mesh", set("/nodes/0/mesh", 1), {"nodes[0].mesh is 1", "0 to 0"}},
    {"node_camera", set("/nodes/0/camera", 0), {"nodes[0].camera is 0", "no cameras"}},
    {"node_skin", set("/nodes/0/skin", 0), {"nodes[0].skin is 0", "no skins"}},
    {"node_child", set("/nodes/0/children", {1}), {"nodes[0].children[0] is 1"}},
    {"node_own_child", set("/nodes/0/children", {0}), {"nodes[0] is its own ancestor"}},
    {"node_cycle",
     [](GltfBuilder& f) {
         f.node({{"children", {2}}});
         f.node({{"children", {1}}});
     },
     {"nodes[1] is its own ancestor"}},
    {"node_two_parents",
     [](GltfBuilder& f) {
         f.node({{"children", {0}}});
         f.node({{"children", {0}}});
     },
     {"nodes[2].children[0] is node 0", "already a child of nodes[1]"}},
    {"node_matrix_short", set("/nodes/0/matrix", {1, 2, 3}), {"nodes[0].matrix", "16 numbers"}},
    {"node_matrix_projective",
     set("/nodes/0/matrix", {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}),
     {"nodes[0].matrix[3] is 0.5", "affine"}},
    {"node_translation",
     set("/nodes/0/translation", {1, "2", 3}),
     {"nodes[0].translation[1] is \"2\""}},
    {"node_rotation_zero", set("/nodes/0/rotation", {0, 0, 0, 0}), {"nodes[0].rotation"}},
    {"node_matrix_and_scale",
     [](GltfBuilder& f) {
         f.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
         f.json["nodes"][0]["scale"] = {1, 1, 1};
     },
     {"nodes[0].scale", "matrix"}},
    {"scales_overflow",
     [](GltfBuilder& f) {
         for (std::size_t i = 1; i < 12; ++i) {
             f.node({{"scale", {1e38, 1e38, 1e38}}, {"children", {i - 1}}});
         }
         f.json["scenes"][0]["nodes"] = {11};
     },
     {"transform of node", "not finite"}},
    {"scene_node", set("/scenes/0/nodes", {0, 9}), {"scenes[0].nodes[1] is 9", "0 to 0"}},
    {"scene_default", set("/scene", 1), {"scene is 1", "0 to 0"}},
    {"light_missing",
     set("/nodes/0/extensions", {{"KHR_lights_punctual", {{"light", 0}}}}),
     {"nodes[0].extensions.KHR_lights_punctual", "no lights"}},
    {"light_type",
     set("/extensions", {{"KHR_lights_punctual", {{"lights", {{{"type", "area"}}}}}}}),
     {"lights[0].type is \"area\"", "point, spot, directional"}},
    {"light_cones",
     set("/extensions", {{"KHR_lights_punctual",
                          {{"lights",
                            {{{"type", "spot"},
                              {"spot", {{"innerConeAngle", 1.0}, {"outerConeAngle", 0.5}}}}}}}}}),
     {"lights[0].spot", "inner cone angle 1"}},
    {"instancing_counts",
     [](GltfBuilder& f) {
         const std::size_t one = f.positions({{1, 1, 1}});
         f.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
             {"TRANSLATION", 0}, {"SCALE", one}};
     },
     {"SCALE has 1 elements, but another attribute has 3"}},
    {"camera_fov",
     set("/cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 4}, {"znear", 1}}}}}),
     {"cameras[0].perspective.yfov is 4"}},
    {"camera_planes",
     set("/cameras", {{{"type", "orthographic"},
                       {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 2}, {"zfar", 1}}}}}),
     {"cameras[0].orthographic.zfar is 1", "znear, which is 2"}},
    {"skin_matrices",
     [](GltfBuilder& f) {
         const std::size_t one = f.accessor_of(std::vector<float>(16, 0.0F), f32, "MAT4", 16);
         f.node(Json::object());
         f.json["skins"] = {{{"joints", {0, 1}}, {"inverseBindMatrices", one}}};
     },
     {"skins[0].inverseBindMatrices has 1 matrices, but the skin has 2 joints"}},
    {"material_factor",
     set("/materials", {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1}}}}}}),
     {"materials[0].pbrMetallicRoughness.baseColorFactor", "4 numbers"}},
    {"texture_source", set("/textures", {{{"source", 0}}}), {"textures[0].source is 0"}},
    {"sparse_count",
     set("/accessors/0/sparse", {{"count", 4},
                                 {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                 {"values", {{"bufferView", 0}}}}),
     {"accessors[0].sparse.count is 4", "to 3"}},
    {"sparse_values",
     set("/accessors/0/sparse", {{"count", 3},
                                 {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                 {"values", {{"bufferView", 1}}}}),
     {"accessors[0].sparse.values", "bufferViews[1] has only 6"}},
    {"sparse_order",
     [](GltfBuilder& f) {
         const std::size_t view = f.view(bytes_of<std::uint8_t>({2, 1}));
         f.json["accessors"][0]["sparse"] = {
             {"count", 2},
             {"indices", {{"bufferView", view}, {"componentType", 5121}}},
             {"values", {{"bufferView", 0}}}};
     },
     {"accessors[0].sparse.indices: element 1 is 1"}},
    {"index_too_large",
     [](GltfBuilder& f) {
         f.json["meshes"][0]["primitives"][0]["indices"] = f.indices({0, 1, 3});
     },
     {"meshes[0].primitives[0]", "element 2", "accessors[2]", "is 3", "less than 3"}},
    {"position_nan",
     [](GltfBuilder& f) {
         f.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
             f.positions({{0, 0, 0}, {std::numeric_limits<float>::quiet_NaN(), 0, 0}, {0, 1, 0}});
     },
     {"meshes[0].primitives[0]", "POSITION 1", "nan", "finite"}},
    {"position_infinite",
     [](GltfBuilder& f) {
         f.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
             f.positions({{0, 0, 0}, {1, 0, 0}, {0, -std::numeric_limits<float>::infinity(), 0}});
     },
     {"POSITION 2", "-inf"}},
};

INSTANTIATE_TEST_SUITE_P(All, Faults, testing::ValuesIn(faults),
                         [](const auto& param) { return param.param.name; });

std::string refusal(const Bytes& bytes) {
    const auto scene = load_glb(bytes, "test.glb");
    return scene ? std::string("loaded") : scene.error().message;
}

TEST(GltfErrors, containers) {
    const Bytes good = triangle_file().glb();
    EXPECT_EQ(refusal({}), "test.glb: the file is empty.");
    Bytes bad = good;
    bad[4] = std::byte{1};
    EXPECT_EQ(refusal(bad), "test.glb: the header's version is 1, but must be 2.");
    bad = good;
    bad[8] = std::byte{11};
    bad[9] = std::byte{0};
    EXPECT_THAT(refusal(bad), HasSubstr("length is 11"));
    bad = good;
    bad[15] = std::byte{0x7F};
    EXPECT_THAT(refusal(bad), HasSubstr("the chunk at byte 12 claims"));
    bad = good;
    bad[16] = std::byte{'X'};
    EXPECT_THAT(refusal(bad), HasSubstr("the first chunk's type"));
    Bytes longer = good;  // bytes after the end are none of ours
    longer.resize(longer.size() + 100);
    EXPECT_EQ(refusal(longer), "loaded");
}

TEST(GltfErrors, json) {
    EXPECT_THAT(refusal(make_glb("{\"asset\":", {})), HasSubstr("the JSON is broken at byte"));
    EXPECT_THAT(refusal(make_glb("[]", {})), HasSubstr("must be an object"));
    EXPECT_THAT(refusal(make_glb("{\"asset\":{\"version\":\"2.0\"},\"scene\":1e999}", {})),
                HasSubstr("JSON"));
    const std::string deep =
        "{\"extras\":" + std::string(100'000, '[') + std::string(100'000, ']') + "}";
    EXPECT_THAT(refusal(make_glb(deep, {})), HasSubstr("nested deeper than 64"));
    EXPECT_THAT(refusal(make_glb("{\"asset\":{\"version\":\"\xFF\"}}", {})), HasSubstr("JSON"));
}

TEST(GltfErrors, whole_numbers_may_be_written_with_a_point) {
    GltfBuilder file = triangle_file();
    file.json["accessors"][0]["count"] = 3.0;
    EXPECT_THAT(file.json.dump(), HasSubstr("3.0"));
    EXPECT_TRUE(file.load());
}

TEST(GltfErrors, a_small_file_cannot_describe_a_huge_scene) {
    GltfBuilder file;
    const std::size_t position = file.positions(std::vector<glm::vec3>(20'000, glm::vec3(1, 2, 3)));
    Json primitives = Json::array();
    for (int i = 0; i < 2'000; ++i) {
        primitives.push_back({{"attributes", {{"POSITION", position}}}});
    }
    file.json["meshes"] = {{{"primitives", primitives}}};
    file.root({{"mesh", 0}});
    const auto scene = file.load();
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, HasSubstr("at most"));
}

}  // namespace
}  // namespace gnomon::scene::test
