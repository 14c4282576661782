// SPDX-License-Identifier: MIT
//
// LightUmbras: which casters lie wholly in the umbra of another one, for one light. A few casters
// that look largest from the light are candidates; all others are asked about those.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>

#include "slots.hpp"
#include "umbra.hpp"

namespace gnomon::shadows::internal {

struct CasterState;

/// CasterState::hides_m2: what is convex has no more area than a box round it. Cost: some flops.
[[nodiscard]] double most_hiding_area(const CasterState& caster);

/// What has changed since LightUmbras was brought up to date last, and what has not.
struct UmbraTerms {
    const Slots<CasterState>& casters;
    const std::vector<std::uint32_t>& changed;  ///< casters, each once
    const Light& light;
    bool all = false;     ///< the light did, or what all depends on
    double follow = 0.0;  ///< Umbra::make()
};

/// What it says is a function of casters and light as they are, whatever was before.
///
/// That a caster in an umbra needs no volume holds whether or not the other one has one: what lies
/// behind it lies behind whatever hides it. No two can hide each other, nor several in a ring:
/// each point of a caster in an umbra is farther from the light (or along its way) than a point of
/// the one that it is behind, by the margin of Umbra::holds(), so that the nearest point of them
/// all would have one nearer.
class LightUmbras {
public:
    /// Candidates of a light. More hide little more, and all that moves is asked about them.
    static constexpr std::size_t most = 32;

    /// Writes down whose state turned(). Cost: where nothing changed, nothing; for each caster that
    /// did, some flops a candidate; where the light or a candidate did, the same for all casters.
    void update(const UmbraTerms& terms);

    [[nodiscard]] bool holds(std::uint32_t caster) const {
        return caster < behind_.size() && behind_[caster] != 0;
    }
    /// How many casters are held.
    [[nodiscard]] std::uint64_t count() const { return count_; }
    /// By the last update(): casters that came into an umbra or out of all.
    [[nodiscard]] const std::vector<std::uint32_t>& turned() const { return turned_; }
    /// The caster's slot is given up.
    void forget(std::uint32_t caster);
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    // Ordered by score, then by key and part.
    struct Candidate {
        double score = 0.0;
        std::uint64_t key = 0;
        std::uint32_t caster = no_slot;
        std::uint32_t part = 0;
        bool made = false;
        bool anew = true;  // at this update
        Umbra umbra = {};
    };
    // Of each candidate: what of the world is in its shadow at the most, a cone or a cylinder round
    // a sphere, so that few umbras are asked, and made. Several at a time; relative to `base`.
    struct Surrounds {
        using Row = std::array<float, most>;
        glm::dvec3 base{0.0};
        std::array<Row, 3> tip;
        std::array<Row, 3> axis;
        Row first;  // along the axis
        Row wide2;  // squared distance from it: wide2 + widens2 * along * along
        Row widens2;
    };
    using Marks = std::array<std::int32_t, most>;

    [[nodiscard]] bool keeps_candidates(const UmbraTerms& terms);
    void choose(const UmbraTerms& terms);
    void surround(const UmbraTerms& terms);
    [[nodiscard]] bool mark(const glm::dvec3& point, Marks& marks) const;
    [[nodiscard]] std::uint8_t find(const UmbraTerms& terms, std::uint32_t caster, bool anew_alone);
    void set(std::uint32_t caster, std::uint8_t now);

    std::vector<Candidate> candidates_, before_;
    std::unique_ptr<Surrounds> surrounds_;  // of candidates_
    std::vector<std::uint8_t> moved_to_;    // by 1 + the number of a candidate before: its, or 0
    bool lost_ = false;                     // a candidate went
    std::vector<std::uint8_t> behind_;      // by caster: 1 + a candidate's number, or 0
    std::uint64_t count_ = 0;
    std::vector<std::uint32_t> turned_;
};

}  // namespace gnomon::shadows::internal
