// SPDX-License-Identifier: MIT
//
// Canvas: what pages and head-up display are drawn with: the background list of Dear ImGui, three
// sizes of letters, and lengths in units of which the picture is 720 high, so that everything keeps
// its place and size in windows of any size.
#pragma once

#include <string_view>
#include <vector>

#include <imgui.h>
#include <glm/glm.hpp>

#include <gnomon/ui/context.hpp>

namespace gnomon::game {

/// Pixels of a unit in a picture of this size; less where it is narrow.
[[nodiscard]] float unit_of(const glm::uvec2& size_px);

/// Not premultiplied, as the screen shows them.
namespace hue {
inline constexpr glm::vec4 night{0.020F, 0.028F, 0.050F, 1.0F};
inline constexpr glm::vec4 moon{0.86F, 0.90F, 0.97F, 1.0F};
inline constexpr glm::vec4 dim{0.58F, 0.64F, 0.74F, 1.0F};
inline constexpr glm::vec4 lamp{1.0F, 0.80F, 0.46F, 1.0F};
inline constexpr glm::vec4 alarm{0.96F, 0.32F, 0.25F, 1.0F};
inline constexpr glm::vec4 exit{0.46F, 0.88F, 0.58F, 1.0F};
}  // namespace hue

[[nodiscard]] ImU32 packed_hue(const glm::vec4& color, float alpha = 1.0F);

/// The letters, of a ui::Context that has not had its first frame.
struct Lettering {
    ImFont* text = nullptr;
    ImFont* bold = nullptr;
    ImFont* title = nullptr;

    static constexpr float text_size = 19.0F;  // units
    static constexpr float bold_size = 30.0F;
    static constexpr float title_size = 92.0F;

    /// For pictures whose unit has about that many pixels.
    [[nodiscard]] static Lettering add_to(ui::Context& context, float unit);
};

class Canvas {
public:
    /// Within a frame of the context that the letters belong to.
    Canvas(const Lettering& letters, const glm::uvec2& size_px);

    /// Of the picture, in units.
    [[nodiscard]] const glm::vec2& size() const { return size_; }
    [[nodiscard]] float unit() const { return unit_; }
    [[nodiscard]] const Lettering& letters() const { return letters_; }
    [[nodiscard]] ImDrawList& list() const { return *list_; }
    [[nodiscard]] ImVec2 px(const glm::vec2& at) const { return {at.x * unit_, at.y * unit_}; }

    /// Lengths and places are units. `align`: 0 begins there, 0.5 is centred, 1 ends there.
    void write(const ImFont* font, float size, const glm::vec2& at, const glm::vec4& color,
               std::string_view words, float align = 0.0F, float alpha = 1.0F) const;
    /// With `gap` more between letters; for capitals.
    void write_spaced(const ImFont* font, float size, const glm::vec2& at, const glm::vec4& color,
                      std::string_view words, float gap, float align = 0.0F,
                      float alpha = 1.0F) const;
    [[nodiscard]] float width(const ImFont* font, float size, std::string_view words,
                              float gap = 0.0F) const;
    /// The words as lines of at most `most`; a word that is wider has a line of its own.
    [[nodiscard]] static std::vector<std::string_view> lines_of(const ImFont* font, float size,
                                                                float most, std::string_view words);

    void fill(const glm::vec2& min, const glm::vec2& max, const glm::vec4& color,
              float alpha = 1.0F, float rounding = 0.0F) const;
    /// From the left or upper alpha to the right or lower one.
    void fade_across(const glm::vec2& min, const glm::vec2& max, const glm::vec4& color,
                     float left_alpha, float right_alpha) const;
    void fade_down(const glm::vec2& min, const glm::vec2& max, const glm::vec4& color,
                   float upper_alpha, float lower_alpha) const;

private:
    const Lettering& letters_;
    ImDrawList* list_;
    float unit_;
    glm::vec2 size_;
};

}  // namespace gnomon::game
