// SPDX-License-Identifier: MIT
//
// gnomon render: frames of a scene, their masks and what they cost.
#include <chrono>
#include <cstdio>

#include <unistd.h>

#include <fmt/format.h>

#include <gnomon/render/camera.hpp>
#include <gnomon/render/light_choice.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/shadow_adapter.hpp>

#include "devices.hpp"
#include "files.hpp"
#include "motion.hpp"
#include "render_options.hpp"
#include "render_setup.hpp"
#include "stats_json.hpp"

namespace gnomon::cli {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// The stencil of every light and sample, as the last frame left it.
struct Mask {
    std::size_t light = 0;
    std::uint32_t sample = 0;
    std::vector<std::byte> counts;
};

class Run {
public:
    Run(const RenderOptions& options, Shot shot, gpu::Device device, shadows::ShadowSystem system)
        : options_(options),
          shot_(std::move(shot)),
          device_(std::move(device)),
          system_(std::move(system)) {}

    Status start();
    Status frame(std::uint32_t index, bool last);
    Status write_files();

private:
    Status read_masks(std::size_t light);
    // The null device counts as it draws: nothing.
    [[nodiscard]] bool meters() const {
        const gpu::Caps& caps = device_.caps();
        return options_.meter && caps.features.occlusion_query && caps.backend != "null";
    }

    const RenderOptions& options_;
    Shot shot_;
    gpu::Device device_;
    shadows::ShadowSystem system_;
    scene::ShadowAdapter adapter_;
    std::optional<render::Renderer> renderer_;
    std::optional<Animator> animator_;
    RunRecord record_;
    std::vector<Mask> masks_;
    std::optional<scene::Bounds> bounds_;  // of the scene as it first was
};

Status Run::start() {
    const auto averted_faces = options_.near_caps == shadows::NearCaps::Averted
                                   ? shadow_pass::AvertedFaces::LeftToShading
                                   : shadow_pass::AvertedFaces::Shadowed;
    auto renderer = render::Renderer::create(device_, {.width = options_.size.width,
                                                       .height = options_.size.height,
                                                       .sample_count = options_.samples,
                                                       .averted_faces = averted_faces,
                                                       .cull_back_faces = options_.cull_back,
                                                       .overlays = options_.overlays,
                                                       .meter_fill = meters()});
    if (!renderer) return forward_error(renderer);
    renderer_ = std::move(*renderer);
    animator_.emplace(shot_, options_.motion);
    record_.caps = device_.caps();
    record_.width = options_.size.width;
    record_.height = options_.size.height;
    record_.samples = options_.samples;
    shot_.scene.registry.each<scene::Receiver, scene::MeshInstance>(
        [&](scene::Entity, const scene::Receiver&, const scene::MeshInstance& instance) {
            record_.triangles += instance.mesh->triangle_count();
        });
    return renderer_->upload(shot_.scene);
}

Status Run::read_masks(std::size_t light) {
    for (std::uint32_t sample = 0; sample < options_.samples; ++sample) {
        auto counts = render::read_stencil(device_, *renderer_, sample);
        if (!counts) return forward_error(counts);
        masks_.push_back({light, sample, std::move(*counts)});
    }
    return {};
}

Status Run::frame(std::uint32_t index, bool last) {
    if (const Status moved = animator_->apply(index, shot_); !moved) {
        return fail(moved.error().code,
                    fmt::format("{}: {}", options_.scene, moved.error().message));
    }
    const auto start = Clock::now();
    const gpu::DeviceCounters before = device_.counters();
    FrameRecord record;

    const double aspect = static_cast<double>(options_.size.width) / options_.size.height;
    const shadows::View view =
        render::make_view(shot_.camera, shot_.world_from_camera, aspect, shot_.near_m);
    std::vector<scene::Entity> unshadowed;
    if (options_.max_shadowed_lights) {
        if (!bounds_) bounds_ = scene::world_bounds(shot_.scene);
        unshadowed = render::choose_shadowed_lights(shot_.scene, *bounds_, view,
                                                    *options_.max_shadowed_lights)
                         .unshadowed;
    }
    auto frame = system_.begin_frame();
    const Status submitted =
        adapter_.submit(shot_.scene, frame, options_.cull_back, options_.near_caps, unshadowed);
    if (!submitted) {
        return fail(submitted.error().code,
                    fmt::format("{}: {}", options_.scene, submitted.error().message));
    }
    const shadows::DrawList& list = std::move(frame).finish(view);

    double read_back_ms = 0.0;
    gpu::DeviceCounters read_back;
    std::function<Status(std::size_t)> after_light;
    if (last && !options_.stencil_prefix.empty()) {
        after_light = [&](std::size_t light) -> Status {
            if (const Status idle = device_.wait_idle(); !idle) return idle;
            const auto reading = Clock::now();
            const gpu::DeviceCounters before_reading = device_.counters();
            const Status read = read_masks(light);
            const gpu::DeviceCounters after_reading = device_.counters();
            read_back.uploaded_bytes +=
                after_reading.uploaded_bytes - before_reading.uploaded_bytes;
            read_back.draw_calls += after_reading.draw_calls - before_reading.draw_calls;
            read_back_ms += milliseconds_since(reading);
            return read;
        };
    }
    const render::FrameInput input{shot_.scene, view, list, after_light, unshadowed};
    if (const Status rendered = renderer_->render(input); !rendered) return rendered;
    const auto waiting = Clock::now();
    if (const Status idle = device_.wait_idle(); !idle) return idle;

    const gpu::DeviceCounters after = device_.counters();
    record.frame_ms = milliseconds_since(start) - read_back_ms;
    record.record_ms = renderer_->times().record_ms;
    record.submit_ms = renderer_->times().submit_ms + milliseconds_since(waiting);
    record.upload_bytes = after.uploaded_bytes - before.uploaded_bytes - read_back.uploaded_bytes;
    record.draw_calls = after.draw_calls - before.draw_calls - read_back.draw_calls;
    record.depth_bounded_draws = renderer_->shadow_stats().depth_bounded_draws;
    record.shadows = list.stats;
    if (meters()) {
        auto fill = renderer_->measure_fill();
        if (!fill) return forward_error(fill);
        record.fill = std::move(*fill);
    }
    record_.frames.push_back(record);
    return {};
}

Status Run::write_files() {
    OutputFiles files;
    if (!options_.out.empty()) {
        auto picture = device_.read_texture(renderer_->picture());
        if (!picture) return forward_error(picture);
        const Status added = files.add_png(options_.out, record_.width, record_.height, *picture);
        if (!added) return added;
    }
    for (const Mask& mask : masks_) {
        const std::string stem = fmt::format("{}.light{}", options_.stencil_prefix, mask.light);
        std::vector<std::string> names;
        if (mask.sample == 0) names.push_back(stem + ".pgm");
        if (options_.samples > 1) names.push_back(fmt::format("{}.s{}.pgm", stem, mask.sample));
        for (const std::string& name : names) {
            const Status added = files.add_pgm(name, record_.width, record_.height, mask.counts);
            if (!added) return added;
        }
    }
    if (!options_.stats.empty()) {
        if (const Status added = files.add(options_.stats, to_json(record_)); !added) return added;
    }
    return files.commit();
}

// Before any work is done for files that cannot be written.
Status check_outputs(const RenderOptions& options) {
    for (const auto& path : {options.out, options.stats}) {
        if (path.empty()) continue;
        if (const Status writable = check_writable(path); !writable) return writable;
    }
    if (options.stencil_prefix.empty()) return {};
    return check_writable(options.stencil_prefix + ".light0.pgm");
}

void show_progress(std::uint32_t done, std::uint32_t frames, Clock::time_point start) {
    const double seconds = milliseconds_since(start) / 1000.0;
    const double left = seconds / done * (frames - done);
    fmt::print(stderr, "\rframe {} of {}, {:.1f} s left \x1b[K", done, frames, left);
    if (done == frames) fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
}

}  // namespace

Status run_render(const RenderOptions& options) {
    auto system = shadows::ShadowSystem::create({.force_technique = options.technique,
                                                 .silhouette = options.silhouette,
                                                 .layer_bound = options.layer_bound,
                                                 .receivers = shadows::Receivers::Submitted,
                                                 .fill = options.fill});
    if (!system) return forward_error(system);
    if (const Status writable = check_outputs(options); !writable) return writable;
    auto shot = make_shot(options);
    if (!shot) return forward_error(shot);
    const std::vector<std::string> notes = shot->scene.messages;
    auto device = create_device({.backend = options.backend, .gl_stencil = options.gl_stencil});
    if (!device) return forward_error(device);
    const std::uint32_t limit = device->caps().limits.max_texture_dimension_2d;
    if (options.size.width > limit || options.size.height > limit) {
        return fail(
            ErrorCode::InvalidInput,
            fmt::format("--size: {}x{} is larger than {} takes; its limit is {}.",
                        options.size.width, options.size.height, device->caps().adapter, limit));
    }

    Run run(options, std::move(*shot), std::move(*device), std::move(*system));
    if (const Status started = run.start(); !started) return started;
    // Only now: a run that is refused says one sentence and nothing else.
    if (!options.quiet) {
        for (const std::string& note : notes) fmt::print(stderr, "{}\n", one_line(note));
    }
    const bool progress = options.frames > 1 && !options.quiet && ::isatty(STDERR_FILENO) != 0;
    const auto start = Clock::now();
    for (std::uint32_t i = 0; i < options.frames; ++i) {
        if (const Status drawn = run.frame(i, i + 1 == options.frames); !drawn) return drawn;
        if (progress) show_progress(i + 1, options.frames, start);
    }
    return run.write_files();
}

}  // namespace gnomon::cli
