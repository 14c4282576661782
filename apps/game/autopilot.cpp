// SPDX-License-Identifier: MIT
#include "autopilot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "movers.hpp"
#include "stage.hpp"
#include "world.hpp"

namespace gnomon::game {

namespace {

constexpr double cell_m = 0.5;
constexpr double never = std::numeric_limits<double>::infinity();

struct Step {
    int east;
    int south;
};
constexpr std::array<Step, 9> steps{
    {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

class Planner {
public:
    Planner(const Level& level, Stage stage, const PlanOptions& options)
        : level_(level), stage_(std::move(stage)), options_(options) {
        columns_ = static_cast<int>(std::floor(level.size_m.x / cell_m));
        rows_ = static_cast<int>(std::floor(level.size_m.y / cell_m));
        free_.resize(cell_count());
        for (std::size_t cell = 0; cell < cell_count(); ++cell) {
            const glm::dvec2 at = place(cell);
            const glm::dvec2 inside = level.size_m * 0.5 - glm::abs(at);
            free_[cell] = clearance(at, stage_.obstacles()) > Player::radius_m + 0.08 &&
                          std::min(inside.x, inside.y) > Player::radius_m;
        }
    }

    Result<Plan> find() {
        std::vector<double> costs(cell_count(), never);
        costs[nearest_free(level_.start)] = 0.0;
        const auto layers = static_cast<std::size_t>(options_.longest_s / slice_s());
        double best = never;
        std::size_t best_layer = 0;
        std::size_t best_cell = 0;
        for (std::size_t layer = 1; layer <= layers; ++layer) {
            auto next = advance(costs, static_cast<Tick>(layer) * Plan::slice);
            if (!next) return forward_error(next);
            costs = std::move(*next);
            double least = never;
            for (std::size_t cell = 0; cell < cell_count(); ++cell) {
                least = std::min(least, costs[cell]);
                if (!is_out(place(cell)) || costs[cell] >= best) continue;
                best = costs[cell];
                best_layer = layer;
                best_cell = cell;
            }
            // Costs only grow: what is not there yet comes dearer.
            if (least >= best) break;
        }
        if (best == never) {
            return fail(ErrorCode::Unsupported,
                        fmt::format("There is no way through \"{}\" within {} s on which no more "
                                    "than {} of a figure is lit.",
                                    level_.name, options_.longest_s, options_.brightest));
        }
        Plan plan;
        plan.places.resize(best_layer + 1);
        for (std::size_t layer = best_layer; layer > 0; --layer) {
            plan.places[layer] = place(best_cell);
            const Step step = steps[came_by_[layer - 1][best_cell]];
            best_cell = static_cast<std::size_t>(static_cast<int>(best_cell) - step.east -
                                                 step.south * columns_);
        }
        plan.places.front() = level_.start;
        return plan;
    }

private:
    static double slice_s() { return Plan::slice * tick_s; }
    [[nodiscard]] std::size_t cell_count() const {
        return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    }
    [[nodiscard]] glm::dvec2 place(std::size_t cell) const {
        const int column = static_cast<int>(cell) % columns_;
        const int row = static_cast<int>(cell) / columns_;
        return (glm::dvec2(column, row) - glm::dvec2(columns_ - 1, rows_ - 1) * 0.5) * cell_m;
    }
    [[nodiscard]] std::size_t nearest_free(const glm::dvec2& at) const {
        std::size_t best = 0;
        double least = never;
        for (std::size_t cell = 0; cell < cell_count(); ++cell) {
            const double distance = glm::length(place(cell) - at);
            if (free_[cell] && distance < least) {
                least = distance;
                best = cell;
            }
        }
        return best;
    }
    [[nodiscard]] bool is_out(const glm::dvec2& at) const {
        const glm::dvec2 away = glm::abs(at - level_.exit);
        return away.x < level_.exit_half_m.x && away.y < level_.exit_half_m.y;
    }

    /// What it costs to be there now: light, and guards that are near.
    [[nodiscard]] double danger(const glm::dvec2& at, Tick tick) const {
        double cost = 0.0;
        for (const Guard& guard : level_.guards) {
            const double distance = glm::length(guard_at(guard, tick).at - at);
            if (distance < 1.1) return never;
            if (distance < 2.0) cost += 2.0 * (2.0 - distance);
        }
        const std::array<glm::dvec3, 6> points{{{at.x, 1.62, at.y},
                                                {at.x, 1.15, at.y},
                                                {at.x - 0.22, 1.0, at.y},
                                                {at.x + 0.22, 1.0, at.y},
                                                {at.x, 0.55, at.y},
                                                {at.x, 0.12, at.y}}};
        const double level =
            read_exposure(stage_.queries(), stage_.lights(), points, level_.seen_lux, {}).level;
        if (level > options_.brightest) return never;
        return cost + 50.0 * level * level;
    }

    /// The costs of a slice from those of the slice before.
    Result<std::vector<double>> advance(const std::vector<double>& before, Tick tick) {
        // Doors as they stand when nobody but guards is there would hide too much.
        const std::vector<double> open(level_.doors.size(), 0.6);
        if (const Status posed = stage_.pose({.tick = tick, .doors = open}); !posed) {
            return forward_error(posed);
        }
        std::vector<double> costs(cell_count(), never);
        std::vector<std::uint8_t>& came_by = came_by_.emplace_back(cell_count(), std::uint8_t{0});
        for (int row = 0; row < rows_; ++row) {
            for (int column = 0; column < columns_; ++column) {
                const auto cell = static_cast<std::size_t>(row * columns_ + column);
                if (!free_[cell]) continue;
                for (std::size_t s = 0; s < steps.size(); ++s) {
                    const int from_column = column - steps[s].east;
                    const int from_row = row - steps[s].south;
                    if (from_column < 0 || from_row < 0 || from_column >= columns_ ||
                        from_row >= rows_) {
                        continue;
                    }
                    const auto from = static_cast<std::size_t>(from_row * columns_ + from_column);
                    // Around a corner, not over it.
                    const auto beside = static_cast<std::size_t>(row * columns_ + from_column);
                    const auto below = static_cast<std::size_t>(from_row * columns_ + column);
                    if (!free_[beside] || !free_[below]) continue;
                    const double way =
                        std::sqrt(steps[s].east * steps[s].east + steps[s].south * steps[s].south);
                    const double cost = before[from] + 0.8 + 0.12 * way;
                    if (cost < costs[cell]) {
                        costs[cell] = cost;
                        came_by[cell] = static_cast<std::uint8_t>(s);
                    }
                }
                if (costs[cell] < never) costs[cell] += danger(place(cell), tick);
            }
        }
        return costs;
    }

    const Level& level_;
    Stage stage_;
    PlanOptions options_;
    int columns_ = 0;
    int rows_ = 0;
    std::vector<bool> free_;
    std::vector<std::vector<std::uint8_t>> came_by_;
};

glm::dvec2 place_at(const Plan& plan, double tick) {
    const double slices = tick / Plan::slice;
    const auto last = plan.places.size() - 1;
    const auto begin = std::min(static_cast<std::size_t>(slices), last);
    const auto end = std::min(begin + 1, last);
    return glm::mix(plan.places[begin], plan.places[end],
                    std::min(slices - static_cast<double>(begin), 1.0));
}

/// What to press to be where the plan says a moment later.
Input steer(const Plan& plan, const Player& player, Tick now) {
    constexpr double ahead_ticks = 12.0;
    const glm::dvec2 to = place_at(plan, now + ahead_ticks) - player.at;
    glm::dvec2 wanted = to / (ahead_ticks * tick_s);
    // Where the plan waits there is time to duck.
    const auto slice =
        std::min(static_cast<std::size_t>(now / Plan::slice), plan.places.size() - 1);
    const auto next = std::min(slice + 1, plan.places.size() - 1);
    const bool waits = plan.places[slice] == plan.places[next] && glm::length(to) < 0.15;
    if (waits) wanted = glm::dvec2(0.0);
    glm::dvec2 stick = wanted / Player::walk_m_s;
    if (glm::length(stick) > 1.0) stick = glm::normalize(stick);
    // Rounded, so that a recording has long runs.
    const auto axis = [](double value) {
        return static_cast<std::int8_t>(std::lround(value * 15.875) * 8 * 127 / 128);
    };
    return {.east = axis(stick.x), .south = axis(stick.y), .sneak = waits};
}

}  // namespace

Result<Plan> plan_way(const Level& level, const PlanOptions& options) {
    auto stage = Stage::create(level);
    if (!stage) return forward_error(stage);
    return Planner(level, std::move(*stage), options).find();
}

Result<Recording> play_by_itself(const Level& level, const std::string& name) {
    auto plan = plan_way(level);
    if (!plan) plan = plan_way(level, {.brightest = 1.0});  // a dash through the light, perhaps
    if (!plan) return forward_error(plan);
    auto world = World::create(level);
    if (!world) return forward_error(world);
    Recording recording{.level = name, .inputs = {}};
    const Tick most = static_cast<Tick>(plan->places.size()) * Plan::slice + 5 * ticks_a_second;
    while (world->outcome() == Outcome::Playing && world->now() < most) {
        const Input input = steer(*plan, world->player(), world->now());
        recording.inputs.push_back(input);
        if (const Status done = world->tick(input); !done) return forward_error(done);
    }
    if (world->outcome() != Outcome::Won) {
        return fail(
            ErrorCode::Unsupported,
            fmt::format("The autopilot {} \"{}\" after {:.1f} s at ({:.1f}, {:.1f}).",
                        world->outcome() == Outcome::Caught ? "was caught in" : "got lost in",
                        level.name, seconds(world->now()), world->player().at.x,
                        world->player().at.y));
    }
    return recording;
}

}  // namespace gnomon::game
