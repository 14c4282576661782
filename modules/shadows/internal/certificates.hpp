// SPDX-License-Identifier: MIT
//
// Exact temporal coherence (strategies/certificates.cpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <gnomon/shadows/detector.hpp>

#include "deadlines.hpp"
#include "displacement.hpp"
#include "side_detection.hpp"
#include "silhouette_set.hpp"

namespace gnomon::shadows::internal {

/// detect() is all of it; its steps are for who chooses between this and other ways.
class Certificates final : public SilhouetteDetector {
public:
    const Detection& detect(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) override;
    [[nodiscard]] std::size_t memory_bytes() const override;

    enum class Due : std::uint8_t {
        Nothing,  ///< found() is the answer
        Some,     ///< renew() is to be called
        Much,     ///< search() costs less than to renew all that is due, as far as can be told
    };
    /// What a light asks for that is of the same kind as that of the last search(), for the same
    /// mesh. One that is not finite is Much.
    [[nodiscard]] Due look(LightLocal light) {
        found_.stats = {};
        found_.changed = false;
        const double way = way_to(light);
        const double next = std::min(deadlines_.next(), castings_deadline_);
        if (!(way <= next)) return find_due(light, way);
        found_.margin = std::max(0.0, sum_down(next, -way));
        return Due::Nothing;
    }
    void renew(const ShadowMesh& mesh);
    /// Starts anew. `light` is finite.
    void search(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps);
    [[nodiscard]] Detection& found() { return found_; }

    /// What the last renew() or search() cost (internal/work.hpp).
    [[nodiscard]] double work() const { return work_; }
    /// What the last search() would have cost without certificates.
    [[nodiscard]] double jump_work() const { return jump_work_; }

private:
    // Never less than the exact sum, or never more, so that no certificate is trusted too long.
    static double sum_up(double a, double b) {
        return (a + b) * (1.0 + std::numeric_limits<double>::epsilon());
    }
    static double sum_down(double a, double b) {
        return (a + b) * (1.0 - std::numeric_limits<double>::epsilon());
    }

    // The way that the light has come if it is there now.
    [[nodiscard]] double way_to(LightLocal light) const {
        return sum_up(way_, displacement(light_, light));
    }
    [[nodiscard]] Due find_due(LightLocal light, double way);
    bool renew_castings(const ShadowMesh& mesh);
    // Returns what it cost.
    double find_whole_silhouette(const ShadowMesh& mesh, const FilterLight& light);
    [[nodiscard]] double margin() const;

    std::uint64_t mesh_ = 0;  // 0: nothing is known
    NearCaps near_caps_ = NearCaps::Facing;
    LightLocal light_;     // where the light was when something was due last
    double way_ = 0.0;     // that it had come
    Deadlines deadlines_;  // by block of faces
    double castings_deadline_ = 0.0;
    Sides sides_;
    Detection found_;
    SilhouetteSet silhouette_{found_.silhouette};
    std::vector<std::uint32_t> flipped_;
    std::vector<std::uint32_t> blocks_;  // searched, or due
    // Where more blocks are due, a search costs less; and the step by which more are at once.
    std::size_t most_due_ = 0;
    double far_ = 0.0;
    double work_ = 0.0;
    double jump_work_ = 0.0;
};

}  // namespace gnomon::shadows::internal
