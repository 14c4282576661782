// SPDX-License-Identifier: MIT
//
// Any bytes as a .glb or .gltf: a scene that can cast shadows, at a few times of its first
// animation as well, or one sentence.
#include <gnomon/scene/deform.hpp>
#include <gnomon/scene/gltf.hpp>
#include <gnomon/scene/transforms.hpp>

#include "check_scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon;
    auto scene = scene::load_glb(std::as_bytes(std::span(data, size)), "input");
    if (scene) {
        test::require_good_scene(*scene);
        for (const double time_s : {0.0, 0.4, 3.0}) {
            if (scene->animations.empty()) break;
            test::require(scene::animate(*scene, 0, time_s).has_value(),
                          "an animation plays at any time");
            scene::update_world_transforms(scene->registry);
            if (const Status deformed = scene::deform(*scene); !deformed) {
                test::require_sentence(deformed.error(), ErrorCode::InvalidInput);
            }
            test::require_good_scene(*scene);
        }
    } else {
        test::require_sentence(scene.error(), ErrorCode::InvalidInput);
    }
    return 0;
}
