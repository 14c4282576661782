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
    Runs(const shadows::Volume& volume, std::vector<Run>& runs) : volume_(volume), runs_(runs) {
        runs_.clear();
    }

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
        std::sort(runs_.begin(), runs_.end(), [&](const Run& a, const Run& b) {
            return std::tuple(state_of(a), a.first) < std::tuple(state_of(b), b.first);
        });
        std::size_t joined = 0;
        for (const Run& run : runs_) {
            Run* last = joined > 0 ? &runs_[joined - 1] : nullptr;
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
};

}  // namespace

void runs_of(const shadows::VolumeDraw& draw, const shadows::Volume& volume,
             const ShadowPassDesc& desc, std::vector<Run>& out) {
    const bool near = draw.technique == shadows::Technique::DepthFail || draw.near_caps;
    const bool far = draw.far_caps;
    const bool open = desc.averted_faces == AvertedFaces::LeftToShading;
    const Role cap = desc.cap_bias.none() ? Role::Volume : Role::Cap;
    Runs runs(volume, out);
    if (far) runs.add(volume.far_cap);
    runs.add(volume.sides);
    if (near) {
        runs.add_near_caps(volume.near_cap, false, cap);
        runs.add_near_caps(volume.near_cap_flipped, true, cap);
    }
    // In front of the surface that they lie on, open caps count in depth-pass as well.
    if (near || open) runs.add_near_caps(volume.near_cap_averted, true, open ? Role::OpenCap : cap);
    if (far) {
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
