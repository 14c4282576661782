// SPDX-License-Identifier: MIT
//
// Any bytes as a .glb or .gltf: a scene that can cast shadows, or one sentence.
#include <gnomon/scene/gltf.hpp>

#include "check_scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon;
    const auto scene = scene::load_glb(std::as_bytes(std::span(data, size)), "input");
    if (scene) {
        test::require_good_scene(*scene);
    } else {
        test::require_sentence(scene.error(), ErrorCode::InvalidInput);
    }
    return 0;
}
