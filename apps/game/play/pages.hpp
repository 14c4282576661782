// SPDX-License-Identifier: MIT
//
// Pages: what the screens that have a menu look like, and where the menus' lines are.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "play/canvas.hpp"
#include "play/screens.hpp"
#include "play/session.hpp"

namespace gnomon::game {

/// Where a line of the menu is, in units (canvas.hpp).
struct ItemBox {
    glm::vec2 min{0.0F};
    glm::vec2 max{0.0F};
};

/// One a line of screens.items(), in a picture of this size in units.
[[nodiscard]] std::vector<ItemBox> item_boxes(const Screens& screens, const glm::vec2& size);

/// The line there, if any.
[[nodiscard]] std::optional<std::size_t> item_at(std::span<const ItemBox> boxes,
                                                 const glm::vec2& point);

struct PageState {
    struct LevelLine {
        std::string name;
        bool won = false;
    };
    std::span<const LevelLine> levels;
    const Settings& settings;
    std::string backend;  ///< "gl", "vk": the one that draws
    std::string adapter;
    double shown_s = 0.0;  ///< since this screen came up
    double time_s = 0.0;   ///< since the program began
    /// What is played, or was.
    const Session* session = nullptr;
};

/// Over the picture of the scene; nothing while playing.
void draw_page(const Canvas& canvas, const Screens& screens, const PageState& state);

/// A sentence at the upper edge that goes by itself.
void draw_note(const Canvas& canvas, const std::string& note, float alpha);

}  // namespace gnomon::game
