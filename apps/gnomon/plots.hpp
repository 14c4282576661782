// SPDX-License-Identifier: MIT
//
// Plots of a report as SVG and PNG, by the script gnomon-plot and Matplotlib.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon::cli {

/// Draws a picture for each scene and backend of `json` into `folder`. Empty where all went well,
/// else one sentence: plots are an extra, and no reason to fail.
[[nodiscard]] std::string draw_plots(const std::filesystem::path& json,
                                     const std::filesystem::path& folder);

}  // namespace gnomon::cli
