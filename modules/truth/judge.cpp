// SPDX-License-Identifier: MIT
#include <gnomon/core/expects.hpp>
#include <gnomon/truth/truth.hpp>

namespace gnomon::truth {

Judgement judge(const Picture& truth, std::span<const std::uint8_t> mask) {
    GNOMON_EXPECTS(mask.size() == truth.verdicts.size());
    constexpr std::size_t most_listed = 1000;
    Judgement judgement;
    judgement.pixels = truth.verdicts.size();
    for (std::size_t i = 0; i < truth.verdicts.size(); ++i) {
        const bool dark = mask[i] != 0;
        bool wrong = false;
        switch (truth.verdicts[i]) {
            case Verdict::Unjudged: break;
            case Verdict::Band: ++judgement.band; break;
            case Verdict::Lit:
                ++judgement.lit;
                judgement.false_shadow += dark ? 1U : 0U;
                wrong = dark;
                break;
            case Verdict::Shadowed:
                ++judgement.shadowed;
                judgement.false_light += dark ? 0U : 1U;
                wrong = !dark;
                break;
        }
        if (wrong && judgement.wrong_pixels.size() < most_listed) {
            judgement.wrong_pixels.push_back(static_cast<std::uint32_t>(i));
        }
    }
    return judgement;
}

}  // namespace gnomon::truth
