// SPDX-License-Identifier: MIT
#include "internal/gltf_check.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "internal/data_uri.hpp"
#include "internal/gltf_format.hpp"

namespace gnomon::scene::internal {
namespace {

constexpr std::array<std::string_view, 5> understood_extensions{
    "KHR_lights_punctual", "KHR_mesh_quantization", "EXT_mesh_gpu_instancing",
    "KHR_materials_unlit", "KHR_texture_transform"};

std::optional<ElementShape> shape_of(std::string_view type) {
    if (type == "SCALAR") return ElementShape{1, 1};
    if (type == "VEC2") return ElementShape{2, 1};
    if (type == "VEC3") return ElementShape{3, 1};
    if (type == "VEC4") return ElementShape{4, 1};
    if (type == "MAT2") return ElementShape{2, 2};
    if (type == "MAT3") return ElementShape{3, 3};
    if (type == "MAT4") return ElementShape{4, 4};
    return std::nullopt;
}

std::uint64_t whole_or(const JsonPlace& place, const char* name, std::uint64_t otherwise,
                       std::uint64_t max = largest_file) {
    const auto found = place.find(name);
    return found ? found->whole(0, max) : otherwise;
}

void check_asset(const JsonPlace& root) {
    const JsonPlace version = root.member("asset").object().member("version");
    if (version.text().substr(0, 2) != "2.") version.must_be("2.x: other versions are not read");
    if (const auto extensions = root.find("extensionsRequired")) {
        extensions->array();
        for (std::size_t i = 0; i < extensions->size(); ++i) {
            const std::string& name = extensions->at(i).text();
            if (std::find(understood_extensions.begin(), understood_extensions.end(), name) ==
                understood_extensions.end()) {
                extensions->at(i).refuse(
                    fmt::format("is \"{}\", an extension that this reader does not understand; it "
                                "understands {}",
                                name, fmt::join(understood_extensions, ", ")));
            }
        }
    }
    if (const auto extensions = root.find("extensionsUsed")) {
        extensions->array();
        for (std::size_t i = 0; i < extensions->size(); ++i) {
            static_cast<void>(extensions->at(i).text());
        }
    }
}

void check_buffer(const JsonPlace& buffer, std::size_t index, const GltfFile& file) {
    const std::uint64_t length = buffer.member("byteLength").whole(1, largest_file);
    if (const auto uri = buffer.find("uri")) {
        static_cast<void>(uri->text());
        return;
    }
    if (index != 0 || !file.binary_chunk) {
        buffer.refuse("has neither a \"uri\" nor the binary chunk of a .glb to read from");
    }
    if (length > file.binary_chunk->size()) {
        buffer.member("byteLength")
            .must_be(
                fmt::format("at most {}, the size of the binary chunk", file.binary_chunk->size()));
    }
}

void check_buffer_view(const JsonPlace& root, const JsonPlace& view) {
    const std::size_t buffer = check_reference(root, view.member("buffer"), "buffers");
    const std::uint64_t size =
        root.member("buffers").at(buffer).member("byteLength").whole(1, largest_file);
    const std::uint64_t offset = whole_or(view, "byteOffset", 0);
    const std::uint64_t length = view.member("byteLength").whole(1, largest_file);
    if (offset + length > size) {
        view.refuse(fmt::format("reaches byte {}, but buffers[{}] has only {}", offset + length,
                                buffer, size));
    }
    if (const auto stride = view.find("byteStride")) {
        if (stride->whole(4, 252) % 4 != 0) stride->must_be("a multiple of 4");
    }
}

/// Refuses bytes [offset, offset + …) of a view that do not hold `count` elements.
void check_range(const JsonPlace& root, const JsonPlace& user, std::size_t view_index,
                 std::uint64_t offset, std::uint64_t count, std::size_t element_bytes,
                 std::size_t component_bytes, bool strided) {
    const JsonPlace view = root.member("bufferViews").at(view_index);
    const std::uint64_t stride =
        strided ? whole_or(view, "byteStride", element_bytes) : element_bytes;
    if (stride < element_bytes) {
        view.member("byteStride")
            .must_be(fmt::format("at least {}, the size of an element of {}", element_bytes,
                                 user.path()));
    }
    if ((offset + whole_or(view, "byteOffset", 0)) % component_bytes != 0 ||
        stride % component_bytes != 0) {
        user.refuse(fmt::format("does not lie on multiples of {} bytes, the size of its components",
                                component_bytes));
    }
    const std::uint64_t end = offset + stride * (count - 1) + element_bytes;
    const std::uint64_t length = view.member("byteLength").whole(1, largest_file);
    if (end > length) {
        user.refuse(fmt::format("reaches byte {}, but bufferViews[{}] has only {}", end, view_index,
                                length));
    }
}

void check_sparse(const JsonPlace& root, const JsonPlace& sparse, std::uint64_t accessor_count,
                  std::size_t element_bytes, std::size_t component_bytes) {
    const std::uint64_t count = sparse.member("count").whole(1, accessor_count);
    const JsonPlace indices = sparse.member("indices").object();
    const auto type = static_cast<int>(indices.member("componentType").whole(0, 65535));
    if (type != 5121 && type != 5123 && type != 5125) {
        indices.member("componentType").must_be("5121, 5123 or 5125");
    }
    check_range(root, indices, check_reference(root, indices.member("bufferView"), "bufferViews"),
                whole_or(indices, "byteOffset", 0), count, component_size(type),
                component_size(type), false);
    const JsonPlace values = sparse.member("values").object();
    check_range(root, values, check_reference(root, values.member("bufferView"), "bufferViews"),
                whole_or(values, "byteOffset", 0), count, element_bytes, component_bytes, false);
}

void check_accessor(const JsonPlace& root, const JsonPlace& accessor,
                    std::uint64_t all_buffer_bytes) {
    const JsonPlace component = accessor.member("componentType");
    const std::size_t component_bytes = component_size(static_cast<int>(component.whole(0, 65535)));
    if (component_bytes == 0) component.must_be("5120, 5121, 5122, 5123, 5125 or 5126");
    const JsonPlace type = accessor.member("type");
    const auto shape = shape_of(type.text());
    if (!shape) type.must_be("SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
    if (const auto normalized = accessor.find("normalized")) {
        static_cast<void>(normalized->boolean());
    }
    const std::uint64_t count = accessor.member("count").whole(1, largest_file);
    const std::size_t element_bytes = shape->bytes(component_bytes);
    const std::uint64_t offset = whole_or(accessor, "byteOffset", 0);
    if (const auto view = accessor.find("bufferView")) {
        check_range(root, accessor, check_reference(root, *view, "bufferViews"), offset, count,
                    element_bytes, component_bytes, true);
    } else if (count > all_buffer_bytes) {
        // All its elements are zero and cost the file nothing: without a limit, a file of a hundred
        // bytes could ask for any amount of memory.
        accessor.member("count").must_be(
            fmt::format("at most {}, the bytes of all buffers, where there is no bufferView",
                        all_buffer_bytes));
    }
    if (const auto sparse = accessor.find("sparse")) {
        check_sparse(root, sparse->object(), count, element_bytes, component_bytes);
    }
}

void check_image(const JsonPlace& root, const JsonPlace& image) {
    if (const auto uri = image.find("uri")) static_cast<void>(uri->text());
    if (const auto view = image.find("bufferView")) check_reference(root, *view, "bufferViews");
}

void check_texture_info(const JsonPlace& root, const JsonPlace& owner, const char* name) {
    const auto info = owner.find(name);
    if (!info) return;
    check_reference(root, info->object().member("index"), "textures");
    whole_or(*info, "texCoord", 0, 255);
    static_cast<void>(find_extension(*info, "KHR_texture_transform"));
}

void check_material(const JsonPlace& root, const JsonPlace& material) {
    if (const auto pbr = material.find("pbrMetallicRoughness")) {
        pbr->object();
        if (const auto color = pbr->find("baseColorFactor")) {
            static_cast<void>(color->numbers(4, 0.0));
        }
        for (const char* name : {"metallicFactor", "roughnessFactor"}) {
            if (const auto factor = pbr->find(name)) static_cast<void>(factor->number(0.0, 1.0));
        }
        check_texture_info(root, *pbr, "baseColorTexture");
        check_texture_info(root, *pbr, "metallicRoughnessTexture");
    }
    for (const char* name : {"normalTexture", "occlusionTexture", "emissiveTexture"}) {
        check_texture_info(root, material, name);
    }
    if (const auto emissive = material.find("emissiveFactor")) {
        static_cast<void>(emissive->numbers(3, 0.0));
    }
    if (const auto mode = material.find("alphaMode")) mode->one_of({"OPAQUE", "MASK", "BLEND"});
    if (const auto cutoff = material.find("alphaCutoff")) static_cast<void>(cutoff->number(0.0));
    if (const auto both = material.find("doubleSided")) static_cast<void>(both->boolean());
    static_cast<void>(find_extension(material, "KHR_materials_unlit"));
}

/// Morph targets: as many deltas as the primitive has vertices.
void check_targets(const JsonPlace& root, const JsonPlace& targets, std::uint64_t vertex_count) {
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const JsonPlace target = targets.at(i).object();
        for (const auto& item : target.value().items()) {
            const JsonPlace reference = target.member(item.key());
            const bool is_read = item.key() == "POSITION" || item.key() == "NORMAL";
            if (!is_read) {
                check_reference(root, reference, "accessors");
                continue;
            }
            const std::uint64_t count =
                check_accessor_kind(root, reference, "VEC3", {5126, 5120, 5122});
            if (count != vertex_count) {
                reference.refuse(fmt::format("has {} elements, but the primitive has {} vertices",
                                             count, vertex_count));
            }
        }
    }
}

void check_primitive(const JsonPlace& root, const JsonPlace& primitive) {
    if (const auto mode = primitive.find("mode")) static_cast<void>(mode->whole(0, 6));
    if (const auto material = primitive.find("material")) {
        check_reference(root, *material, "materials");
    }
    if (const auto indices = primitive.find("indices")) {
        const std::size_t accessor = check_reference(root, *indices, "accessors");
        check_accessor_kind(root, *indices, "SCALAR", {5121, 5123, 5125});
        if (!root.member("accessors").at(accessor).has("bufferView")) {
            // Legal, but tinygltf cannot read it; nobody writes indices that are all zero.
            root.member("accessors").at(accessor).refuse("holds indices but has no bufferView");
        }
    }
    const JsonPlace attributes = primitive.member("attributes").object();
    std::optional<std::uint64_t> vertex_count;
    for (const auto& item : attributes.value().items()) {
        const JsonPlace reference = attributes.member(item.key());
        const std::size_t accessor = check_reference(root, reference, "accessors");
        const std::uint64_t count =
            root.member("accessors").at(accessor).member("count").whole(1, largest_file);
        if (vertex_count && count != *vertex_count) {
            reference.refuse(
                fmt::format("has {} elements, but another attribute has {}", count, *vertex_count));
        }
        vertex_count = count;
    }
    const auto check = [&](const char* name, std::string_view type,
                           std::initializer_list<int> components) {
        if (const auto reference = attributes.find(name)) {
            check_accessor_kind(root, *reference, type, components);
        }
    };
    check("POSITION", "VEC3", {5126, 5120, 5121, 5122, 5123});
    check("NORMAL", "VEC3", {5126, 5120, 5122});
    check("TEXCOORD_0", "VEC2", {5126, 5120, 5121, 5122, 5123});
    for (const auto& item : attributes.value().items()) {
        const JsonPlace reference = attributes.member(item.key());
        if (item.key().starts_with("JOINTS_")) {
            check_accessor_kind(root, reference, "VEC4", {5121, 5123});
        } else if (item.key().starts_with("WEIGHTS_")) {
            check_accessor_kind(root, reference, "VEC4", {5126, 5121, 5123});
        }
    }
    if (const auto targets = primitive.find("targets")) {
        check_targets(root, targets->array(), vertex_count.value_or(0));
    }
}

std::size_t target_count(const JsonPlace& primitive) {
    const auto targets = primitive.find("targets");
    return targets && targets->value().is_array() ? targets->size() : 0;
}

void check_mesh(const JsonPlace& root, const JsonPlace& mesh) {
    const JsonPlace primitives = mesh.member("primitives").array();
    const std::size_t targets = morph_target_count(mesh);
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        check_primitive(root, primitives.at(i).object());
        const std::size_t its_targets = target_count(primitives.at(i));
        if (its_targets != targets) {
            primitives.at(i).refuse(
                fmt::format("has {} morph targets, but the mesh's first "
                            "primitive has {}",
                            its_targets, targets));
        }
    }
    if (const auto weights = mesh.find("weights")) check_morph_weights(*weights, targets);
}

}  // namespace

std::vector<JsonPlace> elements_of(const JsonPlace& root, const std::string& array) {
    std::vector<JsonPlace> result;
    const auto found = root.find(array);
    if (!found) return result;
    found->array();
    result.reserve(found->size());
    for (std::size_t i = 0; i < found->size(); ++i) {
        result.push_back(found->at(i).object());
        if (const auto name = result.back().find("name")) static_cast<void>(name->text());
        if (const auto extensions = result.back().find("extensions")) extensions->object();
    }
    return result;
}

std::size_t morph_target_count(const JsonPlace& mesh) {
    const auto primitives = mesh.find("primitives");
    if (!primitives || !primitives->value().is_array() || primitives->size() == 0) return 0;
    return target_count(primitives->at(0));
}

void check_morph_weights(const JsonPlace& weights, std::size_t targets) {
    static_cast<void>(weights.array());
    if (weights.size() != targets) {
        weights.must_be(fmt::format("one number for each of the mesh's {} morph targets", targets));
    }
    static_cast<void>(weights.numbers(targets));
}

std::size_t check_reference(const JsonPlace& root, const JsonPlace& place,
                            const std::string& array) {
    const auto found = root.find(array);
    const std::size_t count = found && found->value().is_array() ? found->size() : 0;
    if (count == 0) place.must_be(fmt::format("absent, since the file has no {}", array));
    return static_cast<std::size_t>(place.whole(0, count - 1));
}

std::optional<JsonPlace> find_extension(const JsonPlace& place, const std::string& name) {
    const auto extensions = place.find("extensions");
    if (!extensions) return std::nullopt;
    auto found = extensions->object().find(name);
    if (found) found->object();
    return found;
}

std::uint64_t check_accessor_kind(const JsonPlace& root, const JsonPlace& reference,
                                  std::string_view type,
                                  std::initializer_list<int> component_types) {
    const JsonPlace accessor =
        root.member("accessors").at(check_reference(root, reference, "accessors"));
    const JsonPlace its_type = accessor.member("type");
    if (its_type.text() != type) {
        its_type.must_be(fmt::format("{}, since {} uses it", type, reference.path()));
    }
    const JsonPlace component = accessor.member("componentType");
    if (std::find(component_types.begin(), component_types.end(),
                  static_cast<int>(component.whole(0, 65535))) == component_types.end()) {
        component.must_be(fmt::format("one of {}, since {} uses it",
                                      fmt::join(component_types, ", "), reference.path()));
    }
    return accessor.member("count").whole(1, largest_file);
}

void check_gltf(const GltfFile& file) {
    const JsonPlace root(file.json, file.name);
    check_asset(root);
    std::uint64_t all_buffer_bytes = 0;
    const std::vector<JsonPlace> buffers = elements_of(root, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        check_buffer(buffers[i], i, file);
        all_buffer_bytes += buffers[i].member("byteLength").whole(1, largest_file);
    }
    for (const auto& view : elements_of(root, "bufferViews")) check_buffer_view(root, view);
    for (const auto& accessor : elements_of(root, "accessors")) {
        check_accessor(root, accessor, all_buffer_bytes);
    }
    for (const auto& image : elements_of(root, "images")) check_image(root, image);
    for (const auto& texture : elements_of(root, "textures")) {
        if (const auto source = texture.find("source")) check_reference(root, *source, "images");
    }
    for (const auto& material : elements_of(root, "materials")) check_material(root, material);
    for (const auto& mesh : elements_of(root, "meshes")) check_mesh(root, mesh);
    check_node_graph(root);
}

}  // namespace gnomon::scene::internal
