// SPDX-License-Identifier: MIT
#include "play/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace gnomon::game {

namespace {

using Paths = std::vector<std::filesystem::path>;

// Basic Latin and Latin-1, Latin Extended-A, general punctuation, arrows.
constexpr ImWchar text_glyphs[] = {0x20, 0xFF, 0x100, 0x17F, 0x2010, 0x2044, 0x2190, 0x21FF, 0};
constexpr ImWchar title_glyphs[] = {0x20, 0x7E, 0};

bool is_font_file(const std::filesystem::path& path) {
    std::error_code error;
    return std::filesystem::is_regular_file(path, error) && std::ifstream(path).good();
}

ImFont* add_font(ImFontAtlas& atlas, const Paths& files, float size_px, const ImWchar* glyphs) {
    const auto file = std::ranges::find_if(files, is_font_file);
    ImFont* font = nullptr;
    if (file != files.end()) {
        font = atlas.AddFontFromFileTTF(file->c_str(), size_px, nullptr, glyphs);
    }
    if (font != nullptr) return font;
    ImFontConfig built_in;
    built_in.SizePixels = size_px;
    return atlas.AddFontDefault(&built_in);
}

}  // namespace

float unit_of(const glm::uvec2& size_px) {
    const float unit =
        std::min(static_cast<float>(size_px.y) / 720.0F, static_cast<float>(size_px.x) / 960.0F);
    return std::clamp(unit, 0.2F, 6.0F);
}

ImU32 packed_hue(const glm::vec4& color, float alpha) {
    return ImGui::ColorConvertFloat4ToU32(
        {color.r, color.g, color.b, std::clamp(color.a * alpha, 0.0F, 1.0F)});
}

Lettering Lettering::add_to(ui::Context& context, float unit) {
    ImFontAtlas& atlas = context.fonts();
    const auto pixels = [&](float size) { return std::max(8.0F, std::round(size * unit)); };
    Paths bold_files{"/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf",
                     "/usr/share/fonts/truetype/noto/NotoSans-Bold.ttf",
                     "/usr/share/fonts/truetype/liberation/LiberationSans-Bold.ttf",
                     "/usr/share/fonts/TTF/DejaVuSans-Bold.ttf"};
    const Paths plain_files = ui::system_fonts();
    bold_files.insert(bold_files.end(), plain_files.begin(), plain_files.end());
    Lettering letters;
    letters.text = add_font(atlas, plain_files, pixels(text_size), text_glyphs);
    letters.bold = add_font(atlas, bold_files, pixels(bold_size), text_glyphs);
    letters.title = add_font(atlas, bold_files, pixels(title_size), title_glyphs);
    return letters;
}

Canvas::Canvas(const Lettering& letters, const glm::uvec2& size_px)
    : letters_(letters),
      list_(ImGui::GetBackgroundDrawList()),
      unit_(unit_of(size_px)),
      size_(glm::vec2(size_px) / unit_) {}

float Canvas::width(const ImFont* font, float size, std::string_view words, float gap) const {
    const ImVec2 extent =
        font->CalcTextSizeA(size * unit_, 1e9F, 0.0F, words.data(), words.data() + words.size());
    const float gaps = words.empty() ? 0.0F : gap * static_cast<float>(words.size() - 1);
    return extent.x / unit_ + gaps;
}

void Canvas::write(const ImFont* font, float size, const glm::vec2& at, const glm::vec4& color,
                   std::string_view words, float align, float alpha) const {
    const float left = at.x - align * (align > 0.0F ? width(font, size, words) : 0.0F);
    const ImVec2 place = px({left, at.y});
    list_->AddText(font, size * unit_, {std::floor(place.x), std::floor(place.y)},
                   packed_hue(color, alpha), words.data(), words.data() + words.size());
}

void Canvas::write_spaced(const ImFont* font, float size, const glm::vec2& at,
                          const glm::vec4& color, std::string_view words, float gap, float align,
                          float alpha) const {
    float left = at.x - align * width(font, size, words, gap);
    for (const char& letter : words) {
        const std::string_view one(&letter, 1);
        write(font, size, {left, at.y}, color, one, 0.0F, alpha);
        left += width(font, size, one) + gap;
    }
}

std::vector<std::string_view> Canvas::lines_of(const ImFont* font, float size, float most,
                                               std::string_view words) {
    std::vector<std::string_view> lines;
    while (!words.empty()) {
        const char* begin = words.data();
        const char* end =
            font->CalcWordWrapPositionA(size / font->FontSize, begin, begin + words.size(), most);
        if (end == begin) end = begin + words.size();
        const auto length = static_cast<std::size_t>(end - begin);
        lines.push_back(words.substr(0, length));
        words.remove_prefix(length);
        while (words.starts_with(' ')) words.remove_prefix(1);
    }
    return lines;
}

void Canvas::fill(const glm::vec2& min, const glm::vec2& max, const glm::vec4& color, float alpha,
                  float rounding) const {
    list_->AddRectFilled(px(min), px(max), packed_hue(color, alpha), rounding * unit_);
}

void Canvas::fade_across(const glm::vec2& min, const glm::vec2& max, const glm::vec4& color,
                         float left_alpha, float right_alpha) const {
    const ImU32 left = packed_hue(color, left_alpha);
    const ImU32 right = packed_hue(color, right_alpha);
    list_->AddRectFilledMultiColor(px(min), px(max), left, right, right, left);
}

void Canvas::fade_down(const glm::vec2& min, const glm::vec2& max, const glm::vec4& color,
                       float upper_alpha, float lower_alpha) const {
    const ImU32 upper = packed_hue(color, upper_alpha);
    const ImU32 lower = packed_hue(color, lower_alpha);
    list_->AddRectFilledMultiColor(px(min), px(max), upper, upper, lower, lower);
}

}  // namespace gnomon::game
