// SPDX-License-Identifier: MIT
//
// A host with a renderer of its own: it fills a depth buffer with shaders of its own and counts
// shadow volumes against that. What gnomon::shadow_pass is told to do there, and nothing of
// gnomon::render, is on trial.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <gnomon/gpu/device.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>
#include <gnomon/shadows/shadow_system.hpp>

#include "tests/rows/rows.hpp"

namespace gnomon::test {

enum class Depth : std::uint8_t {
    Shared,   ///< from gnomon's position function
    Foreign,  ///< clip_from_view * (view_from_world * (world_from_local * p)), in single precision,
              ///< in a world whose origin is the eye
};

struct HostOptions {
    Depth depth = Depth::Shared;
    shadows::NearCaps near_caps = shadows::NearCaps::Facing;
    shadow_pass::AvertedFaces averted_faces = shadow_pass::AvertedFaces::Shadowed;
    shadow_pass::CapBias cap_bias = {};
    std::optional<shadows::Technique> technique = std::nullopt;
    std::uint32_t width = row_width;
    std::uint32_t height = row_height;
};

struct HostPicture {
    std::vector<std::vector<std::uint8_t>> masks;  ///< by light: one byte a pixel, row 0 on top
    std::vector<std::byte> depth;                  ///< raw bytes of the floats
    shadows::DrawList list;
};

/// Throws what fails, as must() does, which fails the test.
[[nodiscard]] HostPicture host_picture(gpu::Device& device, const Setting& setting,
                                       const HostOptions& options);

}  // namespace gnomon::test
