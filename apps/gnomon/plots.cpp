// SPDX-License-Identifier: MIT
#include "plots.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

extern char** environ;

namespace gnomon::cli {

namespace fs = std::filesystem;

namespace {

constexpr int without_python = -1;
constexpr int without_matplotlib = 3;  // gnomon-plot's own
constexpr int without_an_end = -2;     // by a signal

// The script's exit code. No shell: names are what they are.
int run_script(const char* python, const fs::path& script, const fs::path& json,
               const fs::path& folder) {
    std::string words[] = {python, script.string(), json.string(), folder.string()};
    char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(),
                         nullptr};
    pid_t child = 0;
    if (::posix_spawnp(&child, python, nullptr, nullptr, arguments, environ) != 0) {
        return without_python;
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : without_an_end;
}

}  // namespace

std::string draw_plots(const fs::path& json, const fs::path& folder) {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const fs::path script = program.parent_path() / "gnomon-plot";
    if (error || !fs::exists(script, error)) {
        return "There are no plots as files: the script gnomon-plot is not beside the program.";
    }
    fs::create_directories(folder, error);
    // A Python of somebody's own often comes first in the path and lacks what the system's has.
    int code = without_python;
    for (const char* python : {"python3", "/usr/bin/python3"}) {
        code = run_script(python, script, json, folder);
        if (code == 0) return {};
        if (code != without_python && code != without_matplotlib) break;
    }
    if (code == without_python) return "There are no plots as files: python3 could not be started.";
    if (code == without_matplotlib) {
        return "There are no plots as files: Matplotlib is not installed (package "
               "python3-matplotlib). The page has plots of its own.";
    }
    return "There are no plots as files: gnomon-plot failed.";
}

}  // namespace gnomon::cli
