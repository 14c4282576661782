// SPDX-License-Identifier: MIT
//
// Any bytes as a level file and as a recording of the game: what is read keeps its limits, and what
// is refused is refused in one sentence.
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "fuzz_input.hpp"
#include "level.hpp"
#include "recording.hpp"

namespace gnomon::test {
namespace {

bool goes_on(const std::vector<glm::dvec2>& path) {
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (!(glm::length(path[(i + 1) % path.size()] - path[i]) >= 0.05)) return false;
    }
    return path.size() >= 2;
}

void check_level(std::string_view text) {
    const auto level = game::read_level(text, "fuzz.json");
    if (!level) {
        require(level.error().message.starts_with("fuzz.json: "), "the sentence names the file");
        require(level.error().message.ends_with('.'), "it is a sentence");
        return;
    }
    require(level->size_m.x >= 4.0 && level->size_m.y <= 200.0, "the ground has its limits");
    for (const game::Guard& guard : level->guards) {
        require(goes_on(guard.path) && guard.speed_m_s > 0.0, "a guard gets somewhere");
    }
    for (const game::Searchlight& light : level->searchlights) {
        require(goes_on(light.path) && light.period_s > 0.0, "a searchlight gets somewhere");
    }
    for (const game::Block& block : level->blocks) {
        require(block.size_m.x > 0.0 && block.size_m.y > 0.0 && block.size_m.z > 0.0,
                "a block has a size");
    }
}

void check_recording(std::string_view text) {
    const auto recording = game::read_recording(text, "fuzz.replay");
    if (!recording) {
        require(recording.error().message.starts_with("fuzz.replay:"),
                "the sentence names the file");
        return;
    }
    require(recording->inputs.size() <= game::most_ticks, "a recording has an end");
    const auto again = game::read_recording(game::to_text(*recording), "again.replay");
    require(again && *again == *recording, "what is written reads back");
}

}  // namespace
}  // namespace gnomon::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    gnomon::test::check_level(text);
    gnomon::test::check_recording(text);
    return 0;
}
