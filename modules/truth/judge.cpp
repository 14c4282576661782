// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include <gnomon/core/expects.hpp>
#include <gnomon/truth/truth.hpp>

#include "internal/distance_transform.hpp"

namespace gnomon::truth {

namespace {

constexpr std::size_t most_listed = 1000;

/// What is true of each pixel's centre.
std::vector<Verdict> centres_of(const Picture& truth) {
    std::vector<Verdict> centres = truth.verdicts;
    for (std::size_t i = 0; i < truth.centres.size(); ++i) {
        if (centres[i] == Verdict::Band) centres[i] = truth.centres[i];
    }
    return centres;
}

bool is_wrong(Verdict centre, bool dark) {
    return (centre == Verdict::Lit && dark) || (centre == Verdict::Shadowed && !dark);
}

double edge_displacement_px(const Picture& truth, std::span<const Verdict> centres,
                            std::span<const std::uint8_t> mask) {
    double largest = 0.0;
    for (const bool dark : {false, true}) {
        std::vector<std::size_t> wrong;
        for (std::size_t i = 0; i < mask.size(); ++i) {
            if ((mask[i] != 0) == dark && is_wrong(centres[i], dark)) wrong.push_back(i);
        }
        if (wrong.empty()) continue;
        std::vector<std::uint8_t> agreeing(mask.size());
        for (std::size_t i = 0; i < mask.size(); ++i) {
            const bool agrees = centres[i] == (dark ? Verdict::Shadowed : Verdict::Lit) ||
                                centres[i] == Verdict::Band;
            agreeing[i] = agrees ? 1 : 0;
        }
        const std::vector<double> squared =
            internal::squared_distances(agreeing, truth.width, truth.height);
        for (const std::size_t i : wrong) largest = std::max(largest, squared[i]);
    }
    return std::sqrt(largest);
}

double ratio(std::uint64_t shadowed, std::uint64_t false_light, std::uint64_t false_shadow) {
    const std::uint64_t in_either = shadowed + false_shadow;
    return in_either == 0
               ? 1.0
               : static_cast<double>(shadowed - false_light) / static_cast<double>(in_either);
}

}  // namespace

double Judgement::iou() const { return ratio(shadowed, false_light, false_shadow); }

double Judgement::iou_at_all() const {
    return ratio(shadowed + band_shadowed, false_light + band_false_light,
                 false_shadow + band_false_shadow);
}

Judgement& Judgement::operator+=(const Judgement& other) {
    pixels += other.pixels;
    lit += other.lit;
    shadowed += other.shadowed;
    band += other.band;
    false_shadow += other.false_shadow;
    false_light += other.false_light;
    band_lit += other.band_lit;
    band_shadowed += other.band_shadowed;
    band_undecided += other.band_undecided;
    band_false_shadow += other.band_false_shadow;
    band_false_light += other.band_false_light;
    edge_displacement_px = std::max(edge_displacement_px, other.edge_displacement_px);
    // Not insert(): `other` may be this one.
    const std::size_t listed = other.wrong_pixels.size();
    for (std::size_t i = 0; i < listed && wrong_pixels.size() < most_listed; ++i) {
        wrong_pixels.push_back(other.wrong_pixels[i]);
    }
    return *this;
}

Judgement judge(const Picture& truth, std::span<const std::uint8_t> mask) {
    GNOMON_EXPECTS(truth.verdicts.size() == std::size_t{truth.width} * truth.height);
    GNOMON_EXPECTS(mask.size() == truth.verdicts.size());
    GNOMON_EXPECTS(truth.centres.empty() || truth.centres.size() == truth.verdicts.size());
    const std::vector<Verdict> centres = centres_of(truth);
    Judgement judgement;
    judgement.pixels = truth.verdicts.size();
    for (std::size_t i = 0; i < truth.verdicts.size(); ++i) {
        const bool dark = mask[i] != 0;
        const std::uint64_t wrong = is_wrong(centres[i], dark) ? 1 : 0;
        switch (truth.verdicts[i]) {
            case Verdict::Unjudged: continue;
            case Verdict::Lit:
                ++judgement.lit;
                judgement.false_shadow += wrong;
                break;
            case Verdict::Shadowed:
                ++judgement.shadowed;
                judgement.false_light += wrong;
                break;
            case Verdict::Band:
                ++judgement.band;
                if (centres[i] == Verdict::Lit) {
                    ++judgement.band_lit;
                    judgement.band_false_shadow += wrong;
                } else if (centres[i] == Verdict::Shadowed) {
                    ++judgement.band_shadowed;
                    judgement.band_false_light += wrong;
                } else if (centres[i] == Verdict::Band) {
                    ++judgement.band_undecided;
                }
                continue;
        }
        if (wrong != 0 && judgement.wrong_pixels.size() < most_listed) {
            judgement.wrong_pixels.push_back(static_cast<std::uint32_t>(i));
        }
    }
    judgement.edge_displacement_px = edge_displacement_px(truth, centres, mask);
    return judgement;
}

}  // namespace gnomon::truth
