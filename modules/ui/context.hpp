// SPDX-License-Identifier: MIT
//
// Context: Dear ImGui set up as gnomon's programs use it: one font that is read at arm's length, a
// quiet dark theme, input from plain data, nothing written to disk. Between begin_frame() and
// end_frame() widgets are made with Dear ImGui's own functions.
//
// Threads: one at a time; Dear ImGui has one current context in the process.
#pragma once

#include <filesystem>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/input/input.hpp>

struct ImDrawData;
struct ImFontAtlas;
struct ImGuiContext;

namespace gnomon::ui {

/// TrueType files of common Linux systems, best first.
[[nodiscard]] std::vector<std::filesystem::path> system_fonts();

struct ContextDesc {
    float font_px = 16.0F;
    /// The first that can be read is used; where none can, or none is named, the font that Dear
    /// ImGui has built in, which has the same bytes everywhere and one size, 13 pixels.
    std::vector<std::filesystem::path> fonts = system_fonts();
};

/// The theme's colours that programs draw with themselves; not premultiplied.
struct Palette {
    glm::vec4 accent{0.96F, 0.74F, 0.30F, 1.0F};  ///< what is selected, what moves
    glm::vec4 good{0.45F, 0.80F, 0.50F, 1.0F};
    glm::vec4 bad{0.93F, 0.40F, 0.36F, 1.0F};
    glm::vec4 dim{0.58F, 0.62F, 0.68F, 1.0F};  ///< text that explains
};
[[nodiscard]] Palette palette();

class Context {
public:
    explicit Context(const ContextDesc& desc = {});
    Context(Context&& other) noexcept;
    Context& operator=(Context&&) = delete;
    ~Context();

    /// `size_px`: the framebuffer's, at least 1 x 1. `dt_s` is what blinking and repeats go by; not
    /// negative. A frame that was begun and not ended is given up.
    void begin_frame(const input::Input& input, const glm::uvec2& size_px, double dt_s);
    /// Stands until the next begin_frame().
    [[nodiscard]] const ImDrawData& end_frame();

    /// The mouse is over a widget, or a widget holds it: the scene had better not react. Of the
    /// last begin_frame().
    [[nodiscard]] bool wants_mouse() const;
    /// Something is being typed.
    [[nodiscard]] bool wants_keyboard() const;
    [[nodiscard]] ImFontAtlas& fonts();

private:
    ImGuiContext* context_ = nullptr;
};

}  // namespace gnomon::ui
