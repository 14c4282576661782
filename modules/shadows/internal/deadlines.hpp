// SPDX-License-Identifier: MIT
//
// When each of many things is due, and the next of all: a tournament in which every node holds the
// least of its sixteen children. Nothing is looked at but what is due and the way there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::shadows::internal {

class Deadlines {
public:
    void resize(std::size_t count);
    /// By thing. rebuild() or renew() after writing.
    [[nodiscard]] std::span<double> values() { return levels_[0]; }
    void rebuild();
    /// The same where only these things have other deadlines; ascending.
    void renew(std::span<const std::uint32_t> things);

    /// Infinite where there is nothing.
    [[nodiscard]] double next() const { return next_; }
    /// Calls visit(thing) for every one that is due before `time`, ascending, as long as it returns
    /// true.
    template <class Visit>
    void visit_due(double time, const Visit& visit) const {
        if (next_ < time) static_cast<void>(visit_node(levels_.size() - 1, 0, time, visit));
    }

    [[nodiscard]] std::size_t memory_bytes() const;

private:
    static constexpr std::size_t fan = 16;

    [[nodiscard]] static double least(std::span<const double> values);
    [[nodiscard]] std::span<const double> children(std::size_t level, std::size_t node) const {
        const std::span all(levels_[level]);
        return all.subspan(node * fan, std::min(fan, all.size() - node * fan));
    }
    template <class Visit>
    bool visit_node(std::size_t level, std::size_t node, double time, const Visit& visit) const {
        const std::span<const double> values = children(level, node);
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!(values[i] < time)) continue;
            const bool more = level == 0 ? visit(node * fan + i)
                                         : visit_node(level - 1, node * fan + i, time, visit);
            if (!more) return false;
        }
        return true;
    }

    std::vector<std::vector<double>> levels_{{}};  ///< level k + 1: the least of 16 each of level k
    double next_ = std::numeric_limits<double>::infinity();
};

}  // namespace gnomon::shadows::internal
