// SPDX-License-Identifier: MIT
#include "tests/support/models.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

namespace gnomon::test {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> cells_of(const std::string& row) {
    std::vector<std::string> cells;
    std::stringstream stream(row);
    std::string cell;
    std::getline(stream, cell, '|');  // before the first bar
    while (std::getline(stream, cell, '|')) {
        const std::size_t first = cell.find_first_not_of(' ');
        const std::size_t last = cell.find_last_not_of(' ');
        cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
    }
    return cells;
}

}  // namespace

std::map<std::string, fs::path> model_files() {
    std::map<std::string, fs::path> files;
    if (!fs::is_directory(models_folder())) return files;
    for (const auto& entry : fs::recursive_directory_iterator(models_folder())) {
        if (entry.path().extension() == ".glb") files[entry.path().filename()] = entry.path();
    }
    return files;
}

std::map<std::string, ManifestRow> read_manifest() {
    std::map<std::string, ManifestRow> rows;
    std::ifstream stream(models_folder() / "MANIFEST.md");
    std::vector<std::string> header;
    for (std::string line; std::getline(stream, line);) {
        if (line.empty() || line[0] != '|') {
            header.clear();
            continue;
        }
        const std::vector<std::string> cells = cells_of(line);
        if (header.empty()) {
            header = cells;
            continue;
        }
        ManifestRow row;
        for (std::size_t i = 0; i < std::min(cells.size(), header.size()); ++i) {
            row[header[i]] = cells[i];
        }
        if (row["triangles (drawn)"].find_first_of("0123456789") != 0) continue;
        rows[row["file"]] = row;
    }
    return rows;
}

}  // namespace gnomon::test
