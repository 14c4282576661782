// SPDX-License-Identifier: MIT
//
// Any bytes as a .scene.json beside one good model: a scene that can cast shadows, or one sentence.
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include <gnomon/scene/scene_description.hpp>

#include "check_scene.hpp"

namespace gnomon::test {
namespace {

/// A folder for the description and the model that it may name; gone when the program ends.
class Folder {
public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "gnomon-fuzz-XXXXXX").string();
        require(mkdtemp(name.data()) != nullptr, "a temporary folder can be made");
        path_ = name;
        write("model.gltf", R"({"asset": {"version": "2.0"},
            "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
                            R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}]})");
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    std::filesystem::path write(const char* name, std::string_view text) const {
        const auto file = path_ / name;
        std::ofstream(file, std::ios::binary) << text;
        return file;
    }

private:
    std::filesystem::path path_;
};

/// Spheres of millions of triangles are legal, and slow.
bool is_slow(const std::string& text) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("primitives")) return false;
    for (const auto& primitive : json["primitives"]) {
        if (!primitive.is_object()) continue;
        for (const char* name : {"slices", "stacks", "cells", "ring_segments", "tube_segments"}) {
            const auto found = primitive.find(name);
            if (found != primitive.end() && found->is_number() && found->get<double>() > 32.0) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace
}  // namespace gnomon::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon;
    static const test::Folder folder;
    const std::string text(reinterpret_cast<const char*>(data), size);
    if (test::is_slow(text)) return 0;
    const auto scene = scene::load_scene_description(folder.write("input.scene.json", text));
    if (scene) {
        test::require_good_scene(*scene);
    } else {
        test::require_sentence(scene.error(), scene.error().code == ErrorCode::Io
                                                  ? ErrorCode::Io
                                                  : ErrorCode::InvalidInput);
    }
    return 0;
}
