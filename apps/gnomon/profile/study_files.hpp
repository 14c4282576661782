// SPDX-License-Identifier: MIT
//
// The files of a sun study that people and programs read: pictures, tables, summaries, the page.
#pragma once

#include <filesystem>

#include "files.hpp"
#include "profile/surface_picture.hpp"

namespace gnomon::cli {

/// Writes all of a study into its folder, from the masks in its folder "masks": profile.png,
/// hours.png, a world file beside each, hours.csv and summary.json, one set a date (in folders
/// named by date where there are several), and sun-path.png and report.html; difference.png and
/// .csv where there is a model before, surfaces.png and .csv where there are receivers; scene.png
/// where the camera has an eye and what casts is in the folder "masks" as well.
[[nodiscard]] Status write_study(const Study& study, const std::filesystem::path& out,
                                 const PictureCamera& camera);

}  // namespace gnomon::cli
