// SPDX-License-Identifier: MIT
#include "source_tree.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace gnomon::layers {

namespace {

// Mirrors .gitignore, for the layers hold in an unpacked archive too, where nobody can ask git.
bool is_outside(const std::string& top) {
    return top == ".git" || top == "build" || top.starts_with("build-") || top == "out";
}

}  // namespace

std::vector<SourceFile> read_tree(const std::filesystem::path& root) {
    std::vector<SourceFile> files;
    for (auto it = std::filesystem::recursive_directory_iterator(root);
         it != std::filesystem::recursive_directory_iterator(); ++it) {
        if (it.depth() == 0 && is_outside(it->path().filename().string())) {
            it.disable_recursion_pending();
            continue;
        }
        if (it->is_symlink() || !it->is_regular_file()) continue;
        std::ifstream stream(it->path(), std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(stream), {}};
        if (text.find('\0') != std::string::npos) continue;
        files.push_back({std::filesystem::relative(it->path(), root).generic_string(), text});
    }
    std::ranges::sort(files, {}, &SourceFile::path);
    return files;
}

}  // namespace gnomon::layers
