// SPDX-License-Identifier: MIT
//
// `--stats`: what a run measured, as JSON. The members are a contract; more may be added.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gnomon/gpu/caps.hpp>
#include <gnomon/shadow_pass/fill_meter.hpp>
#include <gnomon/shadows/shadow_system.hpp>

namespace gnomon::cli {

struct FrameRecord {
    double frame_ms =
        0.0;  ///< from the frame's first call until the device has finished it; no read-back
    double record_ms = 0.0;
    double submit_ms = 0.0;
    std::uint64_t upload_bytes = 0;
    std::uint64_t draw_calls = 0;
    std::uint64_t depth_bounded_draws = 0;
    shadows::FrameStats shadows;
    std::optional<std::vector<shadow_pass::LightFill>> fill;  ///< none: not asked for, or no way
};

struct RunRecord {
    gpu::Caps caps;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t samples = 1;
    std::uint64_t triangles = 0;
    std::vector<FrameRecord> frames;
};

[[nodiscard]] std::string to_json(const RunRecord& run);

}  // namespace gnomon::cli
