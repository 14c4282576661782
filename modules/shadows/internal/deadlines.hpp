// SPDX-License-Identifier: MIT
//
// When each of many things is due, and the next of all: a tournament in which every node holds the
// least of its sixteen children. Nothing is looked at but what is due and the way there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::shadows::internal {

class Deadlines {
public:
    void resize(std::size_t count);
    /// By thing; rebuild() after writing.
    [[nodiscard]] std::span<double> values() { return levels_[0]; }
    void rebuild();

    /// Infinite where there is nothing.
    [[nodiscard]] double next() const { return next_; }
    /// How many are due before `time`, or some number above `limit` where there are more than that.
    [[nodiscard]] std::size_t count_due(double time, std::size_t limit) const;

    /// For every one that is due before `time`, ascending: its new deadline is renew(thing).
    template <class Renew>
    void renew_due(double time, const Renew& renew) {
        if (next_ < time) next_ = renew_node(levels_.size() - 1, 0, time, renew);
    }

    [[nodiscard]] std::size_t memory_bytes() const;

private:
    static constexpr std::size_t fan = 16;

    [[nodiscard]] static double least(std::span<const double> values);
    [[nodiscard]] std::span<double> children(std::size_t level, std::size_t node) {
        const std::span all(levels_[level]);
        return all.subspan(node * fan, std::min(fan, all.size() - node * fan));
    }
    template <class Renew>
    double renew_node(std::size_t level, std::size_t node, double time, const Renew& renew) {
        const std::span<double> values = children(level, node);
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!(values[i] < time)) continue;
            const std::size_t child = node * fan + i;
            values[i] = level == 0 ? renew(child) : renew_node(level - 1, child, time, renew);
        }
        return least(values);
    }
    void count_node(std::size_t level, std::size_t node, double time, std::size_t limit,
                    std::size_t& count) const;

    std::vector<std::vector<double>> levels_{{}};  ///< level k + 1: the least of 16 each of level k
    double next_ = std::numeric_limits<double>::infinity();
};

}  // namespace gnomon::shadows::internal
