// SPDX-License-Identifier: MIT
#include "contest.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <random>

#include "streaming_floor.hpp"

namespace gnomon::bench {

namespace {

using Clock = std::chrono::steady_clock;

double ns_between(Clock::time_point begin, Clock::time_point end) {
    return std::chrono::duration<double, std::nano>(end - begin).count();
}

double net(double ns) { return std::max(1.0, ns - clock_cost_ns()); }

constexpr std::uint64_t usual_block = 9;
constexpr std::uint64_t smallest_block = 3;
constexpr std::uint64_t fewest_blocks = 9;
constexpr int repeats = 3;

struct Entry {
    const Contestant* contestant = nullptr;
    std::unique_ptr<shadows::SilhouetteDetector> detector;
    double first_ns = 0.0;
    std::vector<double> frames_ns;  // repeat by repeat
    std::vector<double> timed_ns;   // the same without the first frame of each turn
    std::vector<double> blocks_ns;
    shadows::DetectionStats sum;
    double edges = 0.0;
    std::array<std::uint64_t, shadows::choice_count> choices{};
};

struct Answer {
    shadows::CastingFaces casting;
    std::vector<shadows::SilhouetteEdge> silhouette;
    std::vector<std::uint8_t> solid_averted;
    bool operator==(const Answer&) const = default;
};

class Run {
public:
    Run(const shadows::ShadowMesh& mesh, const Motion& motion,
        std::span<const Contestant> contestants)
        : mesh_(mesh), motion_(motion), about_(bounding_sphere(mesh)), floor_(mesh.faces().size()) {
        for (const Contestant& contestant : contestants) {
            entries_.push_back({&contestant, nullptr, 0.0, {}, {}, {}, {}, 0.0, {}});
        }
    }

    Contest operator()(double seconds) {
        const Clock::time_point begin = Clock::now();
        std::uint64_t block = usual_block;
        std::uint64_t blocks = 0;
        int last = repeats;
        for (int repeat = 0; repeat < last; ++repeat) {
            for (Entry& entry : entries_) {
                const bool kept = repeat > 0 && entry.contestant->is_memoryless;
                if (!kept) entry.detector = entry.contestant->create();
                const double first_ns = detect(entry, 0);
                if (!kept) entry.first_ns = first_ns;
            }
            compare(0);
            // The second frame tells how long a block would be.
            const Clock::time_point second = Clock::now();
            for (Entry& entry : entries_) detect(entry, 1);
            if (repeat == 0) {
                const double round_s = 1e-9 * ns_between(second, Clock::now());
                if (10.0 * round_s > seconds) last = 1;
                const double affordable = seconds / (16.0 * last * round_s + 1e-9);
                block = static_cast<std::uint64_t>(std::clamp(affordable,
                                                              static_cast<double>(smallest_block),
                                                              static_cast<double>(usual_block)));
            }
            const auto goes_on = [&](std::uint64_t done) {
                if (repeat > 0) return done < blocks;
                return done * static_cast<std::uint64_t>(last) < fewest_blocks ||
                       ns_between(begin, Clock::now()) * last < seconds * 1e9;
            };
            std::uint64_t done = 0;
            for (; goes_on(done); ++done) one_block(done, 2 + done * block, block);
            blocks = done;
            compare(2 + blocks * block);
        }
        return summary(blocks * block, block);
    }

private:
    double detect(Entry& entry, std::uint64_t frame) {
        const shadows::LightLocal light = light_of(motion_, about_, frame);
        const Clock::time_point begin = Clock::now();
        const shadows::Detection& found =
            entry.detector->detect(mesh_, light, shadows::NearCaps::Facing);
        const double time = net(ns_between(begin, Clock::now()));
        if (frame < 2) return time;
        entry.sum.faces_tested += found.stats.faces_tested;
        entry.sum.edges_tested += found.stats.edges_tested;
        entry.sum.bytes_touched += found.stats.bytes_touched;
        entry.edges += static_cast<double>(found.silhouette.size());
        ++entry.choices[static_cast<std::size_t>(entry.detector->choice())];
        return time;
    }

    // The floor has a turn as well, with the last number.
    void one_block(std::uint64_t index, std::uint64_t first, std::uint64_t frames) {
        std::vector<std::size_t> turns(entries_.size() + 1);
        std::iota(turns.begin(), turns.end(), std::size_t{0});
        std::mt19937_64 order(index);
        std::ranges::shuffle(turns, order);
        for (const std::size_t whose : turns) {
            if (whose == entries_.size()) {
                checksum_ = checksum_ + floor_.read();
                for (std::uint64_t i = 1; i < frames; ++i) read_floor();
                continue;
            }
            Entry& entry = entries_[whose];
            double sum = 0.0;
            for (std::uint64_t i = 0; i < frames; ++i) {
                entry.frames_ns.push_back(detect(entry, first + i));
                if (i == 0) continue;
                entry.timed_ns.push_back(entry.frames_ns.back());
                sum += entry.frames_ns.back();
            }
            entry.blocks_ns.push_back(sum);
        }
    }

    void read_floor() {
        const Clock::time_point begin = Clock::now();
        checksum_ = checksum_ + floor_.read();
        floor_ns_.push_back(net(ns_between(begin, Clock::now())));
    }

    Answer answer(Entry& entry, std::uint64_t frame) {
        const shadows::Detection& found = entry.detector->detect(
            mesh_, light_of(motion_, about_, frame), shadows::NearCaps::Facing);
        Answer result{found.casting, found.silhouette, found.solid_averted};
        std::ranges::sort(result.silhouette);
        return result;
    }

    void compare(std::uint64_t frame) {
        std::optional<Answer> wanted;
        std::string by;
        for (Entry& entry : entries_) {
            if (!entry.contestant->compared) continue;
            Answer got = answer(entry, frame);
            if (!wanted) {
                wanted = std::move(got);
                by = entry.contestant->name;
            } else if (got != *wanted) {
                disagreements_.push_back(entry.contestant->name + " finds another answer than " +
                                         by + " in frame " + std::to_string(frame) + ".");
            }
        }
    }

    // One value a block: of what the other took and this one.
    template <class Compare>
    std::optional<Spread> compared_to(std::string_view name, const Entry& entry,
                                      const Compare& compare) const {
        const auto other = std::ranges::find(
            entries_, name, [](const Entry& e) -> std::string_view { return e.contestant->name; });
        if (other == entries_.end()) return std::nullopt;
        std::vector<double> values(entry.blocks_ns.size());
        std::ranges::transform(other->blocks_ns, entry.blocks_ns, values.begin(), compare);
        return spread_of(values);
    }

    std::optional<Spread> faster_than(std::string_view name, const Entry& entry) const {
        return compared_to(name, entry, std::divides<>());
    }

    void add_parts(const Entry& entry, std::uint64_t block, Measured& measured) const {
        if (measured.name != "auto") return;
        const double frames = static_cast<double>(block - 1);
        for (const char* part : {"brute_force", "simd", "dual_bvh", "certificates"}) {
            const auto ratio = faster_than(part, entry);
            if (!ratio) continue;
            measured.faster_than_parts.emplace_back(part, *ratio);
            measured.slower_than_parts_ns.emplace_back(
                part, *compared_to(part, entry, [frames](double theirs, double ours) {
                    return (ours - theirs) / frames;
                }));
        }
    }

    static double worst_of(std::span<const double> times, std::size_t frames) {
        double worst = 0.0;
        for (std::size_t f = 0; f < frames; ++f) {
            double best = times[f];
            for (std::size_t at = f; at < times.size(); at += frames) {
                best = std::min(best, times[at]);
            }
            worst = std::max(worst, best);
        }
        return worst;
    }

    Contest summary(std::uint64_t frames, std::uint64_t block) const {
        Contest result{.frames = frames,
                       .frames_per_block = block,
                       .silhouette_edges = 0.0,
                       .floor_ns = spread_of(floor_ns_),
                       .measured = {},
                       .disagreements = disagreements_};
        for (const Entry& entry : entries_) {
            const std::vector<double>& times = entry.frames_ns;
            const auto count = static_cast<double>(times.size());
            result.measured.push_back(
                {.name = entry.contestant->name,
                 .time_ns = spread_of(entry.timed_ns),
                 .mean_ns = std::accumulate(times.begin(), times.end(), 0.0) / count,
                 .worst_ns = worst_of(times, frames),
                 .first_ns = entry.first_ns,
                 .faces_tested = static_cast<double>(entry.sum.faces_tested) / count,
                 .edges_tested = static_cast<double>(entry.sum.edges_tested) / count,
                 .bytes_touched = static_cast<double>(entry.sum.bytes_touched) / count,
                 .memory_bytes = entry.detector->memory_bytes(),
                 .choices = entry.choices,
                 .faster_than_brute_force = faster_than("brute_force", entry),
                 .faster_than_simd = faster_than("simd", entry)});
            add_parts(entry, block, result.measured.back());
            if (result.silhouette_edges == 0.0 && entry.contestant->compared) {
                result.silhouette_edges = entry.edges / count;
            }
        }
        return result;
    }

    const shadows::ShadowMesh& mesh_;
    const Motion& motion_;
    Sphere about_;
    StreamingFloor floor_;
    std::vector<Entry> entries_;
    std::vector<double> floor_ns_;
    volatile std::uint64_t checksum_ = 0;
    std::vector<std::string> disagreements_;
};

}  // namespace

Contest run_contest(const shadows::ShadowMesh& mesh, const Motion& motion,
                    std::span<const Contestant> contestants, double seconds) {
    return Run(mesh, motion, contestants)(seconds);
}

Sphere bounding_sphere(const shadows::ShadowMesh& mesh) {
    const glm::dvec3 low(mesh.bounds_min());
    const glm::dvec3 high(mesh.bounds_max());
    return {0.5 * (low + high), 0.5 * glm::length(high - low)};
}

double clock_cost_ns() {
    static const double cost = [] {
        std::vector<double> samples;
        for (int i = 0; i < 2'000; ++i) {
            const Clock::time_point begin = Clock::now();
            samples.push_back(ns_between(begin, Clock::now()));
        }
        return spread_of(samples).median;
    }();
    return cost;
}

}  // namespace gnomon::bench
