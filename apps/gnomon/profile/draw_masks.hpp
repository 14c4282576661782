// SPDX-License-Identifier: MIT
//
// The masks of a study, drawn into files, one a step: those that are not there already.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gnomon/gpu/device.hpp>

#include "profile/day_result.hpp"
#include "profile/site_model.hpp"
#include "profile/study.hpp"

namespace gnomon::cli {

/// One mask: of a step of a day, or of what lies under a roof, which has no step.
struct MaskJob {
    MaskKind kind = MaskKind::Plan;
    std::string file;  ///< in the folder of masks
    std::string what;  ///< for people
    glm::dvec3 towards_sun{0.0, 0.0, 1.0};
    bool is_open_mask = false;
};

/// All masks of a study, in the order in which they are dealt out to shards. A date without sun has
/// none. Fails as make_steps() does, and with ErrorCode::InvalidInput, and one sentence, where no
/// date has sun, and for more than most_masks, before it has made any.
[[nodiscard]] Result<std::vector<MaskJob>> mask_jobs(const Study& study);

/// A sentence for each date on which the sun counts at no step.
[[nodiscard]] std::vector<std::string> days_without_sun(const Study& study);

struct MaskShape {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
};
[[nodiscard]] MaskShape shape_of(const Study& study, MaskKind kind);

/// What masks are drawn of, and on.
struct MaskSubjects {
    std::optional<gpu::Device> device;  ///< none where the study's method takes none
    std::vector<shadows::Caster> casters;
    std::vector<shadows::Caster> before;
    std::vector<sun_study::SurfacePoint> points;
};

/// Draws those that fall to the shard and, where `takes_over` says that the folder is the study's,
/// are not in it; each is written whole or not at all. `before_writing` is called once: when all
/// that drawing takes was made and the first mask drawn, or nothing is missing; masks can be
/// written from then on. Says how far it is on a terminal. Fails as the device and `before_writing`
/// do, and with ErrorCode::InvalidInput where something lies above every cell.
[[nodiscard]] Status draw_masks(const Study& study, const std::vector<MaskJob>& jobs,
                                MaskSubjects& subjects, const ProfileOptions& options,
                                const std::filesystem::path& masks_folder, bool takes_over,
                                const std::function<Status()>& before_writing);

}  // namespace gnomon::cli
