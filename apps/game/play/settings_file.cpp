// SPDX-License-Identifier: MIT
#include "play/settings_file.hpp"

#include <cstddef>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "files.hpp"

namespace gnomon::game {

namespace {

constexpr std::size_t most_settings_bytes = 1U << 20U;

}  // namespace

std::filesystem::path settings_path() {
    const auto folder = [](const char* name) -> std::optional<std::filesystem::path> {
        const char* value = std::getenv(name);
        if (value == nullptr) return std::nullopt;
        std::filesystem::path path(value);
        // What is not absolute does not count, says the XDG base directory specification.
        if (!path.is_absolute()) return std::nullopt;
        return path;
    };
    if (const auto config = folder("XDG_CONFIG_HOME")) return *config / "gnomon" / "game.json";
    if (const auto home = folder("HOME")) return *home / ".config" / "gnomon" / "game.json";
    return {};
}

LoadedSettings load_settings(const std::filesystem::path& path) {
    std::error_code error;
    if (path.empty() || !std::filesystem::exists(path, error)) return {};
    const auto refuse = [&](std::string why) {
        return LoadedSettings{.settings = {}, .complaint = std::move(why)};
    };
    const auto text = cli::read_file(path, "the settings file", most_settings_bytes);
    if (!text) return refuse(text.error().message);
    auto settings = read_settings(*text, path.string());
    if (!settings) return refuse(settings.error().message);
    return {.settings = std::move(*settings), .complaint = {}};
}

Status save_settings(const std::filesystem::path& path, const Settings& settings) {
    if (path.empty()) return {};
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) {
        return fail(ErrorCode::Io, fmt::format("{}: the folder cannot be made: {}.",
                                               path.parent_path().string(), error.message()));
    }
    cli::OutputFiles files;
    if (const Status added = files.add(path, to_text(settings)); !added) return added;
    return files.commit();
}

}  // namespace gnomon::game
