// SPDX-License-Identifier: MIT
#include "tests/cli/program.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "devices.hpp"
#include "tests/support/devices.hpp"
#include "tests/support/paths.hpp"

namespace gnomon::cli::test {

namespace {

std::string contents(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    EXPECT_TRUE(stream) << path;
    return {std::istreambuf_iterator<char>(stream), {}};
}

void redirect(const std::filesystem::path& path, int descriptor) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file < 0 || ::dup2(file, descriptor) < 0) ::_exit(126);
}

bool uses_a_driver(const Arguments& arguments) {
    return std::find(arguments.begin(), arguments.end(), "null") == arguments.end();
}

}  // namespace

std::size_t Mask::covered() const {
    return bytes.size() - static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), '\0'));
}

void ProgramTest::SetUp() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = gnomon::test::output_folder() / "cli" /
              (std::string(info->test_suite_name()) + "." + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "files");
    folder_ /= "files";
}

Outcome ProgramTest::run(const Arguments& arguments) const {
    const std::filesystem::path output = folder_.parent_path() / "stdout";
    const std::filesystem::path errors = folder_.parent_path() / "stderr";
    std::vector<std::string> owned = joined({GNOMON_PROGRAM}, arguments);
    std::vector<char*> argv;
    for (std::string& argument : owned) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        ::alarm(longest_run_s_);
        // Leaks of drivers are not ours; without a driver every leak is.
        if (uses_a_driver(arguments)) ::setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
        if (::chdir(folder_.c_str()) != 0) ::_exit(126);
        redirect(output, STDOUT_FILENO);
        redirect(errors, STDERR_FILENO);
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(output), contents(errors)};
}

Outcome ProgramTest::run_well(const Arguments& arguments) const {
    Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << testing::PrintToString(arguments);
    EXPECT_EQ(outcome.errors, "") << testing::PrintToString(arguments);
    return outcome;
}

void ProgramTest::expect_refused(const Arguments& arguments,
                                 const std::vector<std::string>& parts) const {
    const Outcome outcome = run(arguments);
    SCOPED_TRACE(testing::PrintToString(arguments));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    EXPECT_TRUE(outcome.errors.ends_with(".\n")) << outcome.errors;
    EXPECT_TRUE(outcome.errors.starts_with("gnomon: ")) << outcome.errors;
    for (const std::string& part : parts)
        EXPECT_NE(outcome.errors.find(part), std::string::npos) << part << " in " << outcome.errors;
}

Arguments ProgramTest::render(const std::string& scene, const Arguments& more) {
    return joined({"render", scene, "--size", "160x120"}, more);
}

Mask ProgramTest::mask_of(const std::string& scene, const Arguments& more) const {
    run_well(render(scene, joined({"--stencil", "mask"}, more)));
    return read_mask("mask.light0.pgm");
}

nlohmann::json ProgramTest::stats_of(const std::string& scene, const Arguments& more) const {
    run_well(render(scene, joined({"--stats", "stats.json"}, more)));
    return nlohmann::json::parse(read("stats.json"));
}

std::string ProgramTest::write(const std::string& name, std::string_view text) const {
    return write(name, std::as_bytes(std::span(text)));
}

std::string ProgramTest::write(const std::string& name, std::span<const std::byte> bytes) const {
    std::ofstream stream(path(name), std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
    EXPECT_TRUE(stream) << name;
    return name;
}

std::string ProgramTest::read(const std::string& name) const { return contents(path(name)); }

Mask ProgramTest::read_mask(const std::string& name) const {
    std::istringstream stream(read(name));
    std::string magic;
    std::uint32_t largest = 0;
    Mask mask;
    stream >> magic >> mask.width >> mask.height >> largest;
    EXPECT_EQ(magic, "P5") << name;
    EXPECT_EQ(largest, 255U) << name;
    EXPECT_EQ(stream.get(), '\n') << name;
    mask.bytes.assign(std::istreambuf_iterator<char>(stream), {});
    EXPECT_EQ(mask.bytes.size(), std::size_t{mask.width} * mask.height) << name;
    return mask;
}

std::vector<std::string> ProgramTest::files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

bool ProgramTest::draws(const std::string& backend) const {
    const auto names = backend_names();
    if (std::find(names.begin(), names.end(), backend) == names.end()) return false;
    const Outcome outcome =
        run({"render", "builtin:knot", "--size", "8x8", "--quiet", "--backend", backend});
    if (outcome.exit_code == 0) return true;
    EXPECT_FALSE(gnomon::test::is_required(backend)) << outcome.errors;
    return false;
}

std::string wall_and_block() {
    return R"({"primitives": [
        {"shape": "box", "name": "wall", "size": [40, 40, 1], "translation": [0, 0, -0.5]},
        {"shape": "box", "name": "block", "size": [1, 1, 1], "translation": [1.5, 2, 2]}]})";
}

Arguments facing_the_wall(const Arguments& more) {
    return joined({"--eye", "0,0,10", "--target", "0,0,0", "--fovy", "45", "--light", "dir:0,0,-1"},
                  more);
}

Arguments joined(Arguments first, const Arguments& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

}  // namespace gnomon::cli::test
