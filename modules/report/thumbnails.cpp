// SPDX-License-Identifier: MIT
#include "internal/thumbnails.hpp"

#include <algorithm>
#include <array>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace gnomon::report::internal {

namespace {

using truth::Verdict;
using Color = std::array<std::uint8_t, 3>;

constexpr Color nothing{200, 204, 210};
constexpr Color lit{250, 240, 214};
constexpr Color half_lit{178, 164, 140};
constexpr Color dark{70, 66, 78};
constexpr Color false_shadow{214, 40, 40};
constexpr Color false_light{20, 92, 230};
constexpr Color band_false_shadow{240, 176, 160};
constexpr Color band_false_light{160, 190, 245};

/// A place's colour, and how much it matters where several fall onto one.
struct Mark {
    Color color;
    int weight = 0;
};

template <class MarkAt>
Thumbnail shrink(std::uint32_t width, std::uint32_t height, MarkAt&& mark_at) {
    const std::uint32_t step = std::max(1U, (width + thumbnail_width - 1) / thumbnail_width);
    Thumbnail out;
    out.width = (width + step - 1) / step;
    out.height = (height + step - 1) / step;
    std::vector<std::uint8_t> rgb;
    rgb.reserve(std::size_t{3} * out.width * out.height);
    for (std::uint32_t y = 0; y < out.height; ++y) {
        for (std::uint32_t x = 0; x < out.width; ++x) {
            Mark heaviest;
            bool first = true;
            std::array<unsigned, 3> sum{};
            unsigned count = 0;
            for (std::uint32_t sy = y * step; sy < std::min((y + 1) * step, height); ++sy) {
                for (std::uint32_t sx = x * step; sx < std::min((x + 1) * step, width); ++sx) {
                    const Mark mark = mark_at(std::size_t{sy} * width + sx);
                    if (first || mark.weight > heaviest.weight) heaviest = mark;
                    first = false;
                    for (std::size_t k = 0; k < 3; ++k) sum[k] += mark.color[k];
                    ++count;
                }
            }
            for (std::size_t k = 0; k < 3; ++k) {
                rgb.push_back(heaviest.weight > 0 ? heaviest.color[k]
                                                  : static_cast<std::uint8_t>(sum[k] / count));
            }
        }
    }
    const auto append = [](void* context, void* data, int size) {
        auto& png = *static_cast<std::vector<std::byte>*>(context);
        const auto* bytes = static_cast<const std::byte*>(data);
        png.insert(png.end(), bytes, bytes + size);
    };
    stbi_write_png_to_func(append, &out.png, static_cast<int>(out.width),
                           static_cast<int>(out.height), 3, rgb.data(),
                           static_cast<int>(out.width) * 3);
    return out;
}

Verdict centre_of(const truth::Picture& picture, std::size_t at) {
    const Verdict verdict = picture.verdicts[at];
    return verdict == Verdict::Band && !picture.centres.empty() ? picture.centres[at] : verdict;
}

// From how many of the lights that are judged there a place is in shadow.
Color shade(std::size_t judged, std::size_t shadowed) {
    if (judged == 0) return nothing;
    if (shadowed == 0) return lit;
    return shadowed == judged ? dark : half_lit;
}

}  // namespace

Thumbnail mask_thumbnail(const std::vector<truth::Picture>& truth, const Masks& masks) {
    if (truth.empty()) return {};
    return shrink(truth[0].width, truth[0].height, [&](std::size_t at) {
        std::size_t judged = 0;
        std::size_t shadowed = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            if (truth[i].verdicts[at] == Verdict::Unjudged) continue;
            ++judged;
            if (masks[i][at] != 0) ++shadowed;
        }
        return Mark{shade(judged, shadowed), 0};
    });
}

Thumbnail truth_thumbnail(const std::vector<truth::Picture>& truth) {
    if (truth.empty()) return {};
    return shrink(truth[0].width, truth[0].height, [&](std::size_t at) {
        std::size_t judged = 0;
        std::size_t shadowed = 0;
        for (const truth::Picture& picture : truth) {
            const Verdict verdict = centre_of(picture, at);
            if (verdict == Verdict::Unjudged || verdict == Verdict::Band) continue;
            ++judged;
            if (verdict == Verdict::Shadowed) ++shadowed;
        }
        return Mark{shade(judged, shadowed), 0};
    });
}

Thumbnail difference_thumbnail(const std::vector<truth::Picture>& truth, const Masks& masks) {
    if (truth.empty()) return {};
    return shrink(truth[0].width, truth[0].height, [&](std::size_t at) {
        Mark mark{nothing, 0};
        std::size_t judged = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const Verdict verdict = truth[i].verdicts[at];
            if (verdict == Verdict::Unjudged) continue;
            ++judged;
            const bool in_band = verdict == Verdict::Band;
            const Verdict centre = centre_of(truth[i], at);
            const bool is_dark = masks[i][at] != 0;
            const bool wrong =
                (centre == Verdict::Lit && is_dark) || (centre == Verdict::Shadowed && !is_dark);
            const int weight = in_band ? 1 : 2;
            if (!wrong || mark.weight >= weight) continue;
            if (is_dark) {
                mark = {in_band ? band_false_shadow : false_shadow, weight};
            } else {
                mark = {in_band ? band_false_light : false_light, weight};
            }
        }
        if (mark.weight == 0 && judged > 0) mark.color = {238, 238, 236};
        return mark;
    });
}

}  // namespace gnomon::report::internal
