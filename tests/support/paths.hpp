// SPDX-License-Identifier: MIT
//
// Where tests find and leave files. They ask here, so that no other test is compiled anew for each
// place that the source tree is in.
#pragma once

#include <filesystem>

namespace gnomon::test {

/// The root of the source tree.
[[nodiscard]] std::filesystem::path source_folder();

/// A folder in the build tree for what tests write. May not be there yet.
[[nodiscard]] std::filesystem::path output_folder();

/// Models that are not part of the repository: $GNOMON_MODELS, else ../shared/models beside the
/// source tree. Tests skip, with the reason, where it is not there.
[[nodiscard]] std::filesystem::path models_folder();

}  // namespace gnomon::test
