// SPDX-License-Identifier: MIT
//
// Materials, images, and where a glTF file's other files may lie.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "tests/scene/gltf_builder.hpp"
#include "tests/support/paths.hpp"

namespace gnomon::scene::test {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

const std::vector<std::uint8_t> four_pixels{255, 0, 0,   255, 0,  255, 0,  128,
                                            0,   0, 255, 0,   10, 20,  30, 40};

class GltfFolder : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = gnomon::test::output_folder() / "scene" / info->name();
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "inner");
    }
    void write(const fs::path& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    void write(const fs::path& name, const Bytes& bytes) const {
        write(name, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    }
    fs::path folder_;
};

TEST_F(GltfFolder, buffers_beside_the_file_below_it_and_inside_it) {
    const GltfBuilder file = triangle_file();
    write("plain.bin", file.buffer());
    write("inner/a b+c%.bin", file.buffer());
    for (const std::string& uri :
         {std::string("plain.bin"), std::string("inner/a%20b+c%25.bin"), file.data_uri()}) {
        SCOPED_TRACE(uri);
        write("test.gltf", file.gltf(uri));
        const auto scene = load_gltf(folder_ / "test.gltf");
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(only_mesh(*scene)->positions[1], glm::vec3(1, 0, 0));
    }
}

TEST_F(GltfFolder, buffers_elsewhere_are_refused) {
    const GltfBuilder file = triangle_file();
    write("plain.bin", file.buffer());
    const std::string absolute = (folder_ / "plain.bin").string();
    for (const std::string& uri :
         {std::string("../plain.bin"), std::string("%2e%2e/plain.bin"), absolute,
          "file://" + absolute, std::string("https://example.org/plain.bin"),
          std::string("..\\plain.bin"), std::string("plain.bin%00"), std::string("%zz")}) {
        SCOPED_TRACE(uri);
        write("inner/test.gltf", file.gltf(uri));
        const auto scene = load_gltf(folder_ / "inner/test.gltf");
        ASSERT_FALSE(scene);
        EXPECT_EQ(scene.error().code, ErrorCode::InvalidInput);
        EXPECT_THAT(scene.error().message, HasSubstr("buffers[0].uri"));
    }
}

TEST_F(GltfFolder, missing_and_short_files_say_which) {
    const GltfBuilder file = triangle_file();
    write("test.gltf", file.gltf("missing.bin"));
    auto scene = load_gltf(folder_ / "test.gltf");
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().code, ErrorCode::Io);
    EXPECT_THAT(scene.error().message, HasSubstr("missing.bin"));

    write("test.gltf", file.gltf("inner"));
    scene = load_gltf(folder_ / "test.gltf");
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().code, ErrorCode::Io);
    EXPECT_THAT(scene.error().message, HasSubstr("not a regular file"));

    write("short.bin", std::string("1234567"));
    write("test.gltf", file.gltf("short.bin"));
    scene = load_gltf(folder_ / "test.gltf");
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, HasSubstr("at most 7"));

    scene = load_gltf(folder_ / "nothing.glb");
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().code, ErrorCode::Io);
    EXPECT_THAT(scene.error().message, HasSubstr("nothing.glb"));
}

TEST(GltfAssets, a_file_in_memory_has_no_neighbours) {
    const GltfBuilder file = triangle_file();
    const auto scene = load_glb(make_glb(file.gltf("plain.bin"), {}), "test.glb");
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, HasSubstr("read from memory"));
}

TEST(GltfAssets, materials) {
    GltfBuilder file = triangle_file();
    file.json["materials"] = {{{"name", "full"},
                               {"pbrMetallicRoughness",
                                {{"baseColorFactor", {0.5, 0.25, 0.125, 1}},
                                 {"metallicFactor", 0.75},
                                 {"roughnessFactor", 0.5}}},
                               {"emissiveFactor", {0.25, 0.5, 1}},
                               {"alphaMode", "MASK"},
                               {"alphaCutoff", 0.25},
                               {"doubleSided", true},
                               {"extensions", {{"KHR_materials_unlit", Json::object()}}}},
                              {{"name", "plain"}},
                              {{"alphaMode", "BLEND"}}};
    const auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->materials.size(), 4U);
    const Material& full = scene->materials[1];
    EXPECT_EQ(full.name, "full");
    EXPECT_EQ(full.base_color, glm::vec4(0.5F, 0.25F, 0.125F, 1.0F));
    EXPECT_EQ(full.metallic, 0.75F);
    EXPECT_EQ(full.roughness, 0.5F);
    EXPECT_EQ(full.emissive, glm::vec3(0.25F, 0.5F, 1.0F));
    EXPECT_EQ(full.alpha_mode, AlphaMode::Mask);
    EXPECT_EQ(full.alpha_cutoff, 0.25F);
    EXPECT_TRUE(full.double_sided);
    const Material& plain = scene->materials[2];
    EXPECT_EQ(plain.base_color, glm::vec4(1.0F));
    EXPECT_EQ(plain.metallic, 1.0F);
    EXPECT_EQ(plain.roughness, 1.0F);
    EXPECT_EQ(plain.alpha_mode, AlphaMode::Opaque);
    EXPECT_FALSE(plain.double_sided);
    EXPECT_EQ(scene->materials[3].alpha_mode, AlphaMode::Blend);
}

/// A triangle whose material has a base colour texture; `image` is the image's members.
GltfBuilder textured_file(GltfBuilder file, const Json& image) {
    file.json["images"] = {image};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    return file;
}

TEST_F(GltfFolder, images_are_decoded_from_a_view_a_data_uri_and_a_file) {
    const Bytes png = make_png(2, 2, four_pixels);
    const auto check = [](const Result<Scene>& scene) {
        ASSERT_TRUE(scene) << scene.error().message;
        const auto& image = scene->materials[1].base_color_image;
        ASSERT_TRUE(image) << testing::PrintToString(scene->messages);
        EXPECT_EQ(image->width, 2U);
        EXPECT_EQ(image->height, 2U);
        EXPECT_EQ(image->rgba, four_pixels);
    };
    GltfBuilder in_view = triangle_file();
    const std::size_t view = in_view.view(png);
    check(textured_file(in_view, {{"bufferView", view}, {"mimeType", "image/png"}}).load());

    GltfBuilder encoder;
    encoder.view(png);
    check(textured_file(triangle_file(), {{"uri", encoder.data_uri()}}).load());

    const GltfBuilder beside = textured_file(triangle_file(), {{"uri", "a%20picture.png"}});
    write("a picture.png", png);
    write("test.gltf", beside.gltf(beside.data_uri()));
    check(load_gltf(folder_ / "test.gltf"));
}

TEST(GltfAssets, an_image_that_is_not_there_or_broken_is_a_message) {
    const auto check = [](const GltfBuilder& file, const char* reason) {
        SCOPED_TRACE(reason);
        const auto scene = file.load();
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_FALSE(scene->materials[1].base_color_image);
        EXPECT_THAT(scene->messages,
                    Contains(testing::AllOf(HasSubstr("images[0]"), HasSubstr(reason))));
    };
    check(textured_file(triangle_file(), {{"uri", "missing.png"}}), "from memory");
    check(textured_file(triangle_file(), {{"uri", "../up.png"}}), "not a path");
    check(textured_file(triangle_file(), {{"uri", "data:image/png;base64,*"}}), "base64");
    check(textured_file(triangle_file(), {{"uri", "data:image/png;base64,AAAA"}}), "neither");

    Bytes png = make_png(2, 2, four_pixels);
    Bytes cut(png.begin(), png.begin() + 40);
    GltfBuilder file = triangle_file();
    const std::size_t cut_view = file.view(cut);
    check(textured_file(file, {{"bufferView", cut_view}}), "cannot be decoded");

    png[16] = std::byte{0x7F};  // two thousand million pixels wide
    file = triangle_file();
    const std::size_t huge_view = file.view(png);
    check(textured_file(file, {{"bufferView", huge_view}}), "claims");
}

TEST(GltfAssets, what_a_texture_cannot_do_is_a_message) {
    GltfBuilder file = triangle_file();
    const std::size_t view = file.view(make_png(2, 2, four_pixels));
    file = textured_file(file, {{"bufferView", view}});
    file.json["extensionsRequired"] = {"KHR_texture_transform"};
    auto& info = file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    info["extensions"]["KHR_texture_transform"]["offset"] = {0.5, 0.5};
    auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->materials[1].base_color_image);
    EXPECT_THAT(scene->messages, Contains(HasSubstr("KHR_texture_transform")));

    info["texCoord"] = 1;
    scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_FALSE(scene->materials[1].base_color_image);
    EXPECT_THAT(scene->messages, Contains(HasSubstr("texture coordinates 1")));

    info.erase("texCoord");
    file.json["textures"][0].erase("source");
    scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(scene->messages, Contains(HasSubstr("textures[0]")));
}

}  // namespace
}  // namespace gnomon::scene::test
