// SPDX-License-Identifier: MIT
#include "play/words.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace gnomon::game {

std::string_view heading_of(Screen screen) {
    switch (screen) {
        case Screen::Title:
        case Screen::Playing: break;
        case Screen::Paused: return "PAUSED";
        case Screen::Won: return "UNSEEN";
        case Screen::Caught: return "CAUGHT";
        case Screen::Settings: return "SETTINGS";
    }
    return {};
}

std::string label_of(const MenuItem& item, std::string_view level) {
    using Kind = MenuItem::Kind;
    switch (item.kind) {
        case Kind::Level: return std::string(level);
        case Kind::Watch: return "Watch it played";
        case Kind::Settings: return "Settings";
        case Kind::Quit: return "Quit";
        case Kind::Resume: return "Go on";
        case Kind::Restart: return "Once more";
        case Kind::NextLevel: return "Next level";
        case Kind::ToTitle: return "Back to the title";
        case Kind::Back: return "Done";
        case Kind::Setting: break;
    }
    switch (item.setting) {
        case Setting::Backend: return "Drawn by";
        case Setting::Fullscreen: return "Full screen";
        case Setting::Vsync: return "Wait for the screen";
        case Setting::Scale: return "Resolution";
        case Setting::Samples: return "Samples a pixel";
        case Setting::MouseSpeed: return "Mouse speed";
        case Setting::MouseInverted: return "Mouse upside down";
    }
    return {};
}

std::string value_of(Setting setting, const Settings& settings, std::string_view backend) {
    const auto yes = [](bool on) { return std::string(on ? "yes" : "no"); };
    const bool vulkan = backend == "vk";
    switch (setting) {
        case Setting::Backend: return vulkan ? "Vulkan" : "OpenGL";
        case Setting::Fullscreen: return yes(settings.fullscreen);
        case Setting::Vsync: return vulkan ? "always, with Vulkan" : yes(settings.vsync);
        case Setting::Scale: return fmt::format("{} %", settings.scale_percent);
        case Setting::Samples: return fmt::format("{}", settings.samples);
        case Setting::MouseSpeed: return fmt::format("{:.1f}", settings.mouse_speed);
        case Setting::MouseInverted: return yes(settings.mouse_inverted);
    }
    return {};
}

std::string end_of(const Session& session) {
    const World& world = session.world();
    const std::string& level = world.level().name;
    const std::string time = clock_text(world.now());
    const double worst = session.worst_alarm();
    if (world.outcome() == Outcome::Won && worst <= 0.0) {
        return fmt::format("{} in {}, and nobody noticed a thing.", level, time);
    }
    if (world.outcome() == Outcome::Won) {
        return fmt::format("{} in {}. The alarm came to {:.0f} %.", level, time,
                           std::max(1.0, 100.0 * worst));
    }
    if (world.meter().alarm < 1.0) {
        return fmt::format("A guard has you by the collar, after {}.", time);
    }
    return fmt::format("The light found you after {}.", time);
}

std::string clock_text(Tick ticks) {
    const Tick tenths = ticks * 10 / ticks_a_second;
    return fmt::format("{}:{:02}.{}", tenths / 600, tenths / 10 % 60, tenths % 10);
}

}  // namespace gnomon::game
