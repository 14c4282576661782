// SPDX-License-Identifier: MIT
#include "profile/study_folder.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <system_error>
#include <unordered_set>
#include <vector>

#include <signal.h>

#include <fmt/format.h>

#include "files.hpp"
#include "profile/draw_masks.hpp"

namespace gnomon::cli {

namespace {

namespace fs = std::filesystem;

// What write_study() makes of masks: of the whole study, and of each date.
constexpr std::array<const char*, 2> files_of_all{"report.html", "sun-path.png"};
constexpr std::array<const char*, 12> files_of_a_day{
    "summary.json",   "profile.png",  "profile.pgw",    "hours.png",
    "hours.pgw",      "hours.csv",    "difference.png", "difference.pgw",
    "difference.csv", "surfaces.png", "surfaces.csv",   "scene.png"};

Status remove_file(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (!error) return {};
    return fail(ErrorCode::Io,
                fmt::format("{} cannot be removed: {}.", path.string(), error.message()));
}

// By name, so that a file of the user's that lies among them stays.
Result<std::vector<fs::path>> files_of(const Study& study, const fs::path& out) {
    const auto jobs = mask_jobs(study);
    if (!jobs) return forward_error(jobs);
    std::vector<fs::path> files;
    for (const char* name : files_of_all) files.push_back(out / name);
    for (const sun::Date& date : study.dates) {
        for (const char* name : files_of_a_day) {
            files.push_back(out / folder_of_date(study, date) / name);
        }
    }
    for (const MaskJob& job : *jobs) files.push_back(out / "masks" / job.file);
    files.push_back(out / "masks" / points_name);
    files.push_back(out / "masks" / casters_name);
    return files;
}

Status remove_study(const Study& study, const fs::path& out) {
    const auto files = files_of(study, out);
    if (!files) return forward_error(files);
    for (const fs::path& file : *files) {
        if (const Status removed = remove_file(file); !removed) return removed;
    }
    for (const sun::Date& date : study.dates) {
        const std::string folder = folder_of_date(study, date);
        std::error_code error;
        if (folder.empty() || !fs::is_empty(out / folder, error) || error) continue;
        if (const Status removed = remove_file(out / folder); !removed) return removed;
    }
    return {};
}

// Whether it is the temporary name NAME.PID.part of OutputFiles, of a process that has ended. An
// hour, because processes of other machines, of which nothing is known, may share the folder.
bool is_left_behind(const fs::path& path) {
    constexpr std::chrono::hours enough(1);
    if (path.extension() != ".part") return false;
    const std::string pid_text = path.stem().extension().string();
    if (path.stem().stem().extension() != ".npy" || pid_text.size() < 2) return false;
    int pid = 0;
    const char* end = pid_text.data() + pid_text.size();
    const auto [at, wrong] = std::from_chars(pid_text.data() + 1, end, pid);
    if (wrong != std::errc() || at != end || pid < 1) return false;
    if (::kill(pid, 0) == 0 || errno != ESRCH) return false;
    std::error_code error;
    const auto written = fs::last_write_time(path, error);
    return !error && fs::file_time_type::clock::now() - written > enough;
}

Status remove_halves(const Study& study, const fs::path& masks) {
    const auto jobs = mask_jobs(study);
    if (!jobs) return forward_error(jobs);
    std::unordered_set<std::string> names{points_name, casters_name};
    for (const MaskJob& job : *jobs) names.insert(job.file);
    std::vector<fs::path> halves;
    std::error_code error;
    fs::directory_iterator entry(masks, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const fs::path& path = entry->path();
        if (is_left_behind(path) && names.contains(path.stem().stem().string())) {
            halves.push_back(path);
        }
    }
    if (error) {
        return fail(ErrorCode::Io,
                    fmt::format("{} cannot be read: {}.", masks.string(), error.message()));
    }
    for (const fs::path& half : halves) {
        if (const Status removed = remove_file(half); !removed) return removed;
    }
    return {};
}

Result<bool> has_numpy_files(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(folder, error)) return false;
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        if (entry->path().extension() == ".npy") return true;
    }
    if (!error) return false;
    return fail(ErrorCode::Io,
                fmt::format("{} cannot be read: {}.", folder.string(), error.message()));
}

}  // namespace

Result<std::string> whole_text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    std::error_code error;
    const auto size = fs::file_size(path, error);
    // A stream's iterator ends where reading fails, too.
    if (!file.is_open() || file.bad() || error || text.size() != size) {
        return fail(ErrorCode::Io, fmt::format("{} cannot be read.", path.string()));
    }
    return text;
}

Result<Study> read_study(const fs::path& folder) {
    const fs::path path = folder / "study.json";
    std::error_code error;
    if (!fs::is_regular_file(path, error)) {
        return fail(ErrorCode::Io,
                    fmt::format("{} is not there: {} is no folder of gnomon profile.",
                                path.string(), folder.string()));
    }
    const auto text = whole_text(path);
    if (!text) return forward_error(text);
    return study_from_json(*text, path.string());
}

std::string first_difference(const Study& a, const Study& b) {
    const nlohmann::json left = to_json(a);
    const nlohmann::json right = to_json(b);
    for (const auto& [key, value] : left.items()) {
        if (value != right.at(key)) return key;
    }
    return {};
}

Result<FolderState> state_of_folder(const Study& study, const fs::path& out) {
    std::error_code error;
    if (fs::exists(out / "study.json", error)) {
        const auto old = read_study(out);
        if (!old) return forward_error(old);
        return first_difference(study, *old).empty() ? FolderState::Same : FolderState::Another;
    }
    const auto foreign = has_numpy_files(out / "masks");
    if (!foreign) return forward_error(foreign);
    if (!*foreign) return FolderState::Fresh;
    return fail(ErrorCode::InvalidInput,
                fmt::format("--out: {} has .npy files in it and {} has no study.json: they are not "
                            "of gnomon profile, which would write among them.",
                            (out / "masks").string(), out.string()));
}

Status prepare_folder(const Study& study, const fs::path& out) {
    const auto state = state_of_folder(study, out);
    if (!state) return forward_error(state);
    std::error_code error;
    fs::create_directories(out / "masks", error);
    if (error) {
        return fail(ErrorCode::Io,
                    fmt::format("{} cannot be made: {}.", out.string(), error.message()));
    }
    if (*state == FolderState::Same) return remove_halves(study, out / "masks");
    if (*state == FolderState::Another) {
        const auto old = read_study(out);
        if (!old) return forward_error(old);
        // The old study.json stays until its masks are gone: what is cut off here is still its own.
        if (const Status removed = remove_study(*old, out); !removed) return removed;
        if (const Status removed = remove_halves(*old, out / "masks"); !removed) return removed;
    }
    OutputFiles file;
    const std::string text =
        to_json(study).dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
    const Status added = file.add(out / "study.json", text + "\n");
    if (!added) return added;
    return file.commit();
}

}  // namespace gnomon::cli
