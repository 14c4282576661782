// SPDX-License-Identifier: MIT
#include "capture.hpp"

#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "files.hpp"

namespace gnomon::game {

Result<Capture> Capture::into(const std::filesystem::path& folder, bool masks) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        return fail(ErrorCode::Io, fmt::format("{}: the folder cannot be made: {}.",
                                               folder.string(), error.message()));
    }
    return Capture(folder, masks);
}

std::function<Status(std::size_t)> Capture::after_light(Drawing& drawing) {
    masks_.clear();
    if (!with_masks_) return {};
    return [this, &drawing](std::size_t light) -> Status {
        for (std::uint32_t sample = 0; sample < drawing.renderer().desc().sample_count; ++sample) {
            auto counts = drawing.read_mask(sample);
            if (!counts) return forward_error(counts);
            masks_.push_back({light, sample, std::move(*counts)});
        }
        return {};
    };
}

Status Capture::keep(Drawing& drawing, std::uint64_t place) {
    const auto rgba = drawing.read_picture();
    if (!rgba) return forward_error(rgba);
    const render::RendererDesc& drawn = drawing.renderer().desc();
    const std::string stem = fmt::format("tick_{:06}", place);
    cli::OutputFiles files;
    if (const Status added =
            files.add_png(folder_ / (stem + ".png"), drawn.width, drawn.height, *rgba);
        !added) {
        return added;
    }
    for (const Mask& mask : std::exchange(masks_, {})) {
        const std::string name = fmt::format("{}.light{}", stem, mask.light);
        std::vector<std::string> names;
        if (mask.sample == 0) names.push_back(name + ".pgm");
        if (drawn.sample_count > 1) names.push_back(fmt::format("{}.s{}.pgm", name, mask.sample));
        for (const std::string& file : names) {
            const Status added =
                files.add_pgm(folder_ / file, drawn.width, drawn.height, mask.counts);
            if (!added) return added;
        }
    }
    if (const Status kept = files.commit(); !kept) return kept;
    ++pictures_;
    return {};
}

}  // namespace gnomon::game
