// SPDX-License-Identifier: MIT
//
// gnomon inspect: what shadows know of a model's meshes, what that costs and what to do about it.
#pragma once

#include <string>

#include <gnomon/core/result.hpp>

namespace gnomon::cli {

struct InspectOptions {
    std::string model;
    bool json = false;
    std::string obj;  ///< write the offending edges here; empty: nowhere
};

/// The report: text for people, or JSON. Writes options.obj first: whole, or not at all.
[[nodiscard]] Result<std::string> inspect(const InspectOptions& options);

}  // namespace gnomon::cli
