// SPDX-License-Identifier: MIT
//
// Drawing: a stage through a camera that follows the player, on any of gnomon's devices. It looks
// at the world and changes nothing there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/shadows/view.hpp>

#include "level.hpp"
#include "player.hpp"
#include "stage.hpp"

namespace gnomon::game {

/// How somebody has turned the camera, from what the level says.
struct Look {
    double yaw_rad = 0.0;
    double pitch_rad = 0.0;  ///< from farther above; the sum is kept between 20 and 85 degrees
    double nearer = 1.0;     ///< by this factor
};

/// Behind and above the player, with a little more of what is ahead in the picture. Near the border
/// of a level it stays over the level.
[[nodiscard]] shadows::View follow(const Level& level, const Player& player, double aspect,
                                   const Look& look = {});

struct DrawingOptions {
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint32_t samples = 4;  ///< 1 or 4
    render::Overlays overlays = {};
    std::optional<shadows::Technique> technique = std::nullopt;  ///< none: whichever is cheaper
    std::string silhouette = "auto";  ///< a name from shadows::silhouette_strategies(), or "auto"
    // Lights that are not as the scene has them, in the picture alone: the rules go by all of them.
    std::vector<scene::Entity> off = {};
    std::vector<scene::Entity> unshadowed = {};  ///< shine through everything
    bool operator==(const DrawingOptions&) const = default;
};

class Drawing {
public:
    /// The device must outlive it. Fails as Renderer::create() and Renderer::upload().
    [[nodiscard]] static Result<Drawing> create(gpu::Device& device, Stage& stage,
                                                const DrawingOptions& options);

    /// Goes on with other options, as if created with them; cheap where they are the same. Fails as
    /// create(); after that, draw with a new one.
    [[nodiscard]] Status configure(const DrawingOptions& options);

    /// One frame, submitted. `after_light` as FrameInput has it, but that it names a light by its
    /// place among all of the stage's, in the order of their keys, whichever are off.
    [[nodiscard]] Status draw(Stage& stage, const Level& level, const shadows::View& view,
                              const std::function<Status(std::size_t)>& after_light = {});

    /// Four bytes a pixel, row 0 on top. Waits for the device.
    [[nodiscard]] Result<std::vector<std::byte>> read_picture();
    /// What the stencil holds of a sample now, a byte a pixel, row 0 on top: in `after_light`, that
    /// light's count. Waits for the device.
    [[nodiscard]] Result<std::vector<std::byte>> read_mask(std::uint32_t sample);
    [[nodiscard]] const render::Renderer& renderer() const { return renderer_; }
    /// Of the last frame.
    [[nodiscard]] const shadows::FrameStats& shadow_stats() const { return stats_; }
    /// What the shadow system took of the last frame: poses, culling, silhouettes, volumes.
    [[nodiscard]] double shadows_ms() const { return shadows_ms_; }
    /// Of the last frame, until the next one; null before the first, and after a configure() that
    /// made another shadow system.
    [[nodiscard]] const shadows::DrawList* draw_list() const { return list_; }
    /// Of the last frame.
    [[nodiscard]] std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }
    [[nodiscard]] std::uint64_t draw_calls() const { return draw_calls_; }

private:
    Drawing(gpu::Device& device, const DrawingOptions& options, shadows::ShadowSystem system,
            render::Renderer renderer);

    gpu::Device* device_;
    DrawingOptions options_;
    shadows::ShadowSystem system_;
    render::Renderer renderer_;
    shadows::FrameStats stats_;
    double shadows_ms_ = 0.0;
    const shadows::DrawList* list_ = nullptr;  // the system's
    std::uint64_t uploaded_bytes_ = 0;
    std::uint64_t draw_calls_ = 0;
};

}  // namespace gnomon::game
