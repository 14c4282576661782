// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/sun/position.hpp>
#include <gnomon/sun_study/plan_scan.hpp>

#include "tests/sun_study/site.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::sun_study {
namespace {

using gnomon::test::must;

constexpr double degree = std::numbers::pi / 180.0;

PlanMask scanned(const std::vector<shadows::Caster>& casters, const PlanGrid& grid,
                 const glm::dvec3& sun) {
    return PlanScan(casters, grid).lit(std::span(&sun, 1)).front();
}

// The area that an upright box's shadow covers: the box's foot, swept by the shadow of its top.
bool is_in_the_shadow_of_a_box(const glm::dvec2& at, const glm::dvec2& half, const glm::dvec2& tip,
                               double slack) {
    double begin = 0.0;
    double end = 1.0;
    for (int i = 0; i < 2; ++i) {
        const double a = (at[i] - half[i] - slack) / tip[i];
        const double b = (at[i] + half[i] + slack) / tip[i];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return begin <= end;
}

TEST(PlanScan, CastsABoxExactly) {
    const PlanGrid grid = must(make_grid({-20.0, -15.0}, {20.0, 15.0}, 0.25, 0.0, 4096));
    const glm::dvec2 half(2.0, 3.0);
    const std::vector<shadows::Caster> box{
        test::caster_of(1, scene::make_box({4.0F, 5.0F, 6.0F}), {0.0, 0.0, 2.5})};
    for (const double azimuth : {100.0, 135.5, 181.0, 263.0}) {
        for (const double altitude : {12.0, 33.0, 71.0}) {
            const glm::dvec3 sun = sun::towards_sun(azimuth * degree, altitude * degree);
            const glm::dvec2 tip = glm::dvec2(sun) * (-5.0 / sun.z);
            const PlanMask mask = scanned(box, grid, sun);
            std::ptrdiff_t dark = 0;
            for (std::size_t i = 0; i < mask.size(); ++i) {
                const glm::dvec2 at = grid.center_m(static_cast<std::uint32_t>(i % grid.columns),
                                                    static_cast<std::uint32_t>(i / grid.columns));
                const bool inside = is_in_the_shadow_of_a_box(at, half, tip, -1e-6);
                const bool about = is_in_the_shadow_of_a_box(at, half, tip, 1e-6);
                if (inside == about) {
                    ASSERT_EQ(mask[i], inside ? 0 : 1)
                        << at.x << ", " << at.y << " at " << azimuth << ", " << altitude;
                }
                dark += inside ? 1 : 0;
            }
            EXPECT_GT(dark, 300);
        }
    }
}

TEST(PlanScan, OfTheZenithAreTheCellsUnderSomething) {
    const PlanGrid grid = must(make_grid({-10.0, -10.0}, {10.0, 10.0}, 1.0, 0.125, 4096));
    const PlanMask open =
        scanned({test::caster_of(1, scene::make_box({4.0F, 5.0F, 6.0F}), {0.0, 0.0, 2.5})}, grid,
                {0.0, 0.0, 1.0});
    EXPECT_EQ(std::count(open.begin(), open.end(), 0), 4 * 6);
    EXPECT_EQ(open[std::size_t{7} * 20 + 8], 0);
    EXPECT_EQ(open[std::size_t{6} * 20 + 8], 1);
}

// Every inner edge of the sheet runs through centres of cells.
TEST(PlanScan, LeavesNoCrackWhereEdgesRunThroughCentres) {
    scene::Mesh sheet;
    constexpr std::uint32_t side = 12;
    for (std::uint32_t j = 0; j <= side; ++j) {
        for (std::uint32_t i = 0; i <= side; ++i) {
            sheet.positions.emplace_back(glm::dvec3(i - 6.0, 0.0, j - 6.0));
        }
    }
    for (std::uint32_t j = 0; j < side; ++j) {
        for (std::uint32_t i = 0; i < side; ++i) {
            const std::uint32_t a = j * (side + 1) + i;
            for (const std::uint32_t k :
                 {a, a + side + 1, a + 1, a + 1, a + side + 1, a + side + 2}) {
                sheet.indices.push_back(k);
            }
        }
    }
    const PlanGrid grid = must(make_grid({-10.5, -10.5}, {10.5, 10.5}, 1.0, 0.0, 4096));
    for (const glm::dvec3& sun : {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.6, 0.0, 0.8),
                                  glm::dvec3(-1.0, 2.0, 1.0), glm::dvec3(0.3, 0.3, 0.9)}) {
        for (const double height : {1.0, 2.0}) {
            const glm::dvec2 middle = glm::dvec2(sun) * (-height / sun.z);
            const PlanMask mask =
                scanned({test::caster_of(1, sheet, {0.0, 0.0, height})}, grid, sun);
            for (std::size_t i = 0; i < mask.size(); ++i) {
                const glm::dvec2 to =
                    glm::abs(grid.center_m(static_cast<std::uint32_t>(i % grid.columns),
                                           static_cast<std::uint32_t>(i / grid.columns)) -
                             middle);
                const double farthest = std::max(to.x, to.y);
                if (std::abs(farthest - 6.0) < 1e-6) continue;
                EXPECT_EQ(mask[i], farthest > 6.0 ? 1 : 0) << i;
            }
        }
    }
}

// Which faces cast is a matter of closedness, sides and poses, and changes nothing that is seen.
TEST(PlanScan, CastsTheSameInsideOutMirroredOrWithBothSides) {
    const PlanGrid grid = test::site_grid();
    const glm::dvec3 sun = sun::towards_sun(143.0 * degree, 27.0 * degree);
    const auto with = [&](auto&& change) {
        scene::Mesh torus = scene::make_torus(4.0F, 1.5F, 24, 12);
        change(torus);
        return test::caster_of(1, torus, {0.3, 0.2, 4.1});
    };
    const PlanMask plain = scanned({with([](scene::Mesh&) {})}, grid, sun);
    EXPECT_GT(std::count(plain.begin(), plain.end(), 0), 300);
    const auto turn = [](scene::Mesh& mesh) {
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            std::swap(mesh.indices[i], mesh.indices[i + 1]);
        }
    };
    EXPECT_EQ(scanned({with(turn)}, grid, sun), plain);
    const auto open = [](scene::Mesh& mesh) {
        for (int i = 0; i < 3; ++i)
            mesh.indices.push_back(mesh.indices[static_cast<std::size_t>(i)]);
    };
    EXPECT_EQ(scanned({with(open)}, grid, sun), plain);
    // Mirrored twice: in the mesh and in its pose.
    shadows::Caster mirrored = with([](scene::Mesh& mesh) {
        for (glm::vec3& at : mesh.positions) at.x = -at.x;
    });
    mirrored.world_from_local[0] *= -1.0;
    EXPECT_EQ(scanned({mirrored}, grid, sun), plain);
}

// A house that stands in the ground casts what is above it, and the ground under it is in shadow.
TEST(PlanScan, CutsOffWhatIsBelowThePlane) {
    const PlanGrid grid = must(make_grid({-16.0, -13.0}, {16.0, 13.0}, 0.25, 0.05, 4096));
    const glm::dvec3 sun = sun::towards_sun(201.0 * degree, 31.0 * degree);
    const scene::Mesh low = test::house(9.0, 7.0, 5.0, 8.0);
    scene::Mesh deep = low;
    for (std::size_t i = 0; i < 4; ++i) deep.positions[i].y -= 30.0F;  // its floor
    const PlanMask mask = scanned({test::caster_of(1, low, glm::dvec3(0.0))}, grid, sun);
    EXPECT_EQ(scanned({test::caster_of(1, deep, glm::dvec3(0.0))}, grid, sun), mask);
    EXPECT_GT(std::count(mask.begin(), mask.end(), 0), 1000);
    const PlanMask none = scanned({test::caster_of(1, low, {0.0, 0.0, -8.0})}, grid, sun);
    EXPECT_EQ(std::count(none.begin(), none.end(), 0), 0);
}

// Shadows of hundreds of kilometres: what is on the grid is right, and takes no longer.
TEST(PlanScan, TakesASunOnTheHorizon) {
    const PlanGrid grid = must(make_grid({-100.0, -20.0}, {0.0, 20.0}, 0.5, 0.0, 4096));
    const std::vector<shadows::Caster> box{
        test::caster_of(1, scene::make_box({2.0F, 30.0F, 6.0F}), {4.0, 0.0, 15.0})};
    for (const double altitude : {1e-3, 1e-7}) {
        const PlanMask mask =
            scanned(box, grid, sun::towards_sun(90.0 * degree, altitude * degree));
        for (std::uint32_t row = 0; row < grid.rows; ++row) {
            const bool dark = std::abs(grid.center_m(0, row).y) < 3.0;
            const auto begin = mask.begin() + std::ptrdiff_t{row} * grid.columns;
            EXPECT_EQ(std::count(begin, begin + grid.columns, 0), dark ? grid.columns : 0) << row;
        }
        // A level sheet that is hardly above the plane keeps its size, 60 m away.
        const glm::dvec3 sun = sun::towards_sun(90.0 * degree, altitude * degree);
        const PlanMask level =
            scanned({test::caster_of(1, scene::make_plane(2.0F, 6.0F), {0.0, 0.0, 60.0 * sun.z})},
                    grid, sun);
        EXPECT_EQ(std::ranges::count(level, 0), 4 * 12);
        EXPECT_EQ(level[std::size_t{grid.rows / 2} * grid.columns + 80], 0);
    }
}

// Whether a ray meets a triangle: 1 for certain, 0 for certain not, -1 too near its edge to say.
int meets(const glm::dvec3& from, const glm::dvec3& towards, const std::array<glm::dvec3, 3>& at) {
    const glm::dvec3 ab = at[1] - at[0];
    const glm::dvec3 ac = at[2] - at[0];
    const glm::dvec3 p = glm::cross(towards, ac);
    const double det = glm::dot(ab, p);
    if (std::abs(det) < 1e-7 * glm::length(ab) * glm::length(ac)) return -1;
    const glm::dvec3 to = from - at[0];
    const double b = glm::dot(to, p) / det;
    const glm::dvec3 q = glm::cross(to, ab);
    const double c = glm::dot(towards, q) / det;
    const double inside = std::min({b, c, 1.0 - b - c});
    const double ahead = glm::dot(ac, q) / det;
    if (inside < -1e-6 || ahead < -1e-6) return 0;
    return inside > 1e-6 && ahead > 1e-6 ? 1 : -1;
}

// By rays through all triangles; 2 where that does not say.
PlanMask traced(const std::vector<shadows::Caster>& casters, const PlanGrid& grid,
                const glm::dvec3& sun) {
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (const shadows::Caster& caster : casters) {
        for (const auto& face : caster.mesh->faces()) {
            auto& triangle = triangles.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec4 local(glm::dvec3(caster.mesh->positions()[face[k]]), 1.0);
                triangle[k] = plan_from_world(glm::dvec3(caster.world_from_local * local));
            }
        }
    }
    PlanMask mask(grid.cell_count());
    for (std::uint32_t i = 0; i < mask.size(); ++i) {
        const glm::dvec3 from(grid.center_m(i % grid.columns, i / grid.columns), grid.height_m);
        bool is_open = true;
        bool is_certain = true;
        for (std::size_t t = 0; t < triangles.size() && is_open; ++t) {
            const int met = meets(from, sun, triangles[t]);
            is_open = met != 1;
            is_certain = is_certain && met != -1;
        }
        mask[i] = !is_open ? 0 : is_certain ? 1 : 2;
    }
    return mask;
}

// Two boxes with an edge in common, so that they are one component, of which the smaller is inside
// out: where the plane cuts it, rays begin in it and leave by a face that is turned away.
TEST(PlanScan, CastsAllOfAClosedMeshThatThePlaneCuts) {
    scene::Mesh mesh = scene::make_box({6.0F, 8.0F, 6.0F});
    const scene::Mesh small = scene::make_box({4.0F, 8.0F, 4.0F});
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& at : small.positions) {
        mesh.positions.push_back(at + glm::vec3(5.0F, 0.0F, 5.0F));
    }
    for (std::size_t i = 0; i < small.indices.size(); i += 3) {
        for (const std::size_t k : {0U, 2U, 1U}) {
            mesh.indices.push_back(first + small.indices[i + k]);
        }
    }
    const PlanGrid grid = must(make_grid({-12.0, -12.0}, {12.0, 12.0}, 0.5, 0.0, 4096));
    for (const double height : {0.3, 4.2}) {  // of the middle: cut, and above
        const std::vector<shadows::Caster> boxes{test::caster_of(1, mesh, {0.0, 0.0, height})};
        ASSERT_EQ(boxes.front().mesh->components().size(), 1U);
        ASSERT_TRUE(boxes.front().mesh->components().front().closed);
        ASSERT_FALSE(boxes.front().mesh->components().front().inside_out);
        for (const glm::dvec3& sun :
             {sun::towards_sun(141.0 * degree, 64.0 * degree), glm::dvec3(0.0, 0.0, 1.0)}) {
            const PlanMask mask = scanned(boxes, grid, sun);
            const PlanMask truth = traced(boxes, grid, sun);
            EXPECT_GT(std::ranges::count(truth, 0), 150);
            for (std::size_t i = 0; i < mask.size(); ++i) {
                if (truth[i] == 2) continue;
                ASSERT_EQ(mask[i], truth[i]) << "cell " << i;
            }
        }
    }
}

shadows::Caster random_caster(std::mt19937& random) {
    const auto between = [&](double least, double most) {
        return std::uniform_real_distribution<double>(least, most)(random);
    };
    // Whole and half metres often, so that edges run through centres and along rows.
    const auto place = [&](double least, double most) {
        const double at = between(least, most);
        return random() % 2 == 0 ? std::round(at * 2.0) / 2.0 : at;
    };
    const int kind = static_cast<int>(random() % 3);
    scene::Mesh mesh;
    if (kind == 0) {
        mesh = scene::make_box(glm::dvec3(place(1, 6), place(1, 8), place(1, 6)));
    } else if (kind == 1) {
        mesh = scene::make_torus(static_cast<float>(between(1, 4)), 0.7F, 12, 6);
    } else {
        for (std::uint32_t i = 0; i < 18; ++i) {
            mesh.positions.emplace_back(glm::dvec3(place(-4, 4), place(-3, 5), place(-4, 4)));
            mesh.indices.push_back(i);
        }
    }
    shadows::Caster caster = test::caster_of(1, mesh, {place(-8, 8), place(-8, 8), place(-1, 6)});
    if (random() % 2 == 0) {
        const double turn = between(0, 6);
        caster.world_from_local =
            glm::rotate(caster.world_from_local, turn,
                        random() % 2 == 0 ? glm::dvec3(0, 1, 0)
                                          : glm::normalize(glm::dvec3(1, between(-1, 1), 0.3)));
    }
    if (random() % 4 == 0) caster.world_from_local[2] *= -1.0;
    return caster;
}

TEST(PlanScan, AgreesWithRaysThroughRandomScenes) {
    constexpr unsigned first_seed = 20260321;
    const PlanGrid grid = must(make_grid({-12.0, -10.0}, {12.0, 10.0}, 0.5, 0.25, 4096));
    std::size_t undecided = 0;
    std::size_t dark = 0;
    for (unsigned seed = first_seed; seed < first_seed + 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937 random(seed);
        std::vector<shadows::Caster> casters;
        for (unsigned i = 0; i <= seed % 4; ++i) casters.push_back(random_caster(random));
        const double azimuth = std::uniform_real_distribution<double>(0.0, 360.0)(random);
        const double altitude = std::uniform_real_distribution<double>(3.0, 90.0)(random);
        const glm::dvec3 sun = seed % 5 == 0
                                   ? glm::dvec3(0.0, 0.0, 1.0)
                                   : sun::towards_sun(azimuth * degree, altitude * degree);
        const PlanMask mask = scanned(casters, grid, sun);
        const PlanMask truth = traced(casters, grid, sun);
        for (std::size_t i = 0; i < mask.size(); ++i) {
            undecided += truth[i] == 2 ? 1 : 0;
            dark += truth[i] == 0 ? 1 : 0;
            if (truth[i] == 2) continue;
            ASSERT_EQ(mask[i], truth[i]) << "cell " << i;
        }
    }
    EXPECT_GT(dark, 60U * 100U);
    EXPECT_LT(undecided, 60U * grid.cell_count() / 5);
}

// Houses wall to wall, the walls through centres of rows and of columns: no light between them,
// wherever rounding puts each.
TEST(PlanScan, LeavesNoCrackBetweenHousesThatTouch) {
    const scene::Mesh house = scene::make_box({2.0F, 6.0F, 2.0F});
    for (const glm::dvec3& shift :
         {glm::dvec3(0.0), glm::dvec3(533987.7, 5350123.3, 255.4), glm::dvec3(0.1, 0.7, 0.3)}) {
        std::vector<shadows::Caster> row;
        for (std::uint64_t i = 0; i < 16; ++i) {
            const auto x = static_cast<double>(i % 4);
            const auto y = static_cast<double>(i / 4);
            row.push_back(
                test::caster_of(i, house, shift + glm::dvec3(2.0 * x - 3.0, 2.0 * y - 3.0, 3.0)));
        }
        const PlanGrid grid = must(
            make_grid(glm::dvec2(shift) - 8.5, glm::dvec2(shift) + 8.5, 1.0, shift.z + 0.5, 4096));
        for (const glm::dvec3& sun : {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.3, 0.0, 1.0),
                                      glm::dvec3(0.0, -0.3, 1.0), glm::dvec3(0.2, 0.3, 1.0)}) {
            const PlanMask mask = scanned(row, grid, sun);
            for (std::uint32_t i = 0; i < mask.size(); ++i) {
                const glm::dvec2 at =
                    glm::abs(grid.center_m(i % grid.columns, i / grid.columns) - glm::dvec2(shift));
                if (std::max(at.x, at.y) > 3.5) continue;
                EXPECT_EQ(mask[i], 0) << i;
            }
        }
    }
}

// What is summed up at a time is less than this grid; its pieces are whole grids' masks.
TEST(PlanScan, IsTheSameInOnePieceOrMany) {
    const glm::dvec3 sun = sun::towards_sun(143.0 * degree, 27.0 * degree);
    const PlanGrid whole = must(make_grid({-16.0, -16.0}, {16.0, 16.0}, 1.0 / 64.0, 0.05, 4096));
    ASSERT_GT(whole.cell_count(), std::size_t{1} << 21U);
    const PlanMask mask = scanned(test::site(), whole, sun);
    for (const double y : {-16.0, -8.0, 0.0, 8.0}) {
        const PlanGrid piece = must(make_grid({-16.0, y}, {16.0, y + 8.0}, 1.0 / 64.0, 0.05, 4096));
        const PlanMask part = scanned(test::site(), piece, sun);
        const auto first_row = static_cast<std::ptrdiff_t>((8.0 - y) * 64.0);
        EXPECT_TRUE(std::equal(part.begin(), part.end(), mask.begin() + first_row * whole.columns))
            << y;
    }
    EXPECT_GT(std::count(mask.begin(), mask.end(), 0), 100'000);
}

TEST(PlanScan, IsTheSameOnAnyThreads) {
    const PlanGrid grid = must(make_grid({-15.0, -13.0}, {15.0, 13.0}, 0.23, 0.05, 4096));
    std::vector<glm::dvec3> suns;
    for (int i = 0; i < 9; ++i) {
        suns.push_back(sun::towards_sun((100.0 + 17.0 * i) * degree, (10.0 + 4.0 * i) * degree));
    }
    PlanScan threaded(test::site(), grid, shadows::thread_jobs(4));
    const std::vector<PlanMask> masks = threaded.lit(suns);
    ASSERT_EQ(masks.size(), suns.size());
    for (std::size_t i = 0; i < suns.size(); ++i) {
        EXPECT_EQ(masks[i], scanned(test::site(), grid, suns[i])) << i;
    }
    EXPECT_TRUE(threaded.lit({}).empty());
}

}  // namespace
}  // namespace gnomon::sun_study
