// SPDX-License-Identifier: MIT
//
// A paired run: several detectors on the same mesh and the same lights, taking turns. Google
// Benchmark times one thing for a while and then the next, so that a machine that becomes slower in
// between makes the later one look worse; here what is compared is measured within milliseconds,
// and the ratios are those of such pairs.
//
// The whole is run three times, from the same start over the same lights. What one frame takes at
// worst is the worst of the best of three: a strategy that does more work in some frame does so
// every time, but a processor that was taken away comes back the next time.
// Where ten frames of all would take longer than there is time, one repeat has to do. Turns are
// nine at least in any case: the interval of a median wants six.
//
// Turns are blocks of a few frames in an order that is drawn anew for each block. The first frame
// of a turn counts for the worst frame and the mean alone: what it finds in the caches is what the
// one before left there, which may be the same tables or megabytes of others.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/shadows/detector.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

#include "motion.hpp"
#include "statistics.hpp"

namespace gnomon::bench {

struct Contestant {
    std::string name;
    std::function<std::unique_ptr<shadows::SilhouetteDetector>()> create;
    /// Its answer has to be that of the others.
    bool compared = true;
    /// It keeps nothing that depends on the lights it saw: one detector serves all repeats, so that
    /// what it makes of the mesh is made once.
    bool is_memoryless = false;
};

/// Times are those of one frame; a clock's own cost is taken off.
struct Measured {
    std::string name;
    Spread time_ns;         ///< without the first frame of each turn
    double mean_ns = 0.0;   ///< of all frames but the first two
    double worst_ns = 0.0;  ///< of all frames but the first two, each the best of its repeats
    double first_ns = 0.0;  ///< of the first frame, which makes what the strategy keeps
    // Means of what the detector says of its frames (shadows::DetectionStats), the first two left
    // out.
    double faces_tested = 0.0;
    double edges_tested = 0.0;
    double bytes_touched = 0.0;
    std::size_t memory_bytes = 0;  ///< at the end
    /// How many frames each shadows::Choice decided, the first two left out.
    std::array<std::uint64_t, shadows::choice_count> choices{};
    /// How many times as long the other took, block by block.
    std::optional<Spread> faster_than_brute_force = std::nullopt;
    std::optional<Spread> faster_than_simd = std::nullopt;
    /// Of "auto" alone: the same against each of what it chooses from, and by how many nanoseconds
    /// a frame it was slower, block by block: a ratio of two times of some nanoseconds says little.
    std::vector<std::pair<std::string, Spread>> faster_than_parts = {};
    std::vector<std::pair<std::string, Spread>> slower_than_parts_ns = {};
};

struct Contest {
    std::uint64_t frames = 0;  ///< of one repeat
    std::uint64_t frames_per_block = 0;
    double silhouette_edges = 0.0;   ///< mean
    Spread floor_ns;                 ///< of StreamingFloor, in its turn
    std::vector<Measured> measured;  ///< in the contestants' order
    /// A sentence for each contestant whose answer was another than the first one's, for the first
    /// light or the last of a repeat.
    std::vector<std::string> disagreements;
};

/// Runs until `seconds` are over, about, and for nine blocks of three frames at least, however long
/// they take.
[[nodiscard]] Contest run_contest(const shadows::ShadowMesh& mesh, const Motion& motion,
                                  std::span<const Contestant> contestants, double seconds);

/// The ball about the mesh's bounds.
[[nodiscard]] Sphere bounding_sphere(const shadows::ShadowMesh& mesh);

/// What a call of the clock costs; measured once.
[[nodiscard]] double clock_cost_ns();

}  // namespace gnomon::bench
