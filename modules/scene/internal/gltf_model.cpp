// SPDX-License-Identifier: MIT
#include "internal/gltf_model.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "internal/data_uri.hpp"
#include "internal/gltf_check.hpp"
#include "internal/json_place.hpp"

namespace gnomon::scene::internal {
namespace {

std::vector<std::byte> load_buffer(GltfFile& file, const JsonPlace& buffer) {
    const auto length =
        static_cast<std::size_t>(buffer.member("byteLength").whole(1, largest_file));
    const auto uri = buffer.find("uri");
    std::vector<std::byte> bytes;
    if (!uri) {
        bytes = std::move(*file.binary_chunk);
    } else if (is_data_uri(uri->text())) {
        auto decoded = decode_data_uri(uri->text());
        if (!decoded) uri->refuse("is a data URI that is not valid base64");
        bytes = *std::move(decoded);
    } else {
        if (!file.folder) uri->refuse("names another file, but this one was read from memory");
        const auto path = decode_relative_path(uri->text());
        if (!path) uri->must_be("a path in or below the folder of the file");
        bytes = read_file(*file.folder / *path, fmt::format("{}: {}", file.name, buffer.path()));
    }
    if (bytes.size() < length) {
        buffer.member("byteLength")
            .must_be(fmt::format("at most {}, the bytes that are there", bytes.size()));
    }
    bytes.resize(length);
    return bytes;
}

void remove_extras(nlohmann::json& value) {
    if (value.is_object()) value.erase("extras");
    if (!value.is_structured()) return;
    for (auto& child : value) remove_extras(child);
}

}  // namespace

GltfModel load_model(GltfFile file) {
    check_gltf(file);
    const JsonPlace root(file.json, file.name);

    GltfModel result;
    result.animations = check_animations(root);
    result.file = file.name;
    result.folder = file.folder;
    for (const auto& buffer : elements_of(root, "buffers")) {
        result.buffers.push_back(load_buffer(file, buffer));
    }
    for (const auto& image : elements_of(root, "images")) {
        ImageSource source;
        if (const auto name = image.find("name")) source.name = name->text();
        if (const auto uri = image.find("uri")) source.uri = uri->text();
        if (const auto view = image.find("bufferView")) source.buffer_view = view->value();
        result.images.push_back(std::move(source));
    }

    // tinygltf gets only what was checked and is read: it never opens a file nor decodes an image.
    nlohmann::json checked = nlohmann::json::object();
    for (const char* name :
         {"asset", "extensionsUsed", "extensionsRequired", "extensions", "bufferViews", "accessors",
          "textures", "materials", "meshes", "cameras", "skins", "nodes", "scenes", "scene"}) {
        if (root.has(name)) checked[name] = std::move(file.json[name]);
    }
    remove_extras(checked);
    const std::string text = checked.dump();
    tinygltf::TinyGLTF reader;
    std::string errors;
    std::string warnings;
    if (!reader.LoadASCIIFromString(&result.model, &errors, &warnings, text.data(),
                                    static_cast<unsigned int>(text.size()), "")) {
        std::replace(errors.begin(), errors.end(), '\n', ' ');
        refuse_input(file.name, fmt::format("tinygltf refuses the file: {}", errors));
    }
    return result;
}

}  // namespace gnomon::scene::internal
