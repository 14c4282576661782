// SPDX-License-Identifier: MIT
#include "paired.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <numeric>
#include <vector>

#include <nlohmann/json.hpp>

#include <gnomon/shadows/jobs.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

#include "contest.hpp"
#include "literature.hpp"
#include "machine.hpp"
#include "meshlets.hpp"
#include "streaming_floor.hpp"
#include "subjects.hpp"

namespace gnomon::bench {

namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;
using MeshPointer = std::shared_ptr<const shadows::ShadowMesh>;

double ms_since(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// Beyond it the literature's strategies would take most of the time there is.
constexpr std::size_t largest_for_literature = 1'200'000;

// Who competes: those that are fast or are compared with; the literature's; the quadratic one. They
// run apart, so that the slow ones do not leave the fast ones a few frames and cold caches, and
// brute_force is in each.
enum class Field { Fast, Literature, Quadratic };

// Four digits are more than the clock is good for.
double rounded(double value) {
    if (value == 0.0 || !std::isfinite(value)) return value;
    const double unit = std::pow(10.0, 3.0 - std::floor(std::log10(std::abs(value))));
    return std::round(value * unit) / unit;
}

Json to_json(const Spread& spread) {
    return {{"median", rounded(spread.median)},
            {"lower_quartile", rounded(spread.lower_quartile)},
            {"upper_quartile", rounded(spread.upper_quartile)},
            {"low", rounded(spread.low)},
            {"high", rounded(spread.high)}};
}

Json to_json(const std::optional<Spread>& spread) {
    return spread ? to_json(*spread) : Json(nullptr);
}

Json to_json(const Contest& contest) {
    Json strategies = Json::array();
    for (const Measured& m : contest.measured) {
        Json choices = Json::object();
        for (std::size_t i = 0; i < m.choices.size(); ++i) {
            if (m.choices[i] == 0) continue;
            choices[std::string(to_string(static_cast<shadows::Choice>(i)))] = m.choices[i];
        }
        Json parts = Json::object();
        for (const auto& [name, spread] : m.faster_than_parts) parts[name] = to_json(spread);
        Json parts_ns = Json::object();
        for (const auto& [name, spread] : m.slower_than_parts_ns) parts_ns[name] = to_json(spread);
        strategies.push_back({{"name", m.name},
                              {"time_ns", to_json(m.time_ns)},
                              {"mean_ns", rounded(m.mean_ns)},
                              {"worst_ns", rounded(m.worst_ns)},
                              {"first_ns", rounded(m.first_ns)},
                              {"faces_tested", rounded(m.faces_tested)},
                              {"edges_tested", rounded(m.edges_tested)},
                              {"bytes_touched", rounded(m.bytes_touched)},
                              {"memory_bytes", m.memory_bytes},
                              {"choices", std::move(choices)},
                              {"faster_than_parts", std::move(parts)},
                              {"slower_than_parts_ns", std::move(parts_ns)},
                              {"faster_than_brute_force", to_json(m.faster_than_brute_force)},
                              {"faster_than_simd", to_json(m.faster_than_simd)}});
    }
    return {{"frames", contest.frames},
            {"frames_per_block", contest.frames_per_block},
            {"silhouette_edges", rounded(contest.silhouette_edges)},
            {"floor_ns", to_json(contest.floor_ns)},
            {"strategies", std::move(strategies)}};
}

Field field_of(std::string_view strategy) {
    if (strategy == "edge_stack_naive") return Field::Quadratic;
    return is_of_the_literature(strategy) ? Field::Literature : Field::Fast;
}

std::vector<Contestant> field(Field wanted, std::vector<Contestant> all) {
    std::erase_if(all, [&](const Contestant& contestant) {
        return contestant.name != "brute_force" && field_of(contestant.name) != wanted;
    });
    return all;
}

// A line a row of each table: smaller than one a number, and differences can be read.
void write_by_rows(const Json& file, std::ostream& stream) {
    char separator = '{';
    for (const auto& [key, value] : file.items()) {
        stream << separator << "\n" << Json(key).dump() << ": ";
        separator = ',';
        if (!value.is_array() || value.empty()) {
            stream << value.dump();
            continue;
        }
        char between = '[';
        for (const Json& row : value) {
            stream << between << "\n " << row.dump();
            between = ',';
        }
        stream << "\n]";
    }
    stream << "\n}\n";
}

std::vector<Contestant> everyone() {
    std::vector<Contestant> result;
    for (const shadows::SilhouetteStrategy& strategy : shadows::silhouette_strategies()) {
        // The GPU's: what is left to the CPU is done by another strategy's detector.
        if (strategy.quads != shadows::QuadFacing::None) continue;
        result.push_back(
            {std::string(strategy.name), strategy.create, true, is_memoryless(strategy)});
    }
    if (const auto* automatic = shadows::find_strategy("auto")) {
        result.push_back({"auto", automatic->create});
    }
    if (auto clusters = meshlets()) result.push_back(std::move(*clusters));
    return result;
}

const Motion point_jump{"jump", Motion::Kind::Jump, 0.0, false};

class PairedRun {
public:
    explicit PairedRun(const PairedOptions& options) : options_(options) {}

    Status operator()() {
        const std::vector<Subject> meshes = wanted(subjects(options_.models, options_.quick));
        const std::vector<Subject> scenes = wanted(stand_ins(options_.quick));
        const std::vector<Motion> moves = motions(options_.quick);
        double contests = 4.0 * static_cast<double>(scenes.size());
        for (const Subject& subject : meshes) {
            contests += subject.share * static_cast<double>(moves.size() + 1);
        }
        const double seconds = options_.seconds / std::max(1.0, contests);
        for (const Subject& subject : meshes) {
            const Result<MeshPointer> mesh = build(subject);
            if (!mesh) return forward_error(mesh);
            for (const Motion& motion : moves) {
                std::vector<Contestant> fast = field(Field::Fast, everyone());
                if (motion.kind != Motion::Kind::Jump) {  // what has no memory learns nothing else
                    std::erase_if(fast,
                                  [](const Contestant& c) { return c.name == "meshoptimizer"; });
                }
                add("rows", subject, **mesh, motion, fast, seconds * subject.share);
            }
            if ((*mesh)->faces().size() > largest_for_literature) continue;
            add("literature", subject, **mesh, point_jump, field(Field::Literature, everyone()),
                seconds * subject.share);
        }
        for (const Subject& subject : scenes) {
            const Result<MeshPointer> mesh = build(subject);
            if (!mesh) return forward_error(mesh);
            for (const Field who : {Field::Literature, Field::Quadratic}) {
                add("scenes", subject, **mesh, point_jump, field(who, everyone()), seconds);
                std::vector<Contestant> drawing = field(who, with_volumes());
                if (who == Field::Literature) drawing.push_back(without_silhouette());
                add("scenes_with_volumes", subject, **mesh, point_jump, drawing, seconds);
            }
        }
        return write();
    }

private:
    std::vector<Subject> wanted(std::vector<Subject> all) const {
        std::erase_if(all, [&](const Subject& subject) {
            return subject.name.find(options_.only) == std::string::npos;
        });
        return all;
    }

    // Also what is built from the mesh, strategy by strategy: what the first frame takes beyond a
    // jump's usual one. Where strategies share a structure, the first of them pays.
    Result<MeshPointer> build(const Subject& subject) {
        std::fprintf(stderr, "gnomon-bench: %s\n", subject.name.c_str());
        const Result<scene::Mesh> source = subject.make();
        if (!source) return forward_error(source);
        const shadows::MeshView view{
            .positions = reinterpret_cast<const std::byte*>(source->positions.data()),
            .vertex_count = source->positions.size(),
            .indices = source->indices};
        const Clock::time_point shared = Clock::now();
        static_cast<void>(shadows::ShadowMesh::build(view, two_threads_));
        const double two_threads_ms = ms_since(shared);
        const Clock::time_point begin = Clock::now();
        auto mesh = shadows::ShadowMesh::build(view);
        if (!mesh) {
            return fail(mesh.error().code, subject.name + ": " + mesh.error().message);
        }
        const double mesh_ms = ms_since(begin);
        const Sphere about = bounding_sphere(**mesh);
        Json structures = Json::array();
        for (const Contestant& contestant : everyone()) {
            const bool quick_enough = field_of(contestant.name) == Field::Fast ||
                                      (field_of(contestant.name) == Field::Literature &&
                                       (*mesh)->faces().size() <= largest_for_literature);
            if (!quick_enough) continue;
            const auto detector = contestant.create();
            const auto detect = [&](std::uint64_t frame) {
                const Clock::time_point start = Clock::now();
                static_cast<void>(detector->detect(**mesh, light_of(point_jump, about, frame),
                                                   shadows::NearCaps::Facing));
                return ms_since(start);
            };
            const double first_ms = detect(0);
            const double usual_ms = std::min(detect(1), detect(2));
            structures.push_back({{"name", contestant.name},
                                  {"build_ms", std::max(0.0, first_ms - usual_ms)},
                                  {"memory_bytes", detector->memory_bytes()}});
        }
        json_["builds"].push_back({{"mesh", subject.name},
                                   {"family", subject.family},
                                   {"triangles", (*mesh)->faces().size()},
                                   {"edges", (*mesh)->edges().size()},
                                   {"closed", (*mesh)->report().closed()},
                                   {"mesh_ms", mesh_ms},
                                   {"mesh_two_threads_ms", two_threads_ms},
                                   {"mesh_bytes", (*mesh)->memory_bytes()},
                                   {"structures", std::move(structures)}});
        return *mesh;
    }

    void add(const char* table, const Subject& subject, const shadows::ShadowMesh& mesh,
             const Motion& motion, const std::vector<Contestant>& contestants, double seconds) {
        const Contest contest = run_contest(mesh, motion, contestants, seconds);
        for (const std::string& sentence : contest.disagreements) {
            disagreements_.push_back(subject.name + ", " + motion.name + ": " + sentence);
        }
        Json row{{"mesh", subject.name},
                 {"family", subject.family},
                 {"triangles", mesh.faces().size()},
                 {"motion", motion.name},
                 {"degrees", motion.degrees},
                 {"light", motion.directional ? "directional" : "point"}};
        row.update(to_json(contest));
        json_[table].push_back(std::move(row));
    }

    Status write() {
        Json file{{"format", 1},
                  {"quick", options_.quick},
                  {"machine", describe_machine()},
                  {"clock_cost_ns", clock_cost_ns()},
                  {"floor_bytes_per_triangle", StreamingFloor::bytes_per_triangle}};
        for (const char* table :
             {"builds", "rows", "literature", "scenes", "scenes_with_volumes"}) {
            file[table] = json_.contains(table) ? json_[table] : Json::array();
        }
        file["disagreements"] = disagreements_;
        std::error_code ignored;  // the stream below says whether it worked
        std::filesystem::create_directories(options_.out.parent_path(), ignored);
        std::ofstream stream(options_.out);
        write_by_rows(file, stream);
        if (!stream.flush()) {
            return fail(ErrorCode::Io, "\"" + options_.out.string() + "\" cannot be written.");
        }
        if (disagreements_.empty()) return {};
        return fail(ErrorCode::Internal,
                    std::to_string(disagreements_.size()) +
                        " times strategies disagreed; the first: " + disagreements_.front());
    }

    PairedOptions options_;
    shadows::Jobs two_threads_ = shadows::thread_jobs(2);
    Json json_ = Json::object();
    std::vector<std::string> disagreements_;
};

}  // namespace

Status run_paired(const PairedOptions& options) { return PairedRun(options)(); }

}  // namespace gnomon::bench
