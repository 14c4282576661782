// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <string>
#include <utility>

#include <imgui.h>

#include <gnomon/core/expects.hpp>
#include <gnomon/ui/context.hpp>

#include "internal/theme.hpp"

namespace gnomon::ui {

namespace {

using input::Key;

// What Dear ImGui asks for by name; it knows other keys by our numbers.
constexpr std::array<std::pair<ImGuiKey, Key>, 20> mapped_keys{{
    {ImGuiKey_Tab, Key::Tab},
    {ImGuiKey_LeftArrow, Key::Left},
    {ImGuiKey_RightArrow, Key::Right},
    {ImGuiKey_UpArrow, Key::Up},
    {ImGuiKey_DownArrow, Key::Down},
    {ImGuiKey_PageUp, Key::PageUp},
    {ImGuiKey_PageDown, Key::PageDown},
    {ImGuiKey_Home, Key::Home},
    {ImGuiKey_End, Key::End},
    {ImGuiKey_Insert, Key::Insert},
    {ImGuiKey_Delete, Key::Delete},
    {ImGuiKey_Backspace, Key::Backspace},
    {ImGuiKey_Enter, Key::Enter},
    {ImGuiKey_Escape, Key::Escape},
    {ImGuiKey_A, Key::A},
    {ImGuiKey_C, Key::C},
    {ImGuiKey_V, Key::V},
    {ImGuiKey_X, Key::X},
    {ImGuiKey_Y, Key::Y},
    {ImGuiKey_Z, Key::Z},
}};

// What moves the cursor in a text, or takes characters away.
constexpr std::array repeating_keys{Key::Left,   Key::Right,    Key::Up,     Key::Down,
                                    Key::Home,   Key::End,      Key::PageUp, Key::PageDown,
                                    Key::Delete, Key::Backspace};

// Basic Latin and Latin-1, Latin Extended-A, general punctuation, arrows, mathematical operators.
constexpr std::array<ImWchar, 11> glyph_ranges{0x20,   0xFF,   0x100,  0x17F,  0x2010, 0x2044,
                                               0x2190, 0x21FF, 0x2200, 0x22FF, 0};

// Whether the file can be read at all: where not, Dear ImGui would assert.
bool is_readable(const std::filesystem::path& path) {
    std::error_code error;
    return std::filesystem::is_regular_file(path, error) && std::ifstream(path).good();
}

}  // namespace

std::vector<std::filesystem::path> system_fonts() {
    return {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
            "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
            "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
            "/usr/share/fonts/TTF/DejaVuSans.ttf"};
}

Context::Context(const ContextDesc& desc) {
    context_ = ImGui::CreateContext();
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.BackendRendererName = "gnomon::ui";
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    for (const auto& [theirs, ours] : mapped_keys) io.KeyMap[theirs] = static_cast<int>(ours);

    ImFont* font = nullptr;
    float font_px = desc.font_px;
    const auto file = std::ranges::find_if(desc.fonts, is_readable);
    if (file != desc.fonts.end()) {
        font =
            io.Fonts->AddFontFromFileTTF(file->c_str(), desc.font_px, nullptr, glyph_ranges.data());
    }
    if (font == nullptr) {
        io.Fonts->AddFontDefault();
        font_px = 13.0F;
    }
    internal::apply_theme(font_px);
}

Context::Context(Context&& other) noexcept : context_(std::exchange(other.context_, nullptr)) {}

Context::~Context() {
    if (context_ != nullptr) ImGui::DestroyContext(context_);
}

void Context::begin_frame(const input::Input& input, const glm::uvec2& size_px, double dt_s) {
    GNOMON_EXPECTS(size_px.x > 0 && size_px.y > 0 && dt_s >= 0.0);
    ImGui::SetCurrentContext(context_);
    // A frame that its caller gave up: nothing where it was ended.
    if (ImGui::GetFrameCount() > 0) ImGui::EndFrame();
    ImGuiIO& io = ImGui::GetIO();
    if (!io.Fonts->IsBuilt()) io.Fonts->Build();
    io.DisplaySize = {static_cast<float>(size_px.x), static_cast<float>(size_px.y)};
    // It divides by it.
    io.DeltaTime = static_cast<float>(std::max(dt_s, 1e-5));
    io.MousePos = {static_cast<float>(input.cursor_px().x),
                   static_cast<float>(input.cursor_px().y)};
    for (std::size_t i = 0; i < input::mouse_button_count; ++i) {
        const auto button = static_cast<input::MouseButton>(i);
        // A click that began and ended within a frame is one all the same.
        io.MouseDown[i] = input.is_down(button) || input.was_pressed(button);
    }
    io.MouseWheel = static_cast<float>(input.scroll.y);
    io.MouseWheelH = static_cast<float>(input.scroll.x);
    for (std::size_t i = 0; i < input::key_count; ++i) {
        const auto key = static_cast<Key>(i);
        io.KeysDown[i] = input.is_down(key) || input.was_pressed(key);
    }
    // Dear ImGui repeats by its own clock what is held; the desktop's repeats are presses to it.
    for (const Key key : repeating_keys) {
        if (input.was_repeated(key)) io.KeysDownDuration[static_cast<std::size_t>(key)] = -1.0F;
    }
    io.KeyShift = input.shift();
    io.KeyCtrl = input.control();
    io.KeyAlt = input.alt();
    for (const char32_t character : input.text) {
        io.AddInputCharacter(static_cast<unsigned int>(character));
    }
    ImGui::NewFrame();
}

const ImDrawData& Context::end_frame() {
    ImGui::SetCurrentContext(context_);
    ImGui::Render();
    return *ImGui::GetDrawData();
}

bool Context::wants_mouse() const {
    ImGui::SetCurrentContext(context_);
    return ImGui::GetIO().WantCaptureMouse;
}

bool Context::wants_keyboard() const {
    ImGui::SetCurrentContext(context_);
    return ImGui::GetIO().WantTextInput;
}

ImFontAtlas& Context::fonts() {
    ImGui::SetCurrentContext(context_);
    return *ImGui::GetIO().Fonts;
}

}  // namespace gnomon::ui
