// SPDX-License-Identifier: MIT
#include "internal/gltf_material.hpp"

#include <map>

#include <fmt/format.h>

#include "internal/gltf_image.hpp"

namespace gnomon::scene::internal {
namespace {

AlphaMode alpha_mode_of(const std::string& mode) {
    if (mode == "MASK") return AlphaMode::Mask;
    if (mode == "BLEND") return AlphaMode::Blend;
    return AlphaMode::Opaque;
}

class MaterialReader {
public:
    MaterialReader(const GltfModel& model, std::vector<std::string>& messages)
        : model_(model), messages_(messages) {}

    Material read(const tinygltf::Material& source, std::size_t index) {
        const auto& pbr = source.pbrMetallicRoughness;
        Material material;
        material.name = source.name;
        for (int i = 0; i < 4; ++i) {
            material.base_color[i] =
                static_cast<float>(pbr.baseColorFactor[static_cast<std::size_t>(i)]);
        }
        material.metallic = static_cast<float>(pbr.metallicFactor);
        material.roughness = static_cast<float>(pbr.roughnessFactor);
        for (int i = 0; i < 3; ++i) {
            material.emissive[i] =
                static_cast<float>(source.emissiveFactor[static_cast<std::size_t>(i)]);
        }
        material.alpha_mode = alpha_mode_of(source.alphaMode);
        material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
        material.double_sided = source.doubleSided;
        material.base_color_image = base_color_image(pbr.baseColorTexture, index);
        return material;
    }

private:
    void message(std::size_t index, const std::string& what) {
        messages_.push_back(fmt::format("{}: materials[{}] {}.", model_.file, index, what));
    }

    std::shared_ptr<const Image> base_color_image(const tinygltf::TextureInfo& info,
                                                  std::size_t index) {
        if (info.index < 0) return nullptr;
        if (info.texCoord != 0) {
            message(index, fmt::format("uses texture coordinates {}, but only set 0 is read; its "
                                       "base colour texture is left out",
                                       info.texCoord));
            return nullptr;
        }
        if (info.extensions.count("KHR_texture_transform") != 0) {
            message(index,
                    "uses KHR_texture_transform, which is not supported; its base colour "
                    "texture is drawn without");
        }
        const int source = model_.model.textures[static_cast<std::size_t>(info.index)].source;
        if (source < 0) {
            message(index, fmt::format("uses textures[{}], which has no image in a format of "
                                       "glTF 2.0; it is left out",
                                       info.index));
            return nullptr;
        }
        const auto found = images_.find(source);
        if (found != images_.end()) return found->second;
        return images_[source] = load_image(model_, static_cast<std::size_t>(source), messages_);
    }

    const GltfModel& model_;
    std::vector<std::string>& messages_;
    std::map<int, std::shared_ptr<const Image>> images_;
};

}  // namespace

std::vector<Material> read_materials(const GltfModel& model, std::vector<std::string>& messages) {
    std::vector<Material> materials(1);
    materials.front().name = "default";
    MaterialReader reader(model, messages);
    for (std::size_t i = 0; i < model.model.materials.size(); ++i) {
        materials.push_back(reader.read(model.model.materials[i], i));
    }
    return materials;
}

}  // namespace gnomon::scene::internal
