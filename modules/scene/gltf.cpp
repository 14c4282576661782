// SPDX-License-Identifier: MIT
//
// The public border of the glTF reader. Inside: gltf_file takes the container apart, gltf_check
// looks at everything that is used, gltf_model hands the rest to tinygltf, gltf_mesh and
// gltf_material read assets, gltf_nodes makes entities.
#include <gnomon/scene/gltf.hpp>

#include "internal/gltf_nodes.hpp"
#include "internal/guarded.hpp"

namespace gnomon::scene {

Result<Scene> load_gltf(const std::filesystem::path& path, const GltfOptions& options) {
    const std::string name = path.string();
    return internal::guarded(name, [&] {
        internal::GltfFile file = internal::take_apart(internal::read_file(path, name), name);
        file.folder = path.parent_path();
        return internal::build_scene(internal::load_model(std::move(file)), options);
    });
}

Result<Scene> load_glb(std::span<const std::byte> bytes, const std::string& name,
                       const GltfOptions& options) {
    return internal::guarded(name, [&] {
        return internal::build_scene(internal::load_model(internal::take_apart(bytes, name)),
                                     options);
    });
}

}  // namespace gnomon::scene
