// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <gnomon/report/writers.hpp>

#include "internal/page_parts.hpp"
#include "internal/plot.hpp"

namespace gnomon::report::internal {

namespace {

/// A technique that was measured in all of the scenes.
struct Candidate {
    const Row* row = nullptr;  // of the first
    std::uint64_t wrong = 0;   // pixels of the worst frames, summed
    double times_auto = 1.0;   // geometric mean
    bool is_faster = true;     // than auto, in each, beyond the interval
};

std::vector<Candidate> candidates_in(const Cells& cells) {
    std::vector<Candidate> all;
    for (const Row& row : cells.front()->rows) {
        Candidate candidate{&row};
        double logs = 0.0;
        const bool is_everywhere = std::ranges::all_of(cells, [&](const Cell* cell) {
            const Row* there = find_row(*cell, row.technique);
            if (there == nullptr) return false;
            candidate.wrong += there->errors.wrong_worst;
            candidate.is_faster = candidate.is_faster && there->against_auto.high < 0.95;
            logs += std::log(there->against_auto.mean);
            return true;
        });
        candidate.times_auto = std::exp(logs / static_cast<double>(cells.size()));
        if (row.general && is_everywhere) all.push_back(candidate);
    }
    return all;
}

std::string scenes(const Cells& cells) {
    return cells.size() == 1 ? "this scene" : fmt::format("each of these {} scenes", cells.size());
}

std::string how_right(std::uint64_t wrong) {
    if (wrong == 0) return "Not one wrong pixel in any frame.";
    return fmt::format("It has the fewest wrong pixels, {} in the worst frame{}: see below.",
                       with_commas(wrong), wrong == 1 ? "" : "s");
}

}  // namespace

Recommendation recommend(const Cells& cells) {
    const std::vector<Candidate> all = candidates_in(cells);
    if (all.empty()) return {};
    const auto fewest = std::ranges::min_element(all, {}, &Candidate::wrong)->wrong;
    const auto automatic =
        std::ranges::find_if(all, [](const Candidate& c) { return c.row->technique == "auto"; });
    const bool auto_is_right = automatic != all.end() && automatic->wrong == fewest;
    const Candidate* best = auto_is_right ? &*automatic : nullptr;
    for (const Candidate& candidate : all) {
        if (candidate.wrong > fewest || (auto_is_right && !candidate.is_faster)) continue;
        if (best == nullptr || candidate.times_auto < best->times_auto) best = &candidate;
    }
    const std::string name = escaped(best->row->technique);
    if (auto_is_right && best == &*automatic) {
        return {"auto",
                fmt::format("Use <code>auto</code>, gnomon’s default. {}", how_right(best->wrong))};
    }
    if (auto_is_right) {
        return {
            best->row->technique,
            fmt::format("Use <code>{}</code>: as right as <code>auto</code>, and {:.0f} % of its "
                        "time in {}. {}",
                        name, best->times_auto * 100.0, scenes(cells), how_right(best->wrong))};
    }
    return {
        best->row->technique,
        fmt::format("Use <code>{}</code>: {} wrong pixels in the worst frames, where "
                    "<code>auto</code> {}.",
                    name, with_commas(best->wrong),
                    automatic != all.end() ? fmt::format("has {}", with_commas(automatic->wrong))
                                           : std::string("could not be measured"))};
}

}  // namespace gnomon::report::internal
