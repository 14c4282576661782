// SPDX-License-Identifier: MIT
#include "assets.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "files.hpp"

namespace gnomon::game {

namespace {

constexpr std::size_t most_level_bytes = 1U << 20U;
constexpr std::size_t most_recording_bytes = 8U << 20U;

std::size_t place_in_order(const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(playing_order, name) - playing_order.begin());
}

}  // namespace

Result<Level> load_level(const std::filesystem::path& path) {
    const auto text = cli::read_file(path, "the level", most_level_bytes);
    if (!text) return forward_error(text);
    return read_level(*text, path.string());
}

Result<Recording> load_recording(const std::filesystem::path& path) {
    const auto text = cli::read_file(path, "the recording", most_recording_bytes);
    if (!text) return forward_error(text);
    return read_recording(*text, path.string());
}

std::filesystem::path assets_folder() {
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto by = [&](const char* data_from_program) {
        return (program.parent_path() / data_from_program / "gnomon" / "game").lexically_normal();
    };
    const auto installed = by(GNOMON_DATA_FROM_PROGRAM);
    const auto built = by("../share");
    return !std::filesystem::is_directory(installed, error) &&
                   std::filesystem::is_directory(built, error)
               ? built
               : installed;
}

Result<std::vector<std::string>> level_names(const std::filesystem::path& assets) {
    const std::filesystem::path folder = assets / "levels";
    std::vector<std::string> names;
    std::error_code error;
    std::filesystem::directory_iterator entry(folder, error);
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        if (entry->path().extension() != ".json") continue;
        std::string name = entry->path().stem().string();
        if (is_level_name(name)) names.push_back(std::move(name));
    }
    if (error) {
        return fail(ErrorCode::Io, fmt::format("{}: the folder cannot be read.", folder.string()));
    }
    // What the game came with first, then others by name.
    std::ranges::sort(names, [](const std::string& a, const std::string& b) {
        return std::pair(place_in_order(a), a) < std::pair(place_in_order(b), b);
    });
    return names;
}

Result<Level> load_named_level(const std::filesystem::path& assets, const std::string& name) {
    const auto names = level_names(assets);
    if (!names) return forward_error(names);
    if (std::ranges::find(*names, name) == names->end()) {
        return fail(
            ErrorCode::InvalidInput,
            fmt::format("There is no level \"{}\" in {}; there are {}.", name,
                        (assets / "levels").string(),
                        names->empty() ? "none" : fmt::format("{}", fmt::join(*names, ", "))));
    }
    return load_level(assets / "levels" / (name + ".json"));
}

}  // namespace gnomon::game
