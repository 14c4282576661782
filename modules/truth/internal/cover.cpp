// SPDX-License-Identifier: MIT
#include "internal/cover.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gnomon::truth::internal {

namespace {

/// One use of an edge by a tile.
struct Use {
    std::pair<std::uint32_t, std::uint32_t> edge;  // lower id first
    int tile = 0;
    bool on_left = false;  // of the edge, seen from the apex
};

std::vector<Use> uses_inside(std::span<const Tile> tiles) {
    std::vector<Use> uses;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (!tiles[i].usable || (tiles[i].edges_inside & (1U << k)) == 0U) continue;
            const std::uint32_t a = tiles[i].corners[k];
            const std::uint32_t b = tiles[i].corners[(k + 1) % 3];
            uses.push_back({std::minmax(a, b), static_cast<int>(i), (a < b) == tiles[i].towards});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.edge < b.edge; });
    return uses;
}

/// Calls visit(first, last) for every run of uses of one edge.
template <class Visit>
void each_edge(const std::vector<Use>& uses, Visit&& visit) {
    for (std::size_t first = 0; first < uses.size();) {
        std::size_t last = first;
        while (last < uses.size() && uses[last].edge == uses[first].edge) ++last;
        visit(std::span(uses).subspan(first, last - first));
        first = last;
    }
}

int root_of(std::vector<int>& parent, int tile) {
    auto at = [&](int i) -> int& { return parent[static_cast<std::size_t>(i)]; };
    while (at(tile) != tile) tile = at(tile) = at(at(tile));
    return tile;
}

}  // namespace

int find_covers(std::span<const Tile> tiles, std::vector<int>& cover_of) {
    const std::vector<Use> uses = uses_inside(tiles);
    std::vector<char> alive(tiles.size());
    for (std::size_t i = 0; i < tiles.size(); ++i) alive[i] = tiles[i].usable ? 1 : 0;
    const auto lives = [&](const Use& use) -> char& {
        return alive[static_cast<std::size_t>(use.tile)];
    };

    for (bool changed = true; changed;) {
        changed = false;
        each_edge(uses, [&](std::span<const Use> run) {
            bool left = false;
            bool right = false;
            for (const Use& use : run) {
                if (lives(use) != 0) (use.on_left ? left : right) = true;
            }
            if (left == right) return;
            for (const Use& use : run) {
                if (lives(use) != 0) changed = true;
                lives(use) = 0;
            }
        });
    }

    std::vector<int> parent(tiles.size());
    std::iota(parent.begin(), parent.end(), 0);
    each_edge(uses, [&](std::span<const Use> run) {
        int first = no_cover;
        for (const Use& use : run) {
            if (lives(use) == 0) continue;
            const int root = root_of(parent, use.tile);
            if (first == no_cover) first = root;
            parent[static_cast<std::size_t>(root)] = root_of(parent, first);
        }
    });

    std::vector<int> number(tiles.size(), no_cover);
    cover_of.assign(tiles.size(), no_cover);
    int count = 0;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (alive[i] == 0) continue;
        int& of_root = number[static_cast<std::size_t>(root_of(parent, static_cast<int>(i)))];
        if (of_root == no_cover) of_root = count++;
        cover_of[i] = of_root;
    }
    return count;
}

}  // namespace gnomon::truth::internal
