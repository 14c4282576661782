// SPDX-License-Identifier: MIT
//
// The folder of a study: which study's it is, and how one makes room for another without touching
// what gnomon profile has not made.
#pragma once

#include <filesystem>
#include <string>

#include <gnomon/core/result.hpp>

#include "profile/study.hpp"

namespace gnomon::cli {

/// Fails with ErrorCode::Io.
[[nodiscard]] Result<std::string> whole_text(const std::filesystem::path& path);

/// The study whose folder it is. Fails with ErrorCode::Io where it has no study.json or that cannot
/// be read, otherwise as study_from_json() does.
[[nodiscard]] Result<Study> read_study(const std::filesystem::path& folder);

/// What differs between them first, by its name in study.json; empty: nothing.
[[nodiscard]] std::string first_difference(const Study& a, const Study& b);

enum class FolderState : std::uint8_t {
    Fresh,    ///< no study's
    Same,     ///< this study's: its masks are taken over
    Another,  ///< another study's
};

/// Changes nothing. Fails as read_study() does where there is a study.json, and with
/// ErrorCode::InvalidInput where there is none, but a folder "masks" with NumPy files in it: they
/// are somebody else's.
[[nodiscard]] Result<FolderState> state_of_folder(const Study& study,
                                                  const std::filesystem::path& out);

/// Makes the folder this study's, with a study.json and a folder for masks. Of another study's,
/// what was written for it is removed: its masks and all that was made of them, by name; nothing
/// else is. Halves of this study's masks that a killed run left an hour ago or earlier are removed
/// as well. Fails as state_of_folder() does, and with ErrorCode::Io.
[[nodiscard]] Status prepare_folder(const Study& study, const std::filesystem::path& out);

}  // namespace gnomon::cli
