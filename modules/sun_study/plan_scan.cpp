// SPDX-License-Identifier: MIT
#include <gnomon/sun_study/plan_scan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <tuple>
#include <utility>

#include <gnomon/core/expects.hpp>

#include "internal/plan_triangles.hpp"

namespace gnomon::sun_study {

namespace {

// How far apart two borders count as one, in cells: far more than doubles round off in a grid, so
// that what touches leaves no crack, and far less than anybody measures.
constexpr double slack = 1e-9;
// Faces whose shadows are as thin as this, in cells, or as what a flattened vertex may be off by,
// are left out: rounding might turn them over.
constexpr double thinnest = 1e-8;
constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
// What is summed up at a time: rows of so many cells, that the sums stay near the processor.
constexpr std::size_t cells_at_a_time = std::size_t{1} << 20U;

// u in columns and v in rows: the centres of cells are at whole numbers. v runs down the plan.
struct Vertices {
    std::vector<double> u;
    std::vector<double> v;
    std::vector<double> height;  // in cells
};

// Twice a face's area on the plan, counter-clockwise positive, where the shadow of a point at
// height 1 falls at (x, y) from its foot: flat + x by_x + y by_y.
struct FaceAreas {
    std::vector<double> flat;
    std::vector<double> by_x;
    std::vector<double> by_y;
    // Its sides' shadows are no longer than across + rise |(x, y)|, in cells.
    std::vector<double> across;
    std::vector<double> rise;
    double top = 0.0;  // the highest corner of all

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        flat.push_back(normal.z);
        by_x.push_back(-normal.x);
        by_y.push_back(-normal.y);
        const glm::dvec2 flat_a(a);
        const glm::dvec2 flat_b(b);
        const glm::dvec2 flat_c(c);
        across.push_back(std::max({glm::distance(flat_a, flat_b), glm::distance(flat_b, flat_c),
                                   glm::distance(flat_c, flat_a)}));
        const auto [low, high] = std::minmax({a.z, b.z, c.z});
        rise.push_back(high - low);
        top = std::max(top, high);
    }
};

// An edge and two of the faces at it, each times two, and one more where it runs from high to low.
// Where there is one face alone, the other is none, which never casts.
struct ScanEdge {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::array<std::uint32_t, 2> uses{};
};

// A piece of a shadow's border, flattened, from the top down.
struct Border {
    double top_u = 0.0;  // and what brings a column's number from it
    double top_v = 0.0;
    double bottom_v = 0.0;
    double slope = 0.0;
    std::int32_t enters = 0;  // so many shadows begin to its right; below 0: end
};

std::vector<ScanEdge> edges_of(std::span<const std::array<std::uint32_t, 3>> faces) {
    struct Use {
        std::uint32_t low, high, use;
    };
    std::vector<Use> uses;
    uses.reserve(3 * faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = faces[f][k];
            const std::uint32_t to = faces[f][(k + 1) % 3];
            if (from == to) continue;
            uses.push_back({std::min(from, to), std::max(from, to),
                            static_cast<std::uint32_t>(2 * f + (from < to ? 0 : 1))});
        }
    }
    std::ranges::sort(uses, {},
                      [](const Use& use) { return std::tuple(use.low, use.high, use.use); });
    const auto none = static_cast<std::uint32_t>(2 * faces.size());
    std::vector<ScanEdge> edges;
    for (std::size_t i = 0; i < uses.size(); ++i) {
        ScanEdge edge{uses[i].low, uses[i].high, {uses[i].use, none}};
        if (i + 1 < uses.size() && uses[i + 1].low == edge.low && uses[i + 1].high == edge.high) {
            edge.uses[1] = uses[++i].use;
        }
        edges.push_back(edge);
    }
    return edges;
}

double snapped(double v) {
    // To 2^-30, in a grid: rows that borders run along have borders exactly on them, or none.
    constexpr double shift = 6291456.0;  // 1.5 * 2^22
    return (v + shift) - shift;
}

// The number at or above, within a grid's rows and one beyond.
std::int64_t row_at_or_above(double v, double rows) {
    return static_cast<std::int64_t>(std::ceil(std::clamp(v, 0.0, rows)));
}

// What one sun's scan works in.
struct Scratch {
    std::vector<std::int8_t> weights;  // by face, and of none
    std::vector<Border> borders;
    std::vector<std::int32_t> changes;  // by cell, and one beyond each row; all 0 between scans
};

}  // namespace

// The shadow of a component is the sum of its casting faces, flattened, each of which counts one
// where it lies; and the sum's border is the sum of theirs, in which most edges cancel. So only
// what is left is scanned: where it crosses a row, the number of shadows changes, and sums of the
// changes along a row say how many there are in each cell. (The same sums are what closes shadow
// volumes: docs/conventions.md, "A silhouette is a boundary".)
struct PlanScan::State {
    PlanGrid grid;
    shadows::Jobs jobs;
    Vertices vertices;
    FaceAreas areas;
    std::size_t one_sided = 0;
    std::vector<ScanEdge> edges;
    std::mutex mutex;  // of `scratches`
    std::vector<std::unique_ptr<Scratch>> scratches;

    std::unique_ptr<Scratch> take_scratch();
    void give_back(std::unique_ptr<Scratch> scratch);
    void weigh(const glm::dvec2& shift, std::vector<std::int8_t>& weights) const;
    void find_borders(const glm::dvec2& shift, Scratch& scratch) const;
    void add_changes(const Border& border, std::int64_t first_row, std::int64_t last_row,
                     std::int32_t* changes) const;
    [[nodiscard]] PlanMask scan(const glm::dvec3& towards_sun, Scratch& scratch) const;
};

std::unique_ptr<Scratch> PlanScan::State::take_scratch() {
    const std::lock_guard lock(mutex);
    if (scratches.empty()) return std::make_unique<Scratch>();
    auto scratch = std::move(scratches.back());
    scratches.pop_back();
    return scratch;
}

void PlanScan::State::give_back(std::unique_ptr<Scratch> scratch) {
    const std::lock_guard lock(mutex);
    scratches.push_back(std::move(scratch));
}

// 1 and -1: it casts, and is counter-clockwise, or clockwise, on the plan.
void PlanScan::State::weigh(const glm::dvec2& shift, std::vector<std::int8_t>& weights) const {
    const std::size_t count = areas.flat.size();
    weights.resize(count + 1);
    const double far = glm::length(shift);
    const double thin = thinnest + rounding * far * areas.top;
    const auto weigh_some = [&](std::size_t begin, std::size_t end, int clockwise) {
        for (std::size_t f = begin; f < end; ++f) {
            const double area = areas.flat[f] + shift.x * areas.by_x[f] + shift.y * areas.by_y[f];
            const double least = thin * (areas.across[f] + far * areas.rise[f]);
            const int weight = (area > least ? 1 : 0) - (area < -least ? clockwise : 0);
            weights[f] = static_cast<std::int8_t>(weight);
        }
    };
    weigh_some(0, one_sided, 0);
    weigh_some(one_sided, count, 1);
    weights[count] = 0;
}

void PlanScan::State::find_borders(const glm::dvec2& shift, Scratch& scratch) const {
    std::vector<Border>& borders = scratch.borders;
    borders.clear();
    const double beyond = grid.columns + 1.0;
    const auto weight = [&](std::uint32_t use) {
        const int w = scratch.weights[use / 2];
        return (use & 1U) != 0 ? -w : w;
    };
    for (const ScanEdge& edge : edges) {
        const int downwards = weight(edge.uses[0]) + weight(edge.uses[1]);
        if (downwards == 0) continue;
        const auto flattened = [&](std::uint32_t i) {
            return glm::dvec2(vertices.u[i] + vertices.height[i] * shift.x,
                              snapped(vertices.v[i] - vertices.height[i] * shift.y));
        };
        glm::dvec2 top = flattened(edge.low);
        glm::dvec2 bottom = flattened(edge.high);
        // What is to the right of all cells changes none.
        if (top.y == bottom.y || std::min(top.x, bottom.x) > beyond) continue;
        // Counter-clockwise about what casts: down its left side.
        int enters = downwards;
        if (bottom.y < top.y) {
            std::swap(top, bottom);
            enters = -enters;
        }
        // From the first column at or behind the border on, or from the first behind it.
        const double to_column = enters > 0 ? 1.0 - slack : 1.0 + slack;
        borders.push_back(
            {top.x + to_column, top.y, bottom.y, (bottom.x - top.x) / (bottom.y - top.y), enters});
    }
}

void PlanScan::State::add_changes(const Border& border, std::int64_t first_row,
                                  std::int64_t last_row, std::int32_t* changes) const {
    const std::int64_t begin = std::max(row_at_or_above(border.top_v, grid.rows), first_row);
    const std::int64_t end = std::min(row_at_or_above(border.bottom_v, grid.rows), last_row);
    const std::int64_t stride = std::int64_t{grid.columns} + 1;
    if (begin >= end) return;
    const double columns = grid.columns;
    std::int32_t* row = changes + (begin - first_row) * stride;
    auto v = static_cast<double>(begin);
    for (std::int64_t r = begin; r < end; ++r, v += 1.0, row += stride) {
        const double column = border.top_u + (v - border.top_v) * border.slope;
        row[static_cast<std::int32_t>(std::min(std::max(column, 0.0), columns))] += border.enters;
    }
}

PlanMask PlanScan::State::scan(const glm::dvec3& towards_sun, Scratch& scratch) const {
    const glm::dvec2 shift = internal::shadow_of_height_1(towards_sun);
    weigh(shift, scratch.weights);
    find_borders(shift, scratch);
    PlanMask mask(grid.cell_count());
    const std::size_t stride = std::size_t{grid.columns} + 1;
    const std::size_t rows_at_a_time =
        std::clamp<std::size_t>(cells_at_a_time / stride, 1, grid.rows);
    scratch.changes.resize(rows_at_a_time * stride);
    std::uint8_t* lit = mask.data();
    for (std::size_t first = 0; first < grid.rows; first += rows_at_a_time) {
        const std::size_t last = std::min<std::size_t>(first + rows_at_a_time, grid.rows);
        for (const Border& border : scratch.borders) {
            add_changes(border, static_cast<std::int64_t>(first), static_cast<std::int64_t>(last),
                        scratch.changes.data());
        }
        std::int32_t* change = scratch.changes.data();
        for (std::size_t row = first; row < last; ++row) {
            std::int32_t shadows = 0;
            for (std::uint32_t column = 0; column < grid.columns; ++column) {
                shadows += *change;
                *change++ = 0;
                *lit++ = shadows == 0 ? 1 : 0;
            }
            *change++ = 0;
        }
    }
    return mask;
}

PlanScan::PlanScan(std::span<const shadows::Caster> casters, const PlanGrid& grid,
                   shadows::Jobs jobs)
    : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.grid = grid;
    s.jobs = std::move(jobs);
    const internal::PlanTriangles triangles = internal::plan_triangles(casters, grid);
    const glm::dvec2 half = grid.size_m() * 0.5;
    for (const glm::dvec3& vertex : triangles.vertices) {
        s.vertices.u.push_back((vertex.x + half.x) / grid.cell_m - 0.5);
        s.vertices.v.push_back((half.y - vertex.y) / grid.cell_m - 0.5);
        s.vertices.height.push_back(vertex.z / grid.cell_m);
    }
    for (const auto& face : triangles.faces) {
        s.areas.add(triangles.vertices[face[0]] / grid.cell_m,
                    triangles.vertices[face[1]] / grid.cell_m,
                    triangles.vertices[face[2]] / grid.cell_m);
    }
    s.one_sided = triangles.one_sided;
    s.edges = edges_of(triangles.faces);
}

PlanScan::PlanScan(PlanScan&&) noexcept = default;
PlanScan& PlanScan::operator=(PlanScan&&) noexcept = default;
PlanScan::~PlanScan() = default;

std::vector<PlanMask> PlanScan::lit(std::span<const glm::dvec3> towards_suns_plan) {
    State& s = *state_;
    std::vector<PlanMask> masks(towards_suns_plan.size());
    const auto task = [&](std::size_t i) {
        GNOMON_EXPECTS(towards_suns_plan[i].z > 0.0);
        auto scratch = s.take_scratch();
        masks[i] = s.scan(towards_suns_plan[i], *scratch);
        s.give_back(std::move(scratch));
    };
    if (s.jobs) {
        s.jobs(masks.size(), task);
    } else {
        for (std::size_t i = 0; i < masks.size(); ++i) task(i);
    }
    return masks;
}

}  // namespace gnomon::sun_study
