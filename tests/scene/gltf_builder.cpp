// SPDX-License-Identifier: MIT
#include "tests/scene/gltf_builder.hpp"

#include <gtest/gtest.h>

namespace gnomon::scene::test {
namespace {

void put_u32(Bytes& bytes, std::uint32_t value) {
    for (unsigned i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
}

void put_u32_big_endian(Bytes& bytes, std::uint32_t value) {
    for (unsigned i = 4; i-- > 0;) bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
}

std::uint32_t crc32(std::span<const std::byte> bytes) {
    std::uint32_t crc = 0xFFFF'FFFFU;
    for (const std::byte byte : bytes) {
        crc ^= std::to_integer<std::uint32_t>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ (0xEDB8'8320U & (0U - (crc & 1U)));
    }
    return ~crc;
}

void put_png_chunk(Bytes& png, const char* type, const Bytes& data) {
    put_u32_big_endian(png, static_cast<std::uint32_t>(data.size()));
    const std::size_t start = png.size();
    for (int i = 0; i < 4; ++i) png.push_back(static_cast<std::byte>(type[i]));
    png.insert(png.end(), data.begin(), data.end());
    put_u32_big_endian(png, crc32(std::span(png).subspan(start)));
}

}  // namespace

GltfBuilder::GltfBuilder()
    : json{{"asset", {{"version", "2.0"}}},
           {"scene", 0},
           {"scenes", Json::array({{{"nodes", Json::array()}}})},
           {"nodes", Json::array()},
           {"meshes", Json::array()},
           {"accessors", Json::array()},
           {"bufferViews", Json::array()}} {}

std::size_t GltfBuilder::view(const Bytes& bytes, std::size_t stride) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    Json view{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
    if (stride != 0) view["byteStride"] = stride;
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    json["bufferViews"].push_back(view);
    return json["bufferViews"].size() - 1;
}

std::size_t GltfBuilder::accessor(std::size_t view, int component, const char* type,
                                  std::size_t count, std::size_t offset) {
    json["accessors"].push_back({{"bufferView", view},
                                 {"byteOffset", offset},
                                 {"componentType", component},
                                 {"type", type},
                                 {"count", count}});
    return json["accessors"].size() - 1;
}

std::size_t GltfBuilder::positions(const std::vector<glm::vec3>& values) {
    return accessor(view(bytes_of(values)), f32, "VEC3", values.size());
}

std::size_t GltfBuilder::indices(const std::vector<std::uint16_t>& values) {
    return accessor(view(bytes_of(values)), u16, "SCALAR", values.size());
}

std::size_t GltfBuilder::mesh(const Json& primitive) {
    json["meshes"].push_back({{"primitives", Json::array({primitive})}});
    return json["meshes"].size() - 1;
}

std::size_t GltfBuilder::root(const Json& members) {
    const std::size_t index = node(members);
    json["scenes"][0]["nodes"].push_back(index);
    return index;
}

std::size_t GltfBuilder::node(const Json& members) {
    json["nodes"].push_back(members);
    return json["nodes"].size() - 1;
}

Bytes GltfBuilder::glb() const {
    Json document = json;
    if (!buffer_.empty() && !document.contains("buffers")) {
        document["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});
    }
    return make_glb(document.dump(), buffer_);
}

std::string GltfBuilder::gltf(const std::string& uri) const {
    Json document = json;
    document["buffers"] = Json::array({{{"byteLength", buffer_.size()}, {"uri", uri}}});
    return document.dump();
}

std::string GltfBuilder::data_uri() const {
    constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text = "data:application/octet-stream;base64,";
    for (std::size_t i = 0; i < buffer_.size(); i += 3) {
        std::uint32_t bits = 0;
        const std::size_t left = std::min<std::size_t>(3, buffer_.size() - i);
        for (std::size_t k = 0; k < left; ++k) {
            bits |= std::to_integer<std::uint32_t>(buffer_[i + k]) << (16 - 8 * k);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += k <= left ? alphabet[(bits >> (18 - 6 * k)) & 63U] : '=';
        }
    }
    return text;
}

Result<Scene> GltfBuilder::load(const GltfOptions& options) const {
    return load_glb(glb(), "test.glb", options);
}

Bytes make_glb(const std::string& text, const Bytes& binary) {
    const std::size_t json_size = (text.size() + 3) / 4 * 4;
    const std::size_t binary_size = (binary.size() + 3) / 4 * 4;
    Bytes glb;
    put_u32(glb, 0x46546C67);
    put_u32(glb, 2);
    put_u32(glb, static_cast<std::uint32_t>(12 + 8 + json_size +
                                            (binary.empty() ? 0 : 8 + binary_size)));
    put_u32(glb, static_cast<std::uint32_t>(json_size));
    put_u32(glb, 0x4E4F534A);
    for (const char c : text) glb.push_back(static_cast<std::byte>(c));
    glb.resize(20 + json_size, static_cast<std::byte>(' '));
    if (binary.empty()) return glb;
    put_u32(glb, static_cast<std::uint32_t>(binary_size));
    put_u32(glb, 0x004E4942);
    glb.insert(glb.end(), binary.begin(), binary.end());
    glb.resize(28 + json_size + binary_size);
    return glb;
}

GltfBuilder triangle_file() {
    GltfBuilder file;
    const std::size_t position = file.positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const std::size_t index = file.indices({0, 1, 2});
    file.mesh({{"attributes", {{"POSITION", position}}}, {"indices", index}});
    file.root({{"mesh", 0}, {"name", "triangle"}});
    return file;
}

std::shared_ptr<const Mesh> only_mesh(const Scene& scene) {
    std::shared_ptr<const Mesh> mesh;
    std::size_t count = 0;
    scene.registry.each<MeshInstance>([&](Entity, const MeshInstance& instance) {
        mesh = instance.mesh;
        ++count;
    });
    EXPECT_EQ(count, 1U);
    return mesh;
}

Entity find_entity(const Scene& scene, const std::string& name) {
    Entity found;
    std::size_t count = 0;
    scene.registry.each<Name>([&](Entity entity, const Name& its_name) {
        if (its_name.value != name) return;
        found = entity;
        ++count;
    });
    EXPECT_EQ(count, 1U) << "entities named " << name;
    return found;
}

Bytes make_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba) {
    Bytes png;
    for (const int byte : {0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A}) {
        png.push_back(static_cast<std::byte>(byte));
    }
    Bytes header;
    put_u32_big_endian(header, width);
    put_u32_big_endian(header, height);
    for (const int byte : {8, 6, 0, 0, 0}) header.push_back(static_cast<std::byte>(byte));
    put_png_chunk(png, "IHDR", header);

    Bytes raw;  // each row begins with its filter, none
    for (std::size_t y = 0; y < height; ++y) {
        raw.push_back(std::byte{0});
        for (std::size_t x = 0; x < std::size_t{width} * 4; ++x) {
            raw.push_back(static_cast<std::byte>(rgba[y * width * 4 + x]));
        }
    }
    Bytes zlib{std::byte{0x78}, std::byte{0x01}, std::byte{0x01}};  // one stored block
    const auto length = static_cast<std::uint32_t>(raw.size());
    for (const std::uint32_t value : {length, ~length}) {
        zlib.push_back(static_cast<std::byte>(value));
        zlib.push_back(static_cast<std::byte>(value >> 8U));
    }
    zlib.insert(zlib.end(), raw.begin(), raw.end());
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const std::byte byte : raw) {
        a = (a + std::to_integer<std::uint32_t>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    put_u32_big_endian(zlib, (b << 16U) | a);
    put_png_chunk(png, "IDAT", zlib);
    put_png_chunk(png, "IEND", {});
    return png;
}

}  // namespace gnomon::scene::test
