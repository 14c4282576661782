// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gnomon/render/light_choice.hpp>

#include "internal/subject_motion.hpp"
#include "internal/technique.hpp"
#include "internal/thumbnails.hpp"

namespace gnomon::report {

namespace {

using namespace internal;

/// A technique at work: its row, and what was measured for it so far.
struct Contender {
    Entry entry;
    Row row;
    std::unique_ptr<Technique> technique;
    std::vector<double> frame_ms, detect_ms, build_ms, record_ms, upload_bytes;
    // Frames, or medians of rounds, and what "auto" took right beside them.
    std::vector<double> paired_ms;
    std::vector<double> paired_ms_of_auto;
    std::vector<truth::Judgement> judgements;
};

// Wrong pixels that a note gives places of.
constexpr std::size_t most_named = 16;

class Measuring {
public:
    Measuring(gpu::Device& device, Subject& subject, const Options& options,
              const std::function<void(const Progress&)>& progress)
        : device_(device),
          subject_(subject),
          options_(options),
          progress_(progress),
          motion_(subject, options) {}

    Result<Cell> run();

private:
    Status trace();
    Status choose();
    void judge(Contender& contender);
    struct Mask {
        std::uint32_t frame = 0;
        std::size_t light = 0;
    };
    void look_into(Technique& technique, const Moment& moment, Mask of,
                   const truth::Judgement& judged);
    bool restart(Contender& contender);
    std::optional<double> time_frame(Contender& contender, std::uint32_t frame);
    double time_alone(Contender& contender);
    void time_beside_auto(Contender& contender, std::uint32_t round);
    void play_round(std::uint32_t round);
    void play_rounds();
    void time_nothing();
    void finish(Contender& contender);
    void tell(std::string what, double weight) {
        done_ += weight;
        if (progress_) progress_({std::min(1.0, done_ / all_), std::move(what)});
    }
    // What fails is left out from then on, and says why. Without the device all would.
    void drop(Contender& contender, const Error& error) {
        contender.row.skipped = error.message;
        contender.technique.reset();
        if (error.code == ErrorCode::DeviceLost) lost_ = error;
    }

    gpu::Device& device_;
    const Subject& subject_;
    const Options& options_;
    const std::function<void(const Progress&)>& progress_;
    LightTurn motion_;
    std::unique_ptr<Stage> stage_;
    std::vector<FrameTruth> truth_;  // by frame
    std::vector<Contender> contenders_;
    std::uint64_t wrong_of_auto_ = 0;  // over all frames
    std::uint64_t edge_on_of_auto_ = 0;
    std::vector<std::string> unexplained_;  // the first of the others, in words
    std::uint32_t rounds_ = 0;
    double empty_frame_ms_ = 0.0;
    std::optional<Error> lost_;
    double done_ = 0.0;
    double all_ = 1.0;
};

Status Measuring::trace() {
    const glm::dvec3 eye(glm::inverse(motion_.view().view_from_world)[3]);
    const auto instances = truth::instances_of(motion_.scene());
    auto tracer = truth::Tracer::build(instances, eye);
    if (!tracer) return forward_error(tracer);
    for (std::uint32_t frame = 0; frame < options_.frames; ++frame) {
        tell(fmt::format("truth of frame {} of {}", frame + 1, options_.frames), 1.0);
        motion_.apply(frame);
        const Moment moment = motion_.moment();
        FrameTruth& pictures = truth_.emplace_back();
        for (const shadows::Light& light : moment.lights) {
            pictures.push_back(tracer->trace(moment.view, light,
                                             {.width = options_.width, .height = options_.height}));
        }
    }
    return {};
}

Status Measuring::choose() {
    auto entries = all_techniques();
    motion_.apply(0);
    const Setup setup{*stage_, subject_, motion_.bounds(), motion_.view(),
                      motion_.moment().lights.size()};
    for (Entry& entry : entries) {
        const bool named = std::find(options_.only.begin(), options_.only.end(), entry.name) !=
                           options_.only.end();
        const bool wanted = options_.only.empty() ? entry.quick || !options_.quick : named;
        // What all others are compared with is always there.
        if (!wanted && entry.name != "auto") continue;
        Contender& contender = contenders_.emplace_back();
        contender.row.technique = entry.name;
        contender.row.family = entry.family;
        contender.row.summary = entry.summary;
        contender.row.caveat = entry.caveat;
        contender.row.general = entry.general;
        auto technique = entry.create(setup);
        if (technique) {
            contender.technique = std::move(*technique);
        } else if (technique.error().code == ErrorCode::DeviceLost) {
            return forward_error(technique);
        } else {
            contender.row.skipped = technique.error().message;
        }
        contender.entry = std::move(entry);
    }
    return {};
}

void Measuring::judge(Contender& contender) {
    for (std::uint32_t frame = 0; frame < options_.frames; ++frame) {
        motion_.apply(frame);
        const Moment moment = motion_.moment();
        const bool last = frame + 1 == options_.frames;
        auto cost = contender.technique->frame(moment, last);
        if (!cost) return drop(contender, cost.error());
        auto masks = contender.technique->masks(moment.lights.size());
        if (!masks) return drop(contender, masks.error());
        truth::Judgement total;
        for (std::size_t i = 0; i < masks->size(); ++i) {
            const truth::Judgement judged = truth::judge(truth_[frame][i], (*masks)[i]);
            if (judged.wrong() > 0 && &contender == &contenders_.front()) {
                look_into(*contender.technique, moment, {frame, i}, judged);
            }
            total += judged;
        }
        contender.judgements.push_back(total);
        if (!last) continue;
        contender.row.layers = cost->layers;
        contender.row.mask = mask_thumbnail(truth_[frame], *masks);
        contender.row.difference = difference_thumbnail(truth_[frame], *masks);
    }
    contender.row.errors = errors_of(contender.judgements);
}

// Why `auto` is wrong there, or at least where that is.
void Measuring::look_into(Technique& technique, const Moment& moment, Mask of,
                          const truth::Judgement& judged) {
    wrong_of_auto_ += judged.wrong();
    for (const std::uint32_t& at : judged.wrong_pixels) {
        if (technique.edge_on(moment, of.light, {&at, 1}) > 0) {
            ++edge_on_of_auto_;
        } else if (unexplained_.size() < most_named) {
            unexplained_.push_back(fmt::format("({}, {}) of frame {} by light {}",
                                               at % options_.width, at / options_.width,
                                               of.frame + 1, of.light + 1));
        }
    }
}

bool Measuring::restart(Contender& contender) {
    if (!contender.technique) return false;
    if (const Status ready = contender.technique->restart(); !ready) {
        drop(contender, ready.error());
        return false;
    }
    return true;
}

// Milliseconds; empty where it failed. The first frame, where everything is new, does not count.
std::optional<double> Measuring::time_frame(Contender& contender, std::uint32_t frame) {
    if (!contender.technique) return std::nullopt;
    auto cost = contender.technique->frame(motion_.moment(), false);
    if (!cost) {
        drop(contender, cost.error());
        return std::nullopt;
    }
    if (frame > 0 || options_.frames == 1) {
        contender.frame_ms.push_back(cost->frame_ms);
        contender.detect_ms.push_back(cost->detect_ms);
        contender.build_ms.push_back(cost->build_ms);
        contender.record_ms.push_back(cost->record_ms);
        contender.upload_bytes.push_back(static_cast<double>(cost->upload_bytes));
    }
    return cost->frame_ms;
}

// The median frame; 0 where it failed.
double Measuring::time_alone(Contender& contender) {
    if (!restart(contender)) return 0.0;
    std::vector<double> frames;
    for (std::uint32_t frame = 0; frame < options_.frames; ++frame) {
        motion_.apply(frame);
        const auto ms = time_frame(contender, frame);
        if (!ms) return 0.0;
        if (frame > 0 || options_.frames == 1) frames.push_back(*ms);
    }
    return spread_of(frames).median;
}

// Frame by frame, so that what slows the machine down for a moment slows both.
void Measuring::time_beside_auto(Contender& contender, std::uint32_t round) {
    Contender& automatic = contenders_.front();
    if (!restart(automatic) || !restart(contender)) return;
    for (std::uint32_t frame = 0; frame < options_.frames; ++frame) {
        motion_.apply(frame);
        std::optional<double> own;
        std::optional<double> of_auto;
        const bool goes_first = (frame + round) % 2 == 0;
        if (goes_first) own = time_frame(contender, frame);
        of_auto = time_frame(automatic, frame);
        if (!goes_first) own = time_frame(contender, frame);
        if (!own || !of_auto) return;
        if (frame == 0 && options_.frames > 1) continue;
        contender.paired_ms.push_back(*own);
        contender.paired_ms_of_auto.push_back(*of_auto);
    }
}

// What is as little wrong as "auto" is timed in turn with it, frame by frame. The others are
// compared with its last median.
void Measuring::play_round(std::uint32_t round) {
    Contender& automatic = contenders_.front();
    const double of_auto = time_alone(automatic);
    for (std::size_t i = 0; i < contenders_.size(); ++i) {
        Contender& contender = contenders_[i];
        const bool is_extra = round >= options_.rounds;
        tell(fmt::format("round {}{}: {}", round + 1,
                         is_extra ? "" : fmt::format(" of {}", options_.rounds),
                         contender.row.technique),
             is_extra ? 0.0 : 1.0);
        if (i == 0 || !contender.technique) continue;
        if (automatic.technique &&
            contender.row.errors.wrong_worst <= automatic.row.errors.wrong_worst) {
            time_beside_auto(contender, round);
            continue;
        }
        // Of what is out of the question a rough time will do.
        constexpr std::uint32_t enough_rounds = 3;
        if (round >= enough_rounds &&
            ratio_of(contender.paired_ms, contender.paired_ms_of_auto).mean > 3.0) {
            continue;
        }
        contender.paired_ms.push_back(time_alone(contender));
        contender.paired_ms_of_auto.push_back(of_auto);
    }
}

void Measuring::play_rounds() {
    const auto start = Clock::now();
    for (rounds_ = 0; rounds_ < 10 * options_.rounds && !lost_; ++rounds_) {
        if (rounds_ >= options_.rounds &&
            milliseconds_since(start) >= 1000.0 * options_.least_seconds) {
            break;
        }
        play_round(rounds_);
    }
}

void Measuring::time_nothing() {
    std::vector<double> times;
    for (int i = 0; i < 30; ++i) {
        const auto start = Clock::now();
        if (const Status drawn = stage_->draw_nothing(); !drawn) {
            if (drawn.error().code == ErrorCode::DeviceLost) lost_ = drawn.error();
            return;
        }
        if (i >= 10) times.push_back(milliseconds_since(start));
    }
    empty_frame_ms_ = spread_of(times).median;
}

void Measuring::finish(Contender& contender) {
    Row& row = contender.row;
    if (!row.skipped.empty()) return;
    row.frame_ms = spread_of(contender.frame_ms);
    row.detect_ms = spread_of(contender.detect_ms);
    row.build_ms = spread_of(contender.build_ms);
    row.record_ms = spread_of(contender.record_ms);
    row.upload_bytes = static_cast<std::uint64_t>(spread_of(contender.upload_bytes).median);
    if (&contender != &contenders_.front()) {
        row.against_auto = ratio_of(contender.paired_ms, contender.paired_ms_of_auto);
    }
}

Result<Cell> Measuring::run() {
    motion_.apply(0);
    const Moment first = motion_.moment();
    if (first.lights.empty()) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{}: there is no light, so there is no shadow.", subject_.source));
    }
    if (motion_.bounds().empty()) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{}: there is nothing in the scene.", subject_.source));
    }
    if (motion_.view().projection != shadows::ProjectionKind::InfinitePerspective) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{}: the camera is orthographic; a report needs a perspective.",
                                subject_.source));
    }
    auto stage = Stage::create(device_, options_.width, options_.height);
    if (!stage) return forward_error(stage);
    stage_ = std::move(*stage);
    if (const Status done = stage_->upload(motion_.scene()); !done) return forward_error(done);
    if (const Status done = stage_->ensure_masks(first.lights.size()); !done) {
        return forward_error(done);
    }
    const auto techniques = static_cast<double>(
        options_.only.empty() ? technique_names(options_.quick).size() : options_.only.size() + 1);
    all_ = options_.frames + techniques * (options_.rounds + 1);
    if (const Status done = trace(); !done) return forward_error(done);
    if (const Status done = choose(); !done) return forward_error(done);

    // Judged first, which warms everything up; then timed in turn.
    for (Contender& contender : contenders_) {
        tell("judging " + contender.row.technique, 1.0);
        if (contender.technique) judge(contender);
    }
    play_rounds();
    time_nothing();
    if (lost_) return tl::unexpected(*lost_);
    Cell cell;
    cell.scene = subject_.name;
    cell.source = subject_.source;
    cell.kind = subject_.kind;
    cell.backend = device_.caps().backend;
    cell.adapter = device_.caps().adapter;
    cell.lights = first.lights.size();
    cell.rounds = rounds_;
    cell.empty_frame_ms = empty_frame_ms_;
    cell.notes = subject_.notes;
    if (edge_on_of_auto_ > 0) {
        cell.notes.push_back(fmt::format(
            "Of {} wrong pixel{} of auto in {} frames, {} lie{} where a side of a shadow volume "
            "is seen edge-on, to within 1/256 pixel. A rasteriser rounds corners to that and "
            "cannot place such a side in depth, so that any shadow volume may be wrong there.",
            wrong_of_auto_, wrong_of_auto_ == 1 ? "" : "s", options_.frames, edge_on_of_auto_,
            edge_on_of_auto_ == 1 ? "s" : ""));
    }
    if (!unexplained_.empty()) {
        cell.notes.push_back(fmt::format(
            "Wrong pixels of auto with no such side, x from the left and y from the top: {}{}.",
            fmt::join(unexplained_, "; "),
            unexplained_.size() == most_named ? "; and there may be more" : ""));
    }
    cell.truth = truth_thumbnail(truth_.back());
    subject_.scene.registry.each<scene::MeshInstance>(
        [&](scene::Entity entity, const scene::MeshInstance& instance) {
            cell.triangles += instance.mesh->triangle_count();
            if (subject_.scene.registry.has<scene::Caster>(entity)) ++cell.casters;
        });
    for (Contender& contender : contenders_) finish(contender);
    for (Contender& contender : contenders_) cell.rows.push_back(std::move(contender.row));
    return cell;
}

}  // namespace

std::string_view to_string(Kind kind) {
    switch (kind) {
        case Kind::Indoor: return "indoor";
        case Kind::Outdoor: return "outdoor";
        case Kind::Hero: return "hero";
        case Kind::Other: break;
    }
    return "other";
}

bool draws_in_software(std::string_view adapter) {
    std::string lower;
    for (const char c : adapter) {
        lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    for (const char* name : {"llvmpipe", "softpipe", "swiftshader", "lavapipe", "swrast"}) {
        if (lower.find(name) != std::string::npos) return true;
    }
    return false;
}

Result<Cell> measure(gpu::Device& device, Subject& subject, const Options& options,
                     const std::function<void(const Progress&)>& progress) {
    Measuring measuring(device, subject, options, progress);
    return measuring.run();
}

void keep_lights(Subject& subject, const Options& options, std::size_t most) {
    std::vector<scene::Entity> dropped;
    {
        const LightTurn motion(subject, options);
        dropped =
            render::choose_shadowed_lights(subject.scene, motion.bounds(), motion.view(), most)
                .unshadowed;
    }
    scene::Registry& registry = subject.scene.registry;
    for (const scene::Entity entity : dropped) {
        if (registry.has<scene::PointLight>(entity)) registry.remove<scene::PointLight>(entity);
        if (registry.has<scene::SpotLight>(entity)) registry.remove<scene::SpotLight>(entity);
        if (registry.has<scene::DirectionalLight>(entity)) {
            registry.remove<scene::DirectionalLight>(entity);
        }
    }
    if (!dropped.empty()) {
        subject.notes.push_back(
            fmt::format("{} of its lights are left out: the {} that matter most are measured.",
                        dropped.size(), most));
    }
}

}  // namespace gnomon::report
