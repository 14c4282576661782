// SPDX-License-Identifier: MIT
#include "internal/volume_draws.hpp"

#include <algorithm>
#include <span>
#include <tuple>

namespace gnomon::shadow_pass::internal {

namespace {

using shadows::FarCopies;

class Runs {
public:
    // Behind those that are there.
    Runs(const shadows::Volume& volume, std::vector<Run>& runs)
        : volume_(volume), runs_(runs), first_(runs.size()) {}

    void add(const shadows::IndexRange& range) {
        if (range.count > 0) runs_.push_back({.first = range.first, .count = range.count});
    }
    void add_near_caps(const shadows::CapList& list, bool exchanged, Role role) {
        add_triples(list.triples, 0, exchanged, role);
        add_ranges(list, 0, exchanged, role);
        add_triples(list.undone, 0, !exchanged, role);
    }
    void add_far_caps(const shadows::CapList& list, bool exchanged) {
        if (volume_.far_copies == FarCopies::OfAll) {
            add_triples(list.triples, 1, exchanged, Role::Volume);
            add_triples(list.undone, 1, !exchanged, Role::Volume);
        }
        if (volume_.far_copies != FarCopies::None) add_ranges(list, 1, exchanged, Role::Volume);
    }

    void finish() {
        const auto state_of = [](const Run& r) {
            return std::tie(r.exchanged, r.role, r.of_mesh, r.base_vertex);
        };
        const auto first = runs_.begin() + static_cast<std::ptrdiff_t>(first_);
        std::sort(first, runs_.end(), [&](const Run& a, const Run& b) {
            return std::tuple(state_of(a), a.first) < std::tuple(state_of(b), b.first);
        });
        std::size_t joined = first_;
        for (std::size_t i = first_; i < runs_.size(); ++i) {
            const Run run = runs_[i];
            Run* last = joined > first_ ? &runs_[joined - 1] : nullptr;
            if (last != nullptr && last->first + last->count == run.first &&
                state_of(*last) == state_of(run)) {
                last->count += run.count;
            } else {
                runs_[joined++] = run;
            }
        }
        runs_.resize(joined);
    }

private:
    void add_triples(const shadows::IndexRange& range, std::int32_t base_vertex, bool exchanged,
                     Role role) {
        if (range.count == 0) return;
        runs_.push_back({range.first, range.count, base_vertex, exchanged, false, role});
    }
    void add_ranges(const shadows::CapList& list, std::int32_t base_vertex, bool exchanged,
                    Role role) {
        for (const shadows::FaceRange& range :
             std::span(volume_.ranges).subspan(list.ranges.first, list.ranges.count)) {
            runs_.push_back({3 * range.first, 3 * range.count, base_vertex, exchanged, true, role});
        }
    }

    const shadows::Volume& volume_;
    std::vector<Run>& runs_;
    std::size_t first_;
};

}  // namespace

Ends ends_of(const shadows::VolumeDraw& draw, const shadows::VolumeSlab* slab,
             const ShadowPassDesc& desc) {
    const bool fails = draw.technique == shadows::Technique::DepthFail;
    // On a plane where no surface is, caps are biased in front of none.
    const bool on_surface = slab == nullptr || !slab->from_plane;
    return {.near = fails || (slab != nullptr ? slab->near_caps : draw.near_caps),
            .far = slab != nullptr ? slab->far_caps : draw.far_caps,
            .open = on_surface && desc.averted_faces == AvertedFaces::LeftToShading,
            .biased = on_surface && !desc.cap_bias.none()};
}

void append_runs(const shadows::Volume& volume, const Ends& ends, std::vector<Run>& out) {
    const Role cap = ends.biased ? Role::Cap : Role::Volume;
    Runs runs(volume, out);
    if (ends.far) runs.add(volume.far_cap);
    runs.add(volume.sides);
    if (ends.near) {
        runs.add_near_caps(volume.near_cap, false, cap);
        runs.add_near_caps(volume.near_cap_flipped, true, cap);
    }
    // In front of the surface that they lie on, open caps count in depth-pass as well.
    if (ends.near || ends.open) {
        runs.add_near_caps(volume.near_cap_averted, true, ends.open ? Role::OpenCap : cap);
    }
    if (ends.far) {
        runs.add_far_caps(volume.near_cap, true);
        runs.add_far_caps(volume.near_cap_flipped, false);
        runs.add_far_caps(volume.near_cap_averted, false);
    }
    runs.finish();
}

std::vector<Run> near_caps_of(const shadows::ShadowMesh& mesh, const shadows::Volume& volume) {
    std::vector<Run> runs;
    for (const shadows::CapList& list : volume.near_caps()) {
        if (list.triples.count > 0) runs.push_back({list.triples.first, list.triples.count});
        shadows::for_each_face_of_ranges(
            mesh, std::span(volume.ranges).subspan(list.ranges.first, list.ranges.count),
            std::span(volume.indices).subspan(list.undone.first, list.undone.count),
            [&](std::uint32_t f) {
                if (!runs.empty() && runs.back().of_mesh &&
                    runs.back().first + runs.back().count == 3 * f) {
                    runs.back().count += 3;
                } else {
                    runs.push_back({.first = 3 * f, .count = 3, .of_mesh = true});
                }
            });
    }
    return runs;
}

}  // namespace gnomon::shadow_pass::internal
