// SPDX-License-Identifier: MIT
//
// PipelineSets: the pipelines that a pass has come to need, by where vertices come from and by what
// is to be counted. Made when they are first needed.
#pragma once

#include <array>
#include <optional>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>
#include <gnomon/shadows/edge_quads.hpp>

#include "volume_pipelines.hpp"

namespace gnomon::shadow_pass::internal {

class PipelineSets {
public:
    /// The fragment shader must outlive it.
    PipelineSets(gpu::Device& device, const ShadowPassDesc& desc, gpu::ShaderId fragment)
        : device_(&device), desc_(desc), fragment_(fragment) {}

    /// Makes what get() gives, where it is not there. `facing` names the vertex stage: None for
    /// vertices that are fed. `batched`: for lights that are split.
    [[nodiscard]] Status ensure(shadows::QuadFacing facing, const VertexStage& stage, bool batched);

    /// For record(), or for record_fill() where `metered` says for what.
    [[nodiscard]] const Pipelines& get(shadows::QuadFacing facing, bool batched,
                                       std::optional<Fill> metered) const;

private:
    struct Set {
        std::array<std::optional<Pipelines>, 2> counting;  // by `batched`
        std::array<std::optional<Pipelines>, 3> metered;   // by Fill
    };

    gpu::Device* device_;
    ShadowPassDesc desc_;
    gpu::ShaderId fragment_;
    std::array<Set, 3> sets_;  // by QuadFacing
};

}  // namespace gnomon::shadow_pass::internal
