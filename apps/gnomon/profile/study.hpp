// SPDX-License-Identifier: MIT
//
// Study: everything that the masks of a sun study follow from. It is kept beside them as
// study.json, so that a run goes on where it was cut off, parts of one are known to belong
// together, and all that is made of the masks can be made without the model.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/sun_study/plan_grid.hpp>
#include <gnomon/sun_study/steps.hpp>

namespace gnomon::cli {

/// Of a grid: as wide as pictures can be, and as large as what is made of masks (some 80 bytes a
/// cell) fits into memory.
inline constexpr std::uint32_t most_cells_a_side = 32'000;
inline constexpr std::uint64_t most_cells = 64'000'000;
/// Of a study, those of dark steps included: each is a file.
inline constexpr std::size_t most_masks = 1'000'000;
inline constexpr std::uint32_t most_surface_points = 2'000'000;

/// How plans are drawn. Their masks differ in cells on a shadow's very edge alone.
enum class PlanMethod : std::uint8_t {
    Scan,        ///< sun_study::PlanScan: on the processor
    Projection,  ///< sun_study::PlanProjection: on a device
    Volumes,     ///< sun_study::PlanShadows: on a device
};

struct Study {
    std::string model;       ///< its file's name, without the folder
    std::string model_hash;  ///< of all casters as they are posed
    std::string casters;     ///< the glob; empty: all
    std::string before;      ///< another model to compare with; empty: none
    std::string before_hash;
    std::string receivers;       ///< the glob of surfaces that are asked about as well; empty: none
    std::string receivers_hash;  ///< of them as they are posed
    double spacing_m = 0.0;
    std::uint32_t surface_points = 0;
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    double elevation_m = 0.0;
    sun::Air air;
    std::vector<sun::Date> dates;
    std::chrono::minutes from{0};
    std::chrono::minutes to{0};
    std::chrono::seconds step{600};
    std::chrono::minutes offset{0};
    double north_deg = 0.0;  ///< clockwise from the plan's y to true north
    double min_altitude_deg = 0.0;
    std::uint32_t skip_after_sunrise_min = 0;
    std::uint32_t skip_before_sunset_min = 0;
    sun_study::PlanGrid grid;
    PlanMethod method = PlanMethod::Scan;
    std::string backend;  ///< of the device that draws; empty: Scan, which takes none
};

/// Numbers keep all their bits.
[[nodiscard]] nlohmann::json to_json(const Study& study);
/// Fails with ErrorCode::InvalidInput where it is not what to_json() makes of a study that
/// gnomon profile takes, with its limits; `place` names the file.
[[nodiscard]] Result<Study> study_from_json(const std::string& text, const std::string& place);

/// The steps of one of its dates. Fails as make_steps() does.
[[nodiscard]] Result<std::vector<sun_study::Step>> steps_of(const Study& study,
                                                            const sun::Date& date);
/// As sun_study::why_no_sun() has it.
[[nodiscard]] std::string why_no_sun(const Study& study, const sun::Date& date,
                                     std::span<const sun_study::Step> steps);

/// Towards the sun, in the plan's coordinates.
[[nodiscard]] glm::dvec3 towards_sun(const Study& study, const sun_study::Step& step);

}  // namespace gnomon::cli
