// SPDX-License-Identifier: MIT
#include "play/settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "play/settings_file.hpp"
#include "tests/support/paths.hpp"

namespace gnomon::game {
namespace {

using testing::HasSubstr;

Settings unusual() {
    return {.backend = "vk",
            .fullscreen = true,
            .vsync = false,
            .scale_percent = 70,
            .samples = 1,
            .mouse_speed = 1.7,
            .mouse_inverted = true,
            .won = {"courtyard", "dock-yard_2"}};
}

std::filesystem::path fresh_folder(const char* name) {
    std::filesystem::path folder = test::output_folder() / "game_settings" / name;
    std::filesystem::remove_all(folder);
    return folder;
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream stream(path);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Sets a variable of the environment, or takes it away, until it goes.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* now = std::getenv(name)) before_ = now;
        if (value != nullptr) {
            setenv(name, value, 1);
        } else {
            unsetenv(name);
        }
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;
    ~Variable() {
        if (before_) {
            setenv(name_, before_->c_str(), 1);
        } else {
            unsetenv(name_);
        }
    }

private:
    const char* name_;
    std::optional<std::string> before_;
};

TEST(Settings, come_back_as_they_were_written) {
    for (const Settings& settings : {Settings{}, unusual()}) {
        const auto read = read_settings(to_text(settings), "game.json");
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(*read, settings);
    }
}

TEST(Settings, have_no_digits_that_nobody_chose) {
    Settings settings;
    for (int i = 0; i < 7; ++i) settings = changed(settings, Setting::MouseSpeed, 1);
    EXPECT_THAT(to_text(settings), HasSubstr("\"mouse_speed\": 1.7,"));
}

TEST(Settings, that_a_file_does_not_name_have_their_defaults) {
    const auto read = read_settings(R"({"format": "gnomon-game-settings 1", "samples": 1})", "f");
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, (Settings{.samples = 1}));
}

TEST(Settings, are_refused_in_one_sentence) {
    const std::string head = R"({"format": "gnomon-game-settings 1", )";
    const std::pair<std::string, std::string> rows[] = {
        {"", "f: the JSON is broken at byte 1 of 0."},
        {"[1]", "f: the JSON is an array of 1, but must be an object."},
        {"{}", "f: the document has no member \"format\"."},
        {R"({"format": "other 2"})",
         "f: format is \"other 2\", but must be \"gnomon-game-settings 1\"."},
        {head + R"("volume": 3})", "unknown member \"volume\""},
        {head + R"("vsync": 1})", "f: vsync is 1, but must be true or false."},
        {head + R"("backend": "metal"})",
         "f: backend is \"metal\", but must be \"auto\", \"gl\" or \"vk\"."},
        {head + R"("scale_percent": 10})",
         "f: scale_percent is 10, but must be a whole number from 50 to 100."},
        {head + R"("samples": 3})", "f: samples is 3, but must be 1 or 4."},
        {head + R"("mouse_speed": -1})",
         "f: mouse_speed is -1, but must be a number from 0.2 to 3."},
        {head + R"("won": ["../x"]})", "f: won[0] is \"../x\", but must be the name of a level."},
        {head + R"("won": 7})", "f: won is 7, but must be an array of 0 to 1000 entries."}};
    for (const auto& [text, sentence] : rows) {
        const auto read = read_settings(text, "f");
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().code, ErrorCode::InvalidInput);
        EXPECT_THAT(read.error().message, HasSubstr(sentence));
    }
}

TEST(Settings, step_and_stop_at_their_ends) {
    Settings settings;
    EXPECT_EQ(changed(settings, Setting::Scale, 1).scale_percent, 100U);
    EXPECT_EQ(changed(settings, Setting::Scale, -1).scale_percent, 90U);
    EXPECT_EQ(changed(settings, Setting::Scale, -99).scale_percent, 50U);
    EXPECT_EQ(changed(settings, Setting::MouseSpeed, 99).mouse_speed, 3.0);
    EXPECT_EQ(changed(settings, Setting::MouseSpeed, -99).mouse_speed, 0.2);
    EXPECT_EQ(changed(settings, Setting::Samples, -1).samples, 1U);
    for (const Setting setting :
         {Setting::Fullscreen, Setting::Vsync, Setting::MouseInverted, Setting::Samples}) {
        const Settings once = changed(settings, setting, 1);
        EXPECT_NE(once, settings);
        EXPECT_EQ(changed(once, setting, 1), settings);
        EXPECT_EQ(changed(settings, setting, 0), settings);
    }
    EXPECT_EQ(changed(unusual(), Setting::Backend, 1).backend, "gl");
    // Whatever is stepped, the file can be read again.
    for (const Setting setting : all_settings) {
        for (int i = 0; i < 40; ++i) {
            settings = changed(settings, setting, i % 3 - 1);
            ASSERT_EQ(read_settings(to_text(settings), "f").value(), settings);
        }
    }
}

TEST(SettingsFile, is_made_with_its_folders_and_read_again) {
    const std::filesystem::path path = fresh_folder("made") / "deep" / "gnomon" / "game.json";
    EXPECT_EQ(load_settings(path).settings, Settings{});
    EXPECT_EQ(load_settings(path).complaint, "") << "no file is no mistake";
    ASSERT_TRUE(save_settings(path, unusual()));
    EXPECT_EQ(load_settings(path).settings, unusual());
    ASSERT_TRUE(save_settings(path, Settings{}));
    EXPECT_EQ(load_settings(path).settings, Settings{});
    const auto entries = std::filesystem::directory_iterator(path.parent_path());
    EXPECT_EQ(std::distance(begin(entries), end(entries)), 1) << "nothing temporary is left";
}

TEST(SettingsFile, that_is_broken_gives_a_sentence_and_defaults_and_stays) {
    const std::filesystem::path path = fresh_folder("broken") / "game.json";
    std::filesystem::create_directories(path.parent_path());
    const std::string text = "{\"format\": \"gnomon-game-settings 1\", \"vsync\": ";
    std::ofstream(path) << text;
    const LoadedSettings loaded = load_settings(path);
    EXPECT_EQ(loaded.settings, Settings{});
    EXPECT_THAT(loaded.complaint, HasSubstr("game.json: the JSON is broken at byte"));
    EXPECT_EQ(text_of(path), text);
    // A folder of that name is no file, either.
    EXPECT_NE(load_settings(path.parent_path()).complaint, "");
}

TEST(SettingsFile, that_cannot_be_written_says_so) {
    const std::filesystem::path folder = fresh_folder("unwritable");
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "file") << "x";
    const Status saved = save_settings(folder / "file" / "game.json", {});
    ASSERT_FALSE(saved);
    EXPECT_EQ(saved.error().code, ErrorCode::Io);
    EXPECT_TRUE(save_settings({}, {})) << "nowhere to write is nothing to do";
}

TEST(SettingsFile, lies_where_the_desktop_wants_it) {
    {
        const Variable config("XDG_CONFIG_HOME", "/some/config");
        EXPECT_EQ(settings_path(), "/some/config/gnomon/game.json");
    }
    const Variable nothing("XDG_CONFIG_HOME", nullptr);
    const Variable folder("HOME", "/some/body");
    EXPECT_EQ(settings_path(), "/some/body/.config/gnomon/game.json");
    {
        const Variable relative("XDG_CONFIG_HOME", "config");
        EXPECT_EQ(settings_path(), "/some/body/.config/gnomon/game.json");
    }
    const Variable homeless("HOME", nullptr);
    EXPECT_EQ(settings_path(), "");
}

}  // namespace
}  // namespace gnomon::game
