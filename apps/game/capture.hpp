// SPDX-License-Identifier: MIT
//
// Capture: pictures of single ticks in a folder, and with them, where asked for, what the stencil
// held of each light, as `gnomon render --stencil` writes it. Named by the place of their input,
// and of the light in the level, whichever others are off: tick_000120.png,
// tick_000120.light0.pgm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

#include <gnomon/core/result.hpp>

#include "drawing.hpp"

namespace gnomon::game {

class Capture {
public:
    /// Makes the folder where it is missing. `masks`: of every light, all samples. Fails with
    /// ErrorCode::Io.
    [[nodiscard]] static Result<Capture> into(const std::filesystem::path& folder, bool masks);

    /// For Drawing::draw() of a frame that is kept: reads the masks. Nothing where none are wanted.
    [[nodiscard]] std::function<Status(std::size_t)> after_light(Drawing& drawing);
    /// The frame that `drawing` drew last, with `place` inputs before it. Fails as
    /// Drawing::read_picture() and cli::OutputFiles.
    [[nodiscard]] Status keep(Drawing& drawing, std::uint64_t place);
    [[nodiscard]] std::uint32_t pictures() const { return pictures_; }

private:
    Capture(std::filesystem::path folder, bool masks)
        : folder_(std::move(folder)), with_masks_(masks) {}

    struct Mask {
        std::size_t light = 0;
        std::uint32_t sample = 0;
        std::vector<std::byte> counts;
    };
    std::filesystem::path folder_;
    bool with_masks_;
    std::vector<Mask> masks_;  // of the frame that is being drawn
    std::uint32_t pictures_ = 0;
};

}  // namespace gnomon::game
