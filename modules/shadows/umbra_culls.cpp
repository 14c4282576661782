// SPDX-License-Identifier: MIT
#include "internal/umbra_culls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "internal/finite.hpp"
#include "internal/system_state.hpp"

namespace gnomon::shadows {

namespace internal {

namespace {

bool may_hide_others(const CasterState& caster) { return caster.hides_m2 > 0.0; }

double squared_scale(const CasterState& caster) {
    const glm::dmat4& pose = caster.pose.world_from_local;
    double scale2 = 0.0;
    for (int i = 0; i < 3; ++i) scale2 += glm::dot(glm::dvec3(pose[i]), glm::dvec3(pose[i])) / 3.0;
    return scale2;
}

// How large the light sees something of an area, about; 0: not at all.
double score_of(const CasterState& caster, double area_m2, const Light& light) {
    if (light.position_world.w == 0.0) return area_m2;
    const glm::dvec3 way = caster.center - glm::dvec3(light.position_world);
    const double distance2 = std::max(glm::dot(way, way), 0.25 * caster.radius * caster.radius);
    return distance2 > 0.0 ? area_m2 / distance2 : 0.0;
}

double score_of(const CasterState& caster, const ConvexPart& part, const Light& light) {
    return score_of(caster, squared_scale(caster) * part.area, light);
}

// No part's score is higher. Saves looking for the parts of most meshes.
double most_score_of(const CasterState& caster, const Light& light) {
    return score_of(caster, caster.hides_m2, light);
}

}  // namespace

double most_hiding_area(const CasterState& caster) {
    // Averted caps begin behind the caster's own inside, where it does not shadow itself.
    if (!caster.pose.finite || caster.pose.singular || caster.near_caps != NearCaps::Facing ||
        caster.mesh->is_deformed()) {
        return 0.0;
    }
    const glm::dvec3 size =
        glm::dvec3(caster.mesh->bounds_max()) - glm::dvec3(caster.mesh->bounds_min());
    const double box = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
    return 1.01 * squared_scale(caster) * box;
}

void LightUmbras::forget(std::uint32_t caster) {
    if (caster < behind_.size()) set(caster, 0);
    lost_ =
        lost_ || std::ranges::find(candidates_, caster, &Candidate::caster) != candidates_.end();
}

void LightUmbras::set(std::uint32_t caster, std::uint8_t now) {
    const bool is = now != 0;
    const bool was = behind_[caster] != 0;
    behind_[caster] = now;
    if (is == was) return;
    count_ = is ? count_ + 1 : count_ - 1;
    turned_.push_back(caster);
}

// Whether those that there are would be chosen again; says which are others.
bool LightUmbras::keeps_candidates(const UmbraTerms& terms) {
    if (terms.all || lost_) return false;
    struct Rank {
        double score = 0.0;
        std::uint64_t key = std::numeric_limits<std::uint64_t>::max();
        std::uint32_t part = std::numeric_limits<std::uint32_t>::max();
    } least;
    if (candidates_.size() == most) {
        const Candidate& last = candidates_.back();
        least = {last.score, last.key, last.part};
    }
    for (const std::uint32_t c : terms.changed) {
        const CasterState& caster = terms.casters[c];
        const bool may = may_hide_others(caster) && !is_out_of_range(caster, terms.light);
        const bool is_one =
            std::ranges::find(candidates_, c, &Candidate::caster) != candidates_.end();
        if (!is_one && (!may || most_score_of(caster, terms.light) < least.score)) continue;
        const std::vector<ConvexPart>* parts = may ? &convex_parts(*caster.mesh) : nullptr;
        for (Candidate& candidate : candidates_) {
            if (candidate.caster != c) continue;
            if (!may || candidate.part >= parts->size()) return false;
            candidate.anew = true;
            candidate.made = false;
        }
        for (std::uint32_t p = 0; may && p < parts->size(); ++p) {
            const double score = score_of(caster, (*parts)[p], terms.light);
            const bool beats = score != least.score      ? score > least.score
                               : caster.key != least.key ? caster.key < least.key
                                                         : p < least.part;
            const bool is_candidate = std::ranges::any_of(candidates_, [&](const auto& candidate) {
                return candidate.caster == c && candidate.part == p;
            });
            const bool may_stay =
                beats || (caster.key == least.key && p == least.part && score >= least.score);
            if (is_candidate ? !may_stay : beats && score > 0.0) return false;
        }
    }
    return true;
}

void LightUmbras::choose(const UmbraTerms& terms) {
    before_.swap(candidates_);
    candidates_.clear();
    const auto is_worse = [](const Candidate& a, double score) { return !(a.score >= score); };
    for (const std::uint32_t c : terms.casters.by_key()) {
        const CasterState& caster = terms.casters[c];
        if (!may_hide_others(caster) || is_out_of_range(caster, terms.light)) continue;
        if (candidates_.size() == most &&
            !is_worse(candidates_.back(), most_score_of(caster, terms.light))) {
            continue;
        }
        const std::vector<ConvexPart>& parts = convex_parts(*caster.mesh);
        for (std::uint32_t p = 0; p < parts.size(); ++p) {
            const double score = score_of(caster, parts[p], terms.light);
            if (!(score > 0.0)) continue;
            if (candidates_.size() == most) {
                if (!is_worse(candidates_.back(), score)) continue;
                candidates_.pop_back();
            }
            auto at = candidates_.end();
            while (at != candidates_.begin() && is_worse(*(at - 1), score)) --at;
            candidates_.insert(at, {.score = score, .key = caster.key, .caster = c, .part = p});
        }
    }
    moved_to_.assign(before_.size() + 1, 0);
    for (std::size_t i = 0; i < before_.size(); ++i) {
        Candidate& old = before_[i];
        for (std::size_t k = 0; k < candidates_.size(); ++k) {
            Candidate& now = candidates_[k];
            if (now.caster != old.caster || now.part != old.part) continue;
            now.umbra = std::move(old.umbra);
            if (terms.all || terms.casters[now.caster].changed || now.key != old.key) continue;
            now.made = old.made;
            now.anew = false;
            moved_to_[i + 1] = static_cast<std::uint8_t>(k + 1);
        }
    }
    before_.clear();
}

void LightUmbras::surround(const UmbraTerms& terms) {
    if (surrounds_ == nullptr) surrounds_ = std::make_unique<Surrounds>();
    Surrounds& all = *surrounds_;
    const glm::dvec3 light(terms.light.position_world);
    const bool directional = terms.light.position_world.w == 0.0;
    all.first.fill(std::numeric_limits<float>::infinity());  // nothing is in those that are not
    if (candidates_.empty()) return;
    all.base = directional ? terms.casters[candidates_[0].caster].center : light;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        const CasterState& caster = terms.casters[candidates_[i].caster];
        const double radius2 = 1.001 * caster.radius * caster.radius;
        const glm::dvec3 at = caster.center - all.base;
        const double distance2 = glm::dot(at, at);
        const bool in_or_about = !directional && !(distance2 > radius2);
        const glm::dvec3 axis = directional ? -glm::normalize(light) : at / std::sqrt(distance2);
        for (int k = 0; k < 3; ++k) {
            const auto row = static_cast<std::size_t>(k);
            all.tip[row][i] = directional ? static_cast<float>(at[k]) : 0.0F;
            all.axis[row][i] = in_or_about ? 0.0F : static_cast<float>(axis[k]);
        }
        all.first[i] =
            directional ? static_cast<float>(-std::sqrt(radius2)) : (in_or_about ? -1.0F : 0.0F);
        all.wide2[i] = directional   ? static_cast<float>(radius2)
                       : in_or_about ? std::numeric_limits<float>::infinity()
                                     : 0.0F;
        all.widens2[i] =
            directional || in_or_about ? 0.0F : static_cast<float>(radius2 / (distance2 - radius2));
    }
}

// Which surrounds a point is in; false where in none.
bool LightUmbras::mark(const glm::dvec3& point, Marks& marks) const {
    const Surrounds& all = *surrounds_;
    const glm::vec3 p(point - all.base);
    std::int32_t any = 0;
    for (std::size_t i = 0; i < most; ++i) {
        const float x = p.x - all.tip[0][i];
        const float y = p.y - all.tip[1][i];
        const float z = p.z - all.tip[2][i];
        const float along = x * all.axis[0][i] + y * all.axis[1][i] + z * all.axis[2][i];
        const float along2 = along * along;
        const float aside2 = x * x + y * y + z * z - along2;
        const std::int32_t is_behind = along > all.first[i] ? 1 : 0;
        const std::int32_t is_near = aside2 < all.wide2[i] + all.widens2[i] * along2 ? 1 : 0;
        marks[i] = is_behind & is_near;
        any |= marks[i];
    }
    return any != 0;
}

std::uint8_t LightUmbras::find(const UmbraTerms& terms, std::uint32_t slot, bool anew_alone) {
    const CasterState& caster = terms.casters[slot];
    Marks marks;
    if (!mark(caster.center, marks) || !caster.pose.finite || caster.pose.singular ||
        is_out_of_range(caster, terms.light)) {
        return 0;
    }
    bool is_boxed = false;
    UmbraBox box;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        if (marks[i] == 0) continue;
        Candidate& candidate = candidates_[i];
        if ((anew_alone && !candidate.anew) || candidate.caster == slot) continue;
        if (!candidate.made) {
            const CasterState& before = terms.casters[candidate.caster];
            candidate.umbra.make(convex_parts(*before.mesh)[candidate.part], before.pose,
                                 terms.light.position_world, terms.follow);
            candidate.made = true;
        }
        if (candidate.umbra.empty()) continue;
        if (!is_boxed) {
            box = umbra_box(caster.pose, glm::dvec3(caster.mesh->bounds_min()),
                            glm::dvec3(caster.mesh->bounds_max()), terms.light.position_world);
            is_boxed = true;
        }
        if (candidate.umbra.holds(box)) return static_cast<std::uint8_t>(i + 1);
    }
    return 0;
}

void LightUmbras::update(const UmbraTerms& terms) {
    turned_.clear();
    for (Candidate& candidate : candidates_) candidate.anew = false;
    bool any_lost = false;
    if (keeps_candidates(terms)) {
        moved_to_.resize(candidates_.size() + 1);
        for (std::size_t i = 0; i < candidates_.size(); ++i) {
            moved_to_[i + 1] =
                candidates_[i].anew ? std::uint8_t{0} : static_cast<std::uint8_t>(i + 1);
        }
    } else {
        any_lost = !candidates_.empty();
        choose(terms);
        lost_ = false;
    }
    if (candidates_.empty() && count_ == 0) return;
    behind_.resize(terms.casters.end());
    const bool any_anew = std::ranges::any_of(candidates_, &Candidate::anew);
    if (any_anew || any_lost) surround(terms);
    if (!terms.all && !any_anew && !any_lost) {
        for (const std::uint32_t c : terms.changed) set(c, find(terms, c, false));
        return;
    }
    for (const std::uint32_t c : terms.casters.by_key()) {
        const bool asked_anew = terms.all || terms.casters[c].changed;
        if (asked_anew) {
            set(c, find(terms, c, false));
        } else if (behind_[c] == 0) {
            if (any_anew) set(c, find(terms, c, true));
        } else {
            const std::uint8_t still = moved_to_[behind_[c]];
            set(c, still != 0 ? still : find(terms, c, false));
        }
    }
}

std::size_t LightUmbras::memory_bytes() const {
    std::size_t bytes = (candidates_.capacity() + before_.capacity()) * sizeof(Candidate) +
                        (surrounds_ != nullptr ? sizeof(Surrounds) : 0) + moved_to_.capacity() +
                        behind_.capacity() + turned_.capacity() * sizeof(std::uint32_t);
    for (const Candidate& candidate : candidates_) bytes += candidate.umbra.memory_bytes();
    return bytes;
}

}  // namespace internal

using internal::LightState;
using internal::PairFlag;
using internal::PairState;

// Pairs whose caster came into an umbra or out of all, and that nothing else makes work of.
void ShadowSystem::State::find_umbras(bool all) {
    if (!options.fill.cull_by_umbra) return;
    if (!all && !lights_changed && !came_or_went && changed_casters.empty()) return;
    const bool receivers_known = options.receivers == Receivers::Submitted;
    double follow = std::numeric_limits<double>::infinity();
    if (receivers_known) {
        follow = receiver_tree.empty()
                     ? 0.0
                     : glm::length(receiver_tree.bounds().high - receiver_tree.bounds().low);
    }
    const auto& order = lights.by_key();
    const auto update = [&](std::size_t i) {
        LightState& light = lights[order[i]];
        if (!internal::is_finite(light.light.position_world)) return;
        light.umbras.update({casters, changed_casters, light.light, all || light.changed, follow});
    };
    if (all || lights_changed) {
        run(order.size(), update);
    } else {
        for (std::size_t i = 0; i < order.size(); ++i) update(i);
    }
    for (const std::uint32_t l : order) {
        const LightState& light = lights[l];
        if (all || light.changed) continue;
        for (const std::uint32_t c : light.umbras.turned()) {
            const PairState& pair = light.pairs[c];
            const bool has_or_waits = pair.is(PairFlag::Known) || pair.reason == Reason::InUmbra;
            if (!casters[c].changed && has_or_waits) work.push_back({.light = l, .caster = c});
        }
    }
}

}  // namespace gnomon::shadows
