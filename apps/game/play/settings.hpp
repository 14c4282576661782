// SPDX-License-Identifier: MIT
//
// Settings: what is remembered from one game to the next, as values and as text; where the text
// is kept is another's business (settings_file.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/result.hpp>

namespace gnomon::game {

/// Those that the settings' screen shows, in its order.
enum class Setting : std::uint8_t {
    Backend,
    Fullscreen,
    Vsync,
    Scale,
    Samples,
    MouseSpeed,
    MouseInverted
};
inline constexpr std::array all_settings{
    Setting::Backend, Setting::Fullscreen, Setting::Vsync,        Setting::Scale,
    Setting::Samples, Setting::MouseSpeed, Setting::MouseInverted};

struct Settings {
    std::string backend = {};  ///< "gl", "vk"; empty: the first that works
    bool fullscreen = false;
    bool vsync = true;                  ///< OpenGL's alone; Vulkan always waits for the screen
    std::uint32_t scale_percent = 100;  ///< of the window's pixels, along each side; 50 .. 100
    std::uint32_t samples = 4;          ///< 1 or 4
    double mouse_speed = 1.0;           ///< 0.2 .. 3
    bool mouse_inverted = false;        ///< up looks down
    std::vector<std::string> won = {};  ///< names of levels

    bool operator==(const Settings&) const = default;
};

/// One step, or several, of a setting; what has two values or names goes round, numbers stop at
/// their ends.
[[nodiscard]] Settings changed(Settings settings, Setting setting, int by);

[[nodiscard]] std::string to_text(const Settings& settings);
/// The inverse of to_text(). What is not named has its default. Fails with ErrorCode::InvalidInput,
/// one sentence that names `file`, place, value and limit.
[[nodiscard]] Result<Settings> read_settings(std::string_view text, const std::string& file);

}  // namespace gnomon::game
