// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <gnomon/core/result.hpp>

namespace gnomon::cli {

struct InspectOptions {
    std::string model;
    bool json = false;
};

/// The topology report of a model's meshes: text for people, or JSON.
[[nodiscard]] Result<std::string> inspect(const InspectOptions& options);

}  // namespace gnomon::cli
