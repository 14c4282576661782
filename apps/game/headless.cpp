// SPDX-License-Identifier: MIT
#include "headless.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "capture.hpp"
#include "devices.hpp"
#include "drawing.hpp"

namespace gnomon::game {

namespace {

class Camera {
public:
    explicit Camera(const CaptureOptions& options) : options_(options) {}

    Status open(World& world) {
        if (!options_.folder.empty()) {
            auto capture = Capture::into(options_.folder, options_.masks);
            if (!capture) return forward_error(capture);
            capture_.emplace(std::move(*capture));
        }
        auto device = cli::create_device({.backend = options_.backend});
        if (!device) return forward_error(device);
        device_.emplace(std::move(*device));
        const std::uint32_t limit = device_->caps().limits.max_texture_dimension_2d;
        if (options_.width > limit || options_.height > limit) {
            return fail(
                ErrorCode::InvalidInput,
                fmt::format("--size: {}x{} is larger than {} takes; its limit is {}.",
                            options_.width, options_.height, device_->caps().adapter, limit));
        }
        auto drawing = Drawing::create(
            *device_, world.stage(),
            {.width = options_.width, .height = options_.height, .samples = options_.samples});
        if (!drawing) return forward_error(drawing);
        drawing_.emplace(std::move(*drawing));
        return {};
    }

    Status take(World& world, std::size_t place, Ended& ended) {
        const double aspect = static_cast<double>(options_.width) / options_.height;
        const shadows::View view = follow(world.level(), world.player(), aspect);
        const auto start = std::chrono::steady_clock::now();
        const auto after_light =
            capture_ ? capture_->after_light(*drawing_) : std::function<Status(std::size_t)>();
        if (const Status drawn = drawing_->draw(world.stage(), world.level(), view, after_light);
            !drawn) {
            return drawn;
        }
        if (options_.times) {
            if (const Status finished = device_->wait_idle(); !finished) return finished;
            if (place > 0) {
                ended.times.frame.push_back(milliseconds_since(start));
                ended.times.shadows.push_back(drawing_->shadows_ms());
                ended.times.record.push_back(drawing_->renderer().times().record_ms);
            }
        }
        if (!capture_) return {};
        const Status kept = capture_->keep(*drawing_, place);
        ended.pictures = capture_->pictures();
        return kept;
    }

    [[nodiscard]] const std::string& adapter() const { return device_->caps().adapter; }

private:
    const CaptureOptions& options_;
    std::optional<gpu::Device> device_;
    std::optional<Drawing> drawing_;
    std::optional<Capture> capture_;
};

}  // namespace

Result<Ended> play(const Level& level, const Recording& recording, const CaptureOptions& capture) {
    auto world = World::create(level);
    if (!world) return forward_error(world);
    Camera camera(capture);
    const bool draws = !capture.folder.empty() || capture.times;
    Ended ended;
    if (draws) {
        if (const Status opened = camera.open(*world); !opened) return forward_error(opened);
        ended.adapter = camera.adapter();
        if (const Status taken = camera.take(*world, 0, ended); !taken) return forward_error(taken);
    }
    for (std::size_t i = 0; i < recording.inputs.size(); ++i) {
        const auto start = std::chrono::steady_clock::now();
        if (const Status done = world->tick(recording.inputs[i]); !done) return forward_error(done);
        const bool is_due = (i + 1) % capture.every == 0 || i + 1 == recording.inputs.size();
        if (!draws || !is_due) continue;
        if (capture.times) ended.times.tick.push_back(milliseconds_since(start));
        if (const Status taken = camera.take(*world, i + 1, ended); !taken) {
            return forward_error(taken);
        }
    }
    ended.outcome = world->outcome();
    ended.ticks = world->now();
    ended.hash = world->hash();
    return ended;
}

}  // namespace gnomon::game
