// SPDX-License-Identifier: MIT
//
// Broken files by the thousand: each loads or is refused in one sentence. Run under sanitizers,
// this is where a reader shows that it never reads beyond its input.
#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include <gnomon/scene/deform.hpp>

#include "tests/scene/gltf_builder.hpp"

namespace gnomon::scene::test {
namespace {

/// A small file that uses most of what the reader knows.
GltfBuilder rich_file() {
    GltfBuilder file = triangle_file();
    const std::size_t position = file.positions({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 1}});
    const std::size_t normal = file.positions(std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)));
    const std::size_t strip = file.indices({0, 1, 3, 2});
    const std::size_t sparse_indices = file.view(bytes_of<std::uint8_t>({1, 3}));
    const std::size_t sparse_values = file.view(bytes_of<glm::vec3>({{5, 0, 0}, {0, 6, 0}}));
    file.json["accessors"][position]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", sparse_indices}, {"componentType", u8}}},
        {"values", {{"bufferView", sparse_values}}}};
    const std::vector<std::uint8_t> joints(16, 0);
    const std::vector<float> weights{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    std::vector<float> bind(16, 0.0F);
    for (const std::size_t k : {0U, 5U, 10U, 15U}) bind[k] = 1.0F;
    const std::size_t skinned =
        file.mesh({{"attributes",
                    {{"POSITION", position},
                     {"NORMAL", normal},
                     {"JOINTS_0", file.accessor_of(joints, u8, "VEC4", 4)},
                     {"WEIGHTS_0", file.accessor_of(weights, f32, "VEC4", 4)}}},
                   {"indices", strip},
                   {"mode", 5},
                   {"material", 0}});
    const std::size_t deltas = file.positions(std::vector<glm::vec3>(4, glm::vec3(0, 1, 0)));
    file.json["meshes"][skinned]["primitives"][0]["targets"] = {
        {{"POSITION", deltas}, {"NORMAL", normal}}};
    file.json["meshes"][skinned]["weights"] = {0.5};
    const std::size_t matrices = file.accessor_of(bind, f32, "MAT4", 16);
    const std::vector<std::uint8_t> pixel{200, 100, 50, 255};
    const std::size_t image = file.view(make_png(1, 1, pixel));
    file.json["images"] = {{{"bufferView", image}, {"mimeType", "image/png"}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}};
    file.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    const std::size_t joint = file.root({{"translation", {1, 2, 3}}, {"camera", 0}});
    file.json["skins"] = {{{"joints", {joint}}, {"inverseBindMatrices", matrices}}};
    const std::size_t body = file.root({{"mesh", skinned}, {"skin", 0}, {"weights", {0.25}}});
    const std::vector<float> two_times{0, 1};
    const std::vector<float> turns{0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0,
                                   0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0};
    const std::vector<std::uint8_t> blends{0, 255};
    const std::size_t times = file.accessor_of(two_times, f32, "SCALAR", 1);
    const std::size_t turning = file.accessor_of(turns, f32, "VEC4", 4);
    const std::size_t blending = file.accessor_of(blends, u8, "SCALAR", 1);
    file.json["accessors"][blending]["normalized"] = true;
    file.json["animations"] = {
        {{"samplers",
          {{{"input", times}, {"output", turning}, {"interpolation", "CUBICSPLINE"}},
           {{"input", times}, {"output", blending}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", joint}, {"path", "rotation"}}}},
           {{"sampler", 1}, {"target", {{"node", body}, {"path", "weights"}}}}}}}};
    file.root({{"mesh", skinned},
               {"extensions",
                {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", position}}}}},
                 {"KHR_lights_punctual", {{"light", 0}}}}}});
    return file;
}

/// What loads can be played, or says why not.
void play(Scene& scene) {
    for (const double time_s : {0.0, 0.3, 1.0, 17.9}) {
        if (!scene.animations.empty()) {
            ASSERT_TRUE(animate(scene, 0, time_s));
        }
        const Status deformed = deform(scene);
        if (!deformed) {
            ASSERT_THAT(deformed.error().message, testing::StartsWith("Node \""));
        }
        scene.registry.each<Deformed>([](Entity, const Deformed& instance) {
            ASSERT_EQ(instance.positions.size(), instance.mesh->positions.size());
            for (const glm::vec3& p : instance.positions) {
                ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
            }
        });
    }
}

void expect_loads_or_says_why(const Bytes& bytes) {
    // A copy of its exact size: a read beyond its end is then one that a sanitizer sees.
    const Bytes exact(bytes.begin(), bytes.end());
    auto scene = load_glb(exact, "broken.glb");
    if (scene) {
        scene->registry.each<MeshInstance>([](Entity, const MeshInstance& instance) {
            ASSERT_TRUE(instance.mesh);
            for (const std::uint32_t index : instance.mesh->indices) {
                ASSERT_LT(index, instance.mesh->positions.size());
            }
        });
        play(*scene);
        return;
    }
    const std::string& message = scene.error().message;
    ASSERT_EQ(scene.error().code, ErrorCode::InvalidInput) << message;
    ASSERT_THAT(message, testing::StartsWith("broken.glb: "));
    ASSERT_THAT(message, testing::EndsWith("."));
    ASSERT_EQ(message.find('\n'), std::string::npos) << message;
    ASSERT_LT(message.size(), 500U);
}

TEST(GltfRobustness, the_file_itself_is_good) {
    const auto scene = rich_file().load();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->registry.count<MeshInstance>(), 1U + 1U + 4U);
    ASSERT_EQ(scene->materials.size(), 2U);
    EXPECT_TRUE(scene->materials[1].base_color_image);
    EXPECT_EQ(scene->animations.at(0).channels.size(), 2U);
    EXPECT_EQ(scene->registry.count<Deformed>(), 1U + 4U);
}

TEST(GltfRobustness, every_prefix_is_refused) {
    const Bytes good = rich_file().glb();
    for (std::size_t size = 0; size < good.size(); ++size) {
        const Bytes prefix(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
        const auto scene = load_glb(prefix, "broken.glb");
        ASSERT_FALSE(scene) << size << " of " << good.size() << " bytes";
        ASSERT_THAT(scene.error().message, testing::StartsWith("broken.glb: "));
    }
}

TEST(GltfRobustness, every_prefix_with_a_corrected_length) {
    const Bytes good = rich_file().glb();
    for (std::size_t size = 12; size < good.size(); ++size) {
        Bytes prefix(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
        for (std::size_t i = 0; i < 4; ++i) prefix[8 + i] = static_cast<std::byte>(size >> (8 * i));
        expect_loads_or_says_why(prefix);
        if (HasFatalFailure()) FAIL() << "at size " << size;
    }
}

class Flips : public testing::TestWithParam<unsigned> {};

TEST_P(Flips, changed_bytes) {
    const unsigned seed = GetParam();
    std::mt19937 random(seed);
    const Bytes good = rich_file().glb();
    for (int round = 0; round < 2'000; ++round) {
        Bytes bad = good;
        const std::size_t changes = 1 + random() % 4;
        for (std::size_t i = 0; i < changes; ++i) {
            bad[random() % bad.size()] = static_cast<std::byte>(random());
        }
        expect_loads_or_says_why(bad);
        if (HasFatalFailure()) FAIL() << "seed " << seed << ", round " << round;
    }
}

TEST_P(Flips, changed_digits) {
    const unsigned seed = GetParam();
    std::mt19937 random(seed);
    const GltfBuilder file = rich_file();
    const Bytes good = file.glb();
    // Numbers changed within the JSON parse, so that they reach what lies behind the parser.
    std::vector<std::size_t> digits;
    for (std::size_t i = 20; i < good.size() - file.buffer().size() - 8; ++i) {
        const char c = static_cast<char>(good[i]);
        if (c >= '0' && c <= '9') digits.push_back(i);
    }
    for (int round = 0; round < 4'000; ++round) {
        Bytes bad = good;
        const std::size_t changes = 1 + random() % 3;
        for (std::size_t i = 0; i < changes; ++i) {
            bad[digits[random() % digits.size()]] = static_cast<std::byte>('0' + random() % 10);
        }
        expect_loads_or_says_why(bad);
        if (HasFatalFailure()) FAIL() << "seed " << seed << ", round " << round;
    }
}

TEST_P(Flips, changed_values) {
    const unsigned seed = GetParam();
    std::mt19937 random(seed);
    const GltfBuilder good = rich_file();
    const Json flat = good.json.flatten();
    std::vector<std::string> places;
    for (const auto& item : flat.items()) places.push_back(item.key());
    const std::vector<Json> values{nullptr,
                                   true,
                                   -1,
                                   0,
                                   1,
                                   7,
                                   255,
                                   65536,
                                   4294967295U,
                                   1e30,
                                   -0.5,
                                   "text",
                                   Json::array(),
                                   Json::object(),
                                   {1, 2, 3},
                                   9007199254740993};
    for (int round = 0; round < 3'000; ++round) {
        GltfBuilder bad = good;
        const std::size_t changes = 1 + random() % 2;
        for (std::size_t i = 0; i < changes; ++i) {
            std::string place = places[random() % places.size()];
            // Now and then a whole branch rather than a leaf.
            while (random() % 3 == 0 && place.rfind('/') > 0) place.resize(place.rfind('/'));
            const Json::json_pointer pointer(place);
            if (bad.json.contains(pointer)) bad.json[pointer] = values[random() % values.size()];
        }
        expect_loads_or_says_why(bad.glb());
        if (HasFatalFailure()) FAIL() << "seed " << seed << ", round " << round;
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Flips, testing::Values(1U, 2U, 3U, 20240607U));

}  // namespace
}  // namespace gnomon::scene::test
