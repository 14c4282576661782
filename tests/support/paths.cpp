// SPDX-License-Identifier: MIT
#include "tests/support/paths.hpp"

#include <cstdlib>

namespace gnomon::test {

std::filesystem::path source_folder() { return GNOMON_SOURCE_DIR; }

std::filesystem::path output_folder() { return GNOMON_TEST_OUTPUT; }

std::filesystem::path models_folder() {
    if (const char* set = std::getenv("GNOMON_MODELS")) return set;
    return source_folder() / ".." / "shared" / "models";
}

}  // namespace gnomon::test
