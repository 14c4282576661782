// SPDX-License-Identifier: MIT
//
// Technique: one way to make the masks of a frame, and the table of all that are compared.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <gnomon/report/report.hpp>

#include "stage.hpp"

namespace gnomon::report::internal {

using Clock = std::chrono::steady_clock;
inline double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct FrameCost {
    double frame_ms = 0.0;  ///< from the first call until the device is idle
    double detect_ms = 0.0;
    double build_ms = 0.0;
    double record_ms = 0.0;  ///< uniforms, uploads, commands
    std::uint64_t upload_bytes = 0;
    std::uint64_t layers = 0;  ///< most of either sign, where it is asked for
};

/// Ends a frame that began at `start`, when the device had been given `uploaded` bytes.
[[nodiscard]] Result<FrameCost> draw_and_wait(gpu::Device& device, gpu::CommandEncoder& encoder,
                                              Clock::time_point start, std::uint64_t uploaded);

/// One byte a pixel, 0 where lit; one mask a light, in the order of Moment::lights.
using Masks = std::vector<std::vector<std::uint8_t>>;

class Technique {
public:
    virtual ~Technique() = default;
    /// The masks of this moment, complete when it returns. `look`: not timed; layers are counted.
    virtual Result<FrameCost> frame(const Moment& moment, bool look) = 0;
    [[nodiscard]] virtual Result<Masks> masks(std::size_t lights) = 0;
    /// Of these pixels of the last frame, y * width + x: how many are as they are because a side of
    /// a shadow volume is seen edge-on there (edge_on.hpp).
    [[nodiscard]] virtual std::size_t edge_on(const Moment& /*moment*/, std::size_t /*light*/,
                                              std::span<const std::uint32_t> /*pixels*/) const {
        return 0;
    }
    /// Forgets what it knew of earlier frames, so that a run starts as any other.
    virtual Status restart() { return {}; }
};

/// Of those that draw: the masks are the stage's.
class DrawnTechnique : public Technique {
public:
    explicit DrawnTechnique(Stage& stage) : stage_(stage) {}
    [[nodiscard]] Result<Masks> masks(std::size_t lights) override {
        return stage_.read_masks(lights);
    }

protected:
    Stage& stage_;
};

/// What a technique may need to know of the scene before the first frame.
struct Setup {
    Stage& stage;
    const Subject& subject;
    scene::Bounds bounds;
    shadows::View view;
    std::size_t lights = 0;
};

struct Entry {
    std::string name;
    std::string family;
    std::string summary;
    std::string caveat;
    bool quick = false;
    bool general = false;  ///< as Row::general
    std::function<Result<std::unique_ptr<Technique>>(const Setup&)> create;
};

/// All of them; the first is "auto".
[[nodiscard]] std::vector<Entry> all_techniques();

}  // namespace gnomon::report::internal
