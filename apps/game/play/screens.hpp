// SPDX-License-Identifier: MIT
//
// Screens: which one is shown, what can be chosen there, and what follows. It knows neither windows
// nor worlds: whoever does gives it what was pressed and obeys its orders.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "play/settings.hpp"
#include "world.hpp"

namespace gnomon::game {

enum class Screen : std::uint8_t { Title, Playing, Paused, Won, Caught, Settings };

/// A line of a menu.
struct MenuItem {
    enum class Kind : std::uint8_t {
        Level,
        Watch,  ///< the level's recording
        Settings,
        Quit,
        Resume,
        Restart,
        NextLevel,
        ToTitle,
        Setting,
        Back
    };
    Kind kind = Kind::Back;
    std::size_t level = 0;  ///< of Kind::Level
    Setting setting = {};   ///< of Kind::Setting
    bool operator==(const MenuItem&) const = default;
};

/// What somebody did in a frame, as menus understand it.
struct MenuPress {
    int down = 0;   ///< -1: up
    int right = 0;  ///< -1: left
    bool accept = false;
    bool back = false;
    bool pause = false;
    bool restart = false;
    /// Who plays cannot go on: pauses, and never resumes; nothing where a recording plays.
    bool interrupted = false;
    std::optional<std::size_t> pointed = std::nullopt;  ///< the item that the mouse moved to
    bool operator==(const MenuPress&) const = default;
};

/// What is to be done about it.
struct Order {
    enum class Kind : std::uint8_t {
        None,
        Begin,    ///< `level`, from its start
        Watch,    ///< the recording of `level`
        Restart,  ///< the level that is played
        Leave,    ///< for the title
        Change,   ///< `setting`, by `by` steps
        Save,     ///< the settings
        Quit
    };
    Kind kind = Kind::None;
    std::size_t level = 0;
    Setting setting = {};
    int by = 0;
    bool operator==(const Order&) const = default;
};

/// What there is to choose.
struct ScreensDesc {
    std::size_t levels = 1;
    bool watches = false;    ///< there is a recording to be watched, and nothing else
    bool can_watch = false;  ///< the title offers the level's recording
    bool can_quit = true;    ///< the program has an end of its own
    std::vector<Setting> settings{all_settings.begin(), all_settings.end()};
};

class Screens {
public:
    /// Begins with the title.
    explicit Screens(ScreensDesc desc);

    [[nodiscard]] Screen now() const { return now_; }
    /// Empty while playing.
    [[nodiscard]] std::span<const MenuItem> items() const { return items_; }
    [[nodiscard]] std::size_t selected() const { return selected_; }
    /// That is played, or chosen in the title.
    [[nodiscard]] std::size_t level() const { return level_; }
    /// From which the settings were opened.
    [[nodiscard]] Screen behind() const { return now_ == Screen::Settings ? behind_ : now_; }
    /// What is played is a recording, which nobody can change.
    [[nodiscard]] bool watches() const { return watches_; }

    [[nodiscard]] Order press(const MenuPress& press);
    /// Past the title, for who named a level.
    void begin(std::size_t level);
    /// The recording of the level that is chosen, as its line in the title does.
    [[nodiscard]] Order watch();
    /// The level that is played is over; Outcome::Playing is nothing, and so is what a recording
    /// comes to.
    void ended(Outcome outcome);
    /// What was played is left, as if somebody had said so.
    [[nodiscard]] Order leave();

private:
    void show(Screen screen);
    [[nodiscard]] Order accept();
    [[nodiscard]] Order close_settings();

    ScreensDesc desc_;
    bool watches_;
    Screen now_ = Screen::Title;
    Screen behind_ = Screen::Title;
    std::size_t level_ = 0;
    std::size_t selected_ = 0;
    std::vector<MenuItem> items_;
};

}  // namespace gnomon::game
