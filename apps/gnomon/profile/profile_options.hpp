// SPDX-License-Identifier: MIT
//
// What gnomon profile is asked for.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/sun_study/steps.hpp>

#include "profile/study.hpp"

namespace gnomon::cli {

/// Part `index` of `count`, from 1 on.
struct Shard {
    std::uint32_t index = 1;
    std::uint32_t count = 1;
};

struct ProfileOptions {
    std::string model = {};
    std::optional<double> latitude_deg = std::nullopt;
    std::optional<double> longitude_deg = std::nullopt;
    double elevation_m = 0.0;
    std::vector<sun::Date> dates = {};
    std::optional<std::chrono::minutes> from = std::nullopt;
    std::optional<std::chrono::minutes> to = std::nullopt;
    std::chrono::seconds step{600};
    std::chrono::minutes offset{0};
    double north_deg = 0.0;
    bool z_up = false;
    double unit_m = 1.0;
    std::optional<std::string> casters = std::nullopt;
    std::string before = {};  ///< another model, to compare with
    std::optional<std::string> receivers = std::nullopt;
    double spacing_m = 0.5;
    std::optional<glm::dvec3> eye_plan = std::nullopt;  ///< of the picture of the receivers
    std::optional<glm::dvec3> target_plan = std::nullopt;
    double cell_m = 0.5;
    std::optional<double> height_m = std::nullopt;
    std::optional<std::array<double, 4>> area_m = std::nullopt;  ///< x0, y0, x1, y1
    double min_altitude_deg = 0.0;
    std::uint32_t skip_after_sunrise_min = 0;
    std::uint32_t skip_before_sunset_min = 0;
    double pressure_mbar = 1010.0;
    double temperature_c = 10.0;
    std::optional<Shard> shard = std::nullopt;
    std::vector<std::string> merge = {};
    std::filesystem::path out = {};
    /// Left out: Scan; Projection where a backend is named.
    std::optional<PlanMethod> method = std::nullopt;
    std::string backend = {};
    std::uint32_t threads = 0;  ///< 0: as many as the process may run on
    bool quiet = false;
};

/// Runs it. What is drawn lies in files some two seconds later, and is taken over from there by a
/// later run of the same study.
[[nodiscard]] Status run_profile(const ProfileOptions& options);

}  // namespace gnomon::cli
