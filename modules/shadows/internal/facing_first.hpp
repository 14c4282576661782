// SPDX-License-Identifier: MIT
//
// FacingFirst: a detector that classifies every face, as brute_force does, and then looks for edges
// in a way of its own. The strategies of the literature are all of this kind, so that a comparison
// of them is one of their ways to the edges alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/shadows/detector.hpp>

#include "strategies.hpp"

namespace gnomon::shadows::internal {

class FacingFirst : public SilhouetteDetector {
public:
    const Detection& detect(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) final {
        if (mesh.id() != prepared_for_) prepare(mesh);
        prepared_for_ = mesh.id();
        classify_faces(mesh, light, facing_, near_caps, FacingFilter::Scalar);
        pack_weights(facing_.weights, found_.casting);
        found_.silhouette.clear();
        found_.stats = {.faces_tested = mesh.faces().size(),
                        .edges_tested = 0,
                        .double_tests = facing_.stats.double_tests,
                        .exact_tests = facing_.stats.exact_tests,
                        .bytes_touched = mesh.faces().size() * (5 * sizeof(float) + 2)};
        find_edges(mesh, light, facing_.weights, found_.silhouette, found_.stats);
        found_.solid_averted = facing_.solid_averted;
        found_.margin = facing_.margin;
        return found_;
    }

    [[nodiscard]] std::size_t memory_bytes() const final {
        return facing_.weights.capacity() + facing_.solid_averted.capacity() + memory_of(found_) +
               own_bytes();
    }

protected:
    /// Another mesh than before, or the first: replaces what is kept of it.
    virtual void prepare(const ShadowMesh& mesh) = 0;
    /// Fills the silhouette, which is empty, and adds to the stats what that took. The weights are
    /// all 0 where the light is not finite.
    virtual void find_edges(const ShadowMesh& mesh, LightLocal light,
                            std::span<const std::int8_t> weights,
                            std::vector<SilhouetteEdge>& silhouette, DetectionStats& stats) = 0;
    /// The object itself and what it keeps beyond the answer.
    [[nodiscard]] virtual std::size_t own_bytes() const = 0;

private:
    Facing facing_;
    Detection found_;
    std::uint64_t prepared_for_ = 0;  // no mesh has that id
};

}  // namespace gnomon::shadows::internal
