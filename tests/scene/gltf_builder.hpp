// SPDX-License-Identifier: MIT
//
// GltfBuilder: makes small glTF files by hand, right or wrong.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <gnomon/scene/gltf.hpp>

namespace gnomon::scene::test {

using Json = nlohmann::json;
using Bytes = std::vector<std::byte>;

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
    Bytes bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

constexpr int i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126;

class GltfBuilder {
public:
    GltfBuilder();

    Json json;  ///< everything but the buffer's length, to be changed at will

    /// Each adds one and returns its index.
    std::size_t view(const Bytes& bytes, std::size_t stride = 0);
    std::size_t accessor(std::size_t view, int component, const char* type, std::size_t count,
                         std::size_t offset = 0);
    template <class T>
    std::size_t accessor_of(const std::vector<T>& values, int component, const char* type,
                            std::size_t components_per_element) {
        return accessor(view(bytes_of(values)), component, type,
                        values.size() / components_per_element);
    }
    std::size_t positions(const std::vector<glm::vec3>& values);
    std::size_t indices(const std::vector<std::uint16_t>& values);
    /// A mesh of one primitive.
    std::size_t mesh(const Json& primitive);
    /// A node in scene 0; `json` is its members.
    std::size_t root(const Json& node);
    std::size_t node(const Json& node);

    [[nodiscard]] Bytes glb() const;
    /// A .gltf whose buffer has this uri; the bytes go to `buffer`.
    [[nodiscard]] std::string gltf(const std::string& uri) const;
    [[nodiscard]] const Bytes& buffer() const { return buffer_; }
    /// data:application/octet-stream;base64,…
    [[nodiscard]] std::string data_uri() const;

    [[nodiscard]] Result<Scene> load(const GltfOptions& options = {}) const;

private:
    Bytes buffer_;
};

/// Puts any JSON text and binary chunk into a .glb.
[[nodiscard]] Bytes make_glb(const std::string& json, const Bytes& binary);

/// One right-angled triangle in the XY plane, indexed.
[[nodiscard]] GltfBuilder triangle_file();

/// The only mesh of a scene; fails the test when there is not exactly one.
[[nodiscard]] std::shared_ptr<const Mesh> only_mesh(const Scene& scene);
[[nodiscard]] Entity find_entity(const Scene& scene, const std::string& name);

/// An uncompressed PNG of 8-bit RGBA pixels.
[[nodiscard]] Bytes make_png(std::uint32_t width, std::uint32_t height,
                             std::span<const std::uint8_t> rgba);

}  // namespace gnomon::scene::test
