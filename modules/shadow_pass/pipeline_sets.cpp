// SPDX-License-Identifier: MIT
#include "internal/pipeline_sets.hpp"

#include <utility>

#include "internal/stencil_fold.hpp"

namespace gnomon::shadow_pass::internal {

Status PipelineSets::ensure(shadows::QuadFacing facing, const VertexStage& stage, bool batched) {
    Set& set = sets_[static_cast<std::size_t>(facing)];
    const auto make = [&](std::optional<Pipelines>& out, const Counting& counting) -> Status {
        if (out) return {};
        auto made = create_volume_pipelines(*device_, desc_, stage, fragment_, counting);
        if (!made) return forward_error(made);
        out = std::move(*made);
        return {};
    };
    const Status made =
        make(set.counting[batched ? 1 : 0], {batched ? StencilFold::count_mask : 0xFFU});
    if (!made || !desc_.meter) return made;
    for (const Fill fill : {Fill::Rasterised, Fill::Counted, Fill::PerPixel}) {
        const Status metered = make(set.metered[static_cast<std::size_t>(fill)], {.fill = fill});
        if (!metered) return metered;
    }
    return {};
}

const Pipelines& PipelineSets::get(shadows::QuadFacing facing, bool batched,
                                   std::optional<Fill> metered) const {
    const Set& set = sets_[static_cast<std::size_t>(facing)];
    return metered ? *set.metered[static_cast<std::size_t>(*metered)]
                   : *set.counting[batched ? 1 : 0];
}

}  // namespace gnomon::shadow_pass::internal
