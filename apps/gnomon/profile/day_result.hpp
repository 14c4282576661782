// SPDX-License-Identifier: MIT
//
// DayResult: what the masks of one day come to.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gnomon/sun_study/criteria.hpp>
#include <gnomon/sun_study/plan_mask.hpp>
#include <gnomon/sun_study/surface_points.hpp>

#include "profile/study.hpp"

namespace gnomon::cli {

/// An outline of the profile: the shadow of one step.
struct ProfileStep {
    std::size_t step = 0;  ///< in DayResult::steps
    sun_study::PlanMask lit;
};

struct DayResult {
    sun::Date date{};
    std::vector<sun_study::Step> steps;
    sun_study::SunHours hours{0};
    std::vector<std::uint8_t> open;  ///< 0 where something lies above the cell
    /// By cell: the steps that count at which it is dark, and the sum of their places among all
    /// (0 .. 1, by the clock).
    std::vector<std::uint32_t> dark_steps;
    std::vector<float> dark_places;
    std::size_t counted_steps = 0;
    std::string no_sun;                 ///< why none counts, in a sentence; empty where some do
    std::vector<ProfileStep> outlines;  ///< some 16 at most, evenly over the day
    sun_study::HoursSummary summary;
    std::vector<sun_study::Criterion> criteria;

    /// When a step is, from 0 at the first that counts to 1 at the last.
    [[nodiscard]] double place_of(std::size_t step) const;
    [[nodiscard]] double most_hours() const;  ///< that any cell could have
};

/// What a mask is of.
enum class MaskKind : std::uint8_t {
    Plan,     ///< the grid
    Before,   ///< the grid, with the model that is compared with
    Surface,  ///< the points on receivers: one row of them
};

/// The names of the files that masks are kept in, in the folder of masks.
[[nodiscard]] std::string mask_name(MaskKind kind, const sun::Date& date,
                                    const sun_study::Step& step);
[[nodiscard]] std::string open_mask_name(MaskKind kind);
/// Where what is made of a date's masks lies in the study's folder; empty: in the folder itself.
[[nodiscard]] std::string folder_of_date(const Study& study, const sun::Date& date);
inline constexpr const char* points_name = "surface-points.npy";
/// What casts, for perspective pictures: the corners of each face. It is there where --eye was
/// given.
inline constexpr const char* casters_name = "casters.npy";
inline constexpr std::uint32_t numbers_a_face = 9;

/// Sun hours of the points on receivers, for one day.
struct SurfaceResult {
    std::vector<sun_study::SurfacePoint> points;
    sun_study::SunHours hours{0};
};

/// The points as a matrix of numbers: middle, normal, area, three corners; and back.
inline constexpr std::uint32_t numbers_a_point = 16;
[[nodiscard]] std::vector<double> numbers_of(const std::vector<sun_study::SurfacePoint>& points);

/// From the masks in a folder, which are all there. Fails as read_mask() does.
[[nodiscard]] Result<DayResult> gather_day(const Study& study, const sun::Date& date,
                                           const std::filesystem::path& masks,
                                           MaskKind kind = MaskKind::Plan);
[[nodiscard]] Result<SurfaceResult> gather_surface(const Study& study, const sun::Date& date,
                                                   const std::filesystem::path& masks);

}  // namespace gnomon::cli
