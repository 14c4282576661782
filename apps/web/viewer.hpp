// SPDX-License-Identifier: MIT
//
// The viewer behind the page: the stage of `gnomon view`, its camera and what a pointer does to
// them, driven by orders in JSON and answering in JSON. The page (page/page.js) owns the canvas,
// the loop and everything that is text; it knows nothing of shadows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <gnomon/gpu/device.hpp>

#include "view/orbit_camera.hpp"
#include "view/stage.hpp"

namespace gnomon::web {

class Viewer {
public:
    using Json = nlohmann::json;

    /// An order is an object whose member "do" is one of
    ///   start    {}                               the device; answers adapter and features
    ///   stop     {}                               lets go of it; all else stays for "start"
    ///   scenes   {}                               names of the built-in scenes
    ///   load     {source, name}                   "builtin:NAME" or a file; the old scene stays
    ///                                             where it fails
    ///   size     {width, height}                  of the picture, in pixels
    ///   press    {x, y, pan, reach}               pixels, the last one how near a light must be;
    ///                                             answers what was caught
    ///   drag     {x, y, along_ground}
    ///   release  {}
    ///   zoom     {notches}
    ///   frame    {}                               all of the scene, from the standard view
    ///   look     {yaw_deg, pitch_deg}             the camera, round what it looks at
    ///   pan      {x, y}                           pixels that the picture goes along
    ///   push     {place, x, y, along_ground}      the light there, as if it were dragged so far
    ///   turn     {yaw_deg}                        the first light, about the scene's middle
    ///   light    {place, on}
    ///   options  {overlays, samples, technique, caps, ground}   those that are named
    ///   draw     {seconds, wait}                  plays, draws and shows; answers figures
    ///   measure  {technique, frames}              draws without debug views, waits, and
    ///                                             answers frame_ms of each; "none": no shadows
    ///   masks    {techniques, band_px}            as drawn by each: answers width, height,
    ///                                             samples, lights (how many) and bytes {job,
    ///                                             masks}: places and sizes, good until the next
    ///                                             order (truth_job.hpp)
    /// The answer has a member "error", one sentence, where it was not done.
    [[nodiscard]] Json obey(const Json& order);

private:
    struct Drag {
        bool pan = false;
        std::optional<std::size_t> light;
        glm::dvec2 at_px{0.0};
        scene::LocalTransform start_local = {};
        glm::dvec3 grabbed{0.0};
    };

    [[nodiscard]] Result<Json> done(const std::string& what, const Json& order);
    [[nodiscard]] Result<Json> start();
    [[nodiscard]] Result<Json> load(const Json& order);
    [[nodiscard]] Result<Json> press(const Json& order);
    [[nodiscard]] Result<Json> drag(const Json& order);
    [[nodiscard]] Result<Json> push(const Json& order);
    [[nodiscard]] Result<Json> turn(const Json& order);
    [[nodiscard]] Result<Json> options(const Json& order);
    [[nodiscard]] Result<Json> draw(const Json& order);
    [[nodiscard]] Result<Json> measure(const Json& order);
    [[nodiscard]] Result<Json> masks(const Json& order);
    [[nodiscard]] Result<std::size_t> light_of(const Json& order) const;
    [[nodiscard]] Drag drag_of(std::size_t light, glm::dvec2 at_px) const;
    [[nodiscard]] Json figures() const;
    void stop();
    [[nodiscard]] Status attach();
    [[nodiscard]] cli::Canvas canvas() const { return {size_px_, 0.0}; }

    std::optional<gpu::Device> device_;
    std::string complaint_;  // the first that the device had since the last answer
    std::optional<cli::Stage> stage_;
    cli::OrbitCamera camera_;
    shadows::View view_;
    glm::uvec2 size_px_{640, 360};
    std::optional<Drag> drag_;
    double time_s_ = 0.0;
    std::vector<std::uint8_t> job_;    // of the last "masks"
    std::vector<std::uint8_t> masks_;  // likewise
};

}  // namespace gnomon::web
