// SPDX-License-Identifier: MIT
//
// Masks held against pictures that were made by hand, one letter a pixel, so that every figure can
// be counted with a finger.
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "tests/truth/oracle_fixture.hpp"

namespace gnomon::truth {
namespace {

using testing::ElementsAre;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// '.' lit, '#' in shadow, ' ' unjudged. In the band: 'l' with a lit centre, 's' with one in
/// shadow, '?' undecided, 'u' with a centre that is unjudged.
Picture truth_of(const std::vector<std::string>& rows) {
    Picture picture{.width = static_cast<std::uint32_t>(rows.front().size()),
                    .height = static_cast<std::uint32_t>(rows.size()),
                    .verdicts = {}};
    for (const std::string& row : rows) {
        for (const char letter : row) {
            const std::string band = "ls?u";
            Verdict centre = Verdict::Unjudged;
            if (letter == '.' || letter == 'l') centre = Verdict::Lit;
            if (letter == '#' || letter == 's') centre = Verdict::Shadowed;
            if (letter == '?') centre = Verdict::Band;
            picture.centres.push_back(centre);
            picture.verdicts.push_back(band.find(letter) != std::string::npos ? Verdict::Band
                                                                              : centre);
        }
    }
    return picture;
}

std::vector<std::uint8_t> mask_of(const std::vector<std::string>& rows) {
    std::vector<std::uint8_t> mask;
    for (const std::string& row : rows) {
        for (const char letter : row) mask.push_back(letter == '#' ? 2 : 0);
    }
    return mask;
}

TEST(Judge, ARightMaskIsRight) {
    const Judgement j = judge(truth_of({"..ls##", ".. ?u#"}), mask_of({"...###", "..#..#"}));
    EXPECT_EQ(j.pixels, 12U);
    EXPECT_EQ(j.lit, 4U);
    EXPECT_EQ(j.shadowed, 3U);
    EXPECT_EQ(j.band, 4U);
    EXPECT_EQ(j.band_lit, 1U);
    EXPECT_EQ(j.band_shadowed, 1U);
    EXPECT_EQ(j.band_undecided, 1U);
    EXPECT_EQ(j.judged(), 7U);
    EXPECT_EQ(j.decided(), 9U);
    EXPECT_EQ(j.wrong(), 0U);
    EXPECT_EQ(j.wrong_at_all(), 0U);
    EXPECT_EQ(j.iou(), 1.0);
    EXPECT_EQ(j.iou_at_all(), 1.0);
    EXPECT_EQ(j.edge_displacement_px, 0.0);
}

TEST(Judge, FalseShadowAndFalseLightAreCountedApartInTheBandAndOutOfIt) {
    const Judgement j = judge(truth_of({"....####", "llllllss"}),  //
                              mask_of({"..#..###", "###....."}));
    EXPECT_EQ(j.false_shadow, 1U);
    EXPECT_EQ(j.false_light, 1U);
    EXPECT_EQ(j.band_false_shadow, 3U);
    EXPECT_EQ(j.band_false_light, 2U);
    EXPECT_EQ(j.wrong(), 2U);
    EXPECT_EQ(j.wrong_at_all(), 7U);
    EXPECT_THAT(j.wrong_pixels, ElementsAre(2, 4));
    EXPECT_DOUBLE_EQ(j.iou(), 3.0 / 5.0);          // 3 in both, 4 + 1 in either
    EXPECT_DOUBLE_EQ(j.iou_at_all(), 3.0 / 10.0);  // 3 in both, 6 + 4 in either
}

TEST(Judge, WithoutCentresTheBandIsUndecided) {
    Picture truth = truth_of({"..ls##"});
    truth.centres.clear();
    const Judgement j = judge(truth, mask_of({"######"}));
    EXPECT_EQ(j.band, 2U);
    EXPECT_EQ(j.band_undecided, 2U);
    EXPECT_EQ(j.wrong_at_all(), 2U);
}

TEST(Judge, IntersectionOverUnionAtItsEnds) {
    EXPECT_EQ(judge(truth_of({"...."}), mask_of({"...."})).iou(), 1.0);
    EXPECT_EQ(judge(truth_of({"...."}), mask_of({".#.."})).iou(), 0.0);
    EXPECT_EQ(judge(truth_of({"##.."}), mask_of({"..##"})).iou(), 0.0);
    EXPECT_EQ(judge(truth_of({"    "}), mask_of({"####"})).iou(), 1.0);
}

TEST(Judge, AnEdgeMovedByThreePixelsIsDisplacedByThree) {
    const Picture truth = truth_of({"....######", "....######", "....######"});
    const auto later = mask_of({".......###", ".......###", ".......###"});
    const auto earlier = mask_of({".#########", ".#########", ".#########"});
    EXPECT_EQ(judge(truth, later).edge_displacement_px, 3.0);
    EXPECT_EQ(judge(truth, earlier).edge_displacement_px, 3.0);
}

TEST(Judge, DisplacementIsEuclidean) {
    const Picture truth = truth_of({"......", "......", "......", "#....."});
    EXPECT_DOUBLE_EQ(
        judge(truth, mask_of({"....#.", "......", "......", "#....."})).edge_displacement_px,
        5.0);  // three up, four to the right
    EXPECT_DOUBLE_EQ(
        judge(truth, mask_of({"......", "......", ".#....", "#....."})).edge_displacement_px,
        std::sqrt(2.0));
}

TEST(Judge, TheBandTakesPartInDisplacement) {
    // Where the edge runs through the very centre, the mask may say either.
    EXPECT_EQ(judge(truth_of({".....?"}), mask_of({"..#..."})).edge_displacement_px, 3.0);
    EXPECT_EQ(judge(truth_of({"....s#"}), mask_of({"..#..."})).edge_displacement_px, 2.0);
    // A wrong pixel of the band displaces the edge, too; what is not judged neither does nor helps.
    EXPECT_EQ(judge(truth_of({"..l###"}), mask_of({"..####"})).edge_displacement_px, 1.0);
    EXPECT_EQ(judge(truth_of({".  u##"}), mask_of({"######"})).edge_displacement_px, 4.0);
}

TEST(Judge, AShadowWhereThereIsNoneIsInfinitelyDisplaced) {
    EXPECT_EQ(judge(truth_of({"...", ". ."}), mask_of({".#.", "..."})).edge_displacement_px,
              infinite);
    EXPECT_EQ(judge(truth_of({"###"}), mask_of({"##."})).edge_displacement_px, infinite);
}

TEST(Judge, DisplacementIsThatOfBruteForce) {
    std::mt19937 random(7);  // NOLINT: the same pictures every time
    for (int round = 0; round < 200; ++round) {
        const auto width = static_cast<std::uint32_t>(1 + random() % 17);
        const auto height = static_cast<std::uint32_t>(1 + random() % 17);
        const auto sparse = 2 + random() % 40;  // of shadow, in truth
        std::vector<std::string> rows(height, std::string(width, '.'));
        for (std::string& row : rows) {
            for (char& letter : row) {
                if (random() % sparse == 0) letter = '#';
                if (random() % 11 == 0) letter = " ls?u"[random() % 5];
            }
        }
        const Picture truth = truth_of(rows);
        std::vector<std::uint8_t> mask(truth.verdicts.size());
        for (std::size_t i = 0; i < mask.size(); ++i) {
            const bool dark = truth.centres[i] == Verdict::Shadowed;
            mask[i] = dark != (random() % 9 == 0) ? 1 : 0;
        }
        double largest = 0.0;
        for (std::uint32_t i = 0; i < mask.size(); ++i) {
            const Verdict said = mask[i] != 0 ? Verdict::Shadowed : Verdict::Lit;
            const Verdict true_one = truth.centres[i];
            if (true_one == said || true_one < Verdict::Lit) continue;
            double nearest = infinite;
            for (std::uint32_t k = 0; k < mask.size(); ++k) {
                if (truth.centres[k] != said && truth.centres[k] != Verdict::Band) continue;
                nearest = std::min(nearest, std::hypot(double(i % width) - double(k % width),
                                                       double(i / width) - double(k / width)));
            }
            largest = std::max(largest, nearest);
        }
        const double found = judge(truth, mask).edge_displacement_px;
        if (largest == infinite) {
            EXPECT_EQ(found, infinite) << round;
        } else {
            EXPECT_NEAR(found, largest, 1e-12) << round;
        }
    }
}

TEST(Judge, JudgementsAddUp) {
    const Judgement a = judge(truth_of({"..ls##"}), mask_of({".#..##"}));
    const Judgement b = judge(truth_of({"?.....##"}), mask_of({"..#....#"}));
    Judgement total;
    total += a;
    total += b;
    EXPECT_EQ(total.pixels, 14U);
    EXPECT_EQ(total.lit, 7U);
    EXPECT_EQ(total.shadowed, 4U);
    EXPECT_EQ(total.band, 3U);
    EXPECT_EQ(total.band_lit, 1U);
    EXPECT_EQ(total.band_shadowed, 1U);
    EXPECT_EQ(total.band_undecided, 1U);
    EXPECT_EQ(total.false_shadow, 2U);
    EXPECT_EQ(total.false_light, 1U);
    EXPECT_EQ(total.band_false_light, 1U);
    EXPECT_EQ(total.band_false_shadow, 0U);
    EXPECT_EQ(a.edge_displacement_px, 2.0);
    EXPECT_EQ(total.edge_displacement_px, 2.0);  // of b: 2, to the undecided one
    EXPECT_THAT(total.wrong_pixels, ElementsAre(1, 2, 6));
    EXPECT_DOUBLE_EQ(total.iou(), 3.0 / 6.0);

    total += total;
    EXPECT_EQ(total.wrong_pixels.size(), 6U);
    for (int i = 0; i < 10; ++i) total += total;
    EXPECT_EQ(total.wrong_pixels.size(), 1000U);
    EXPECT_EQ(total.lit, 14U * 1024U);
}

}  // namespace
}  // namespace gnomon::truth
