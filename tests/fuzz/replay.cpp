// SPDX-License-Identifier: MIT
//
// A fuzz target without a fuzzer: runs the inputs that it is given, files or folders of them, once
// each. So the corpus is a regression test in every build, and a crash can be replayed by any
// compiler.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz_input.hpp"

namespace {

bool replay(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) {
        std::fprintf(stderr, "%s: cannot be read\n", file.c_str());
        return false;
    }
    // Before it runs: the name that stands last is the one that crashed.
    std::printf("%s\n", file.c_str());
    std::fflush(stdout);
    // A copy of its exact size: a read beyond its end is then one that a sanitizer sees.
    const std::vector<std::uint8_t> exact(bytes.begin(), bytes.end());
    LLVMFuzzerTestOneInput(exact.data(), exact.size());
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    bool all_read = true;
    int count = 0;
    for (int i = 1; i < argc; ++i) {
        if (!std::filesystem::is_directory(argv[i])) {
            all_read = replay(argv[i]) && all_read;
            ++count;
            continue;
        }
        for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i])) {
            if (!entry.is_regular_file()) continue;
            all_read = replay(entry.path()) && all_read;
            ++count;
        }
    }
    std::printf("%d inputs\n", count);
    return all_read && count > 0 ? 0 : 1;
}
