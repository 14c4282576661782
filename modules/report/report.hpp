// SPDX-License-Identifier: MIT
//
// Report: speed against error. Every technique draws the same shadow masks of the same moving scene
// on the same device, in turn; each mask is held against the traced truth. What is timed is the
// way from poses to finished masks (the scene's depth, shadows, one mask a light) and no shading,
// so that techniques differ in nothing else.
//
// It is a measurement, not a renderer: the baselines in here (shadow maps, planar shadows, ray
// casting) are decent, and there to be compared with alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/machine/machine.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/truth/truth.hpp>

namespace gnomon::report {

/// What kind of place a scene is: what the page advises by.
enum class Kind : std::uint8_t { Indoor, Outdoor, Hero, Other };
[[nodiscard]] std::string_view to_string(Kind kind);

/// A scene and how it is looked at. World transforms up to date, at least one light.
struct Subject {
    std::string name;    ///< unique in a report
    std::string source;  ///< what the user calls it
    Kind kind = Kind::Other;
    scene::Scene scene;
    scene::Camera camera;
    glm::dmat4 world_from_camera{1.0};
    double near_m = 0.01;
    std::vector<std::string> notes = {};  ///< sentences for the reader
};

struct Options {
    std::uint32_t width = 640;
    std::uint32_t height = 360;
    std::uint32_t rounds = 5;  ///< each draws all frames with every technique once
    /// Frames of a fast device are short, and intervals wide: more rounds, up to ten times as
    /// many, until so much time was spent on timing. 0: none.
    double least_seconds = 0.0;
    std::uint32_t frames = 8;            ///< of the motion; all of them are judged
    double degrees_per_frame = 0.5;      ///< by which lights turn about the scene's middle
    bool quick = false;                  ///< the few techniques that a first look needs
    std::vector<std::string> only = {};  ///< names of techniques; empty: all
    std::string version = {};            ///< of gnomon, for the reader
    std::string build = {};  ///< names this program: cells that another one kept are not taken
};

/// Milliseconds, or anything else that was measured often. All zero where nothing was.
struct Spread {
    double median = 0.0;
    double p95 = 0.0;
    double low = 0.0;   ///< the least of all
    double high = 0.0;  ///< the most
};
/// Cost: a sort. Between ranks it is interpolated.
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// A ratio of times, from pairs that were measured one after the other.
struct Ratio {
    /// Geometric, without the fifth of the pairs at either end: what else runs on a machine slows
    /// single frames down.
    double mean = 1.0;
    /// 95 % interval, by Student's t over the logarithms; infinitely wide for fewer than two pairs.
    double low = 0.0;
    double high = 0.0;
};
/// `times` over `reference`, place by place; pairs with a time of 0 are left out.
[[nodiscard]] Ratio ratio_of(const std::vector<double>& times,
                             const std::vector<double>& reference);

/// Errors over the frames of the motion, all lights of a frame together.
struct Errors {
    std::uint64_t wrong_median = 0;  ///< pixels a frame, outside of the band
    std::uint64_t wrong_worst = 0;
    std::uint64_t false_shadow_worst = 0;
    std::uint64_t false_light_worst = 0;
    std::uint64_t wrong_at_all_median = 0;  ///< against the truth of pixels' centres, band included
    std::uint64_t wrong_at_all_worst = 0;
    double band_share = 0.0;            ///< of all pixels that have an answer
    double wrong_share_worst = 0.0;     ///< of the judged pixels
    double edge_displacement_px = 0.0;  ///< the largest; infinite where there is no such shadow
    double iou_worst = 1.0;             ///< over all decided pixels
    double iou_median = 1.0;
    [[nodiscard]] bool operator==(const Errors&) const = default;
};
/// `frames`: one judgement a frame. Cost: a sort.
[[nodiscard]] Errors errors_of(const std::vector<truth::Judgement>& frames);

/// A picture as a PNG file's bytes.
struct Thumbnail {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::byte> png;
};

/// What one technique did in one scene.
struct Row {
    std::string technique;
    std::string family;   ///< techniques of one family share a colour
    std::string summary;  ///< one sentence: what is done and what is given up
    std::string caveat;   ///< one sentence: why it is not the default although it may be faster
    /// Right, or as good as "auto", wherever the camera and the lights go: fit to be recommended.
    bool general = false;
    std::string skipped;  ///< why it was not measured; empty where it was
    Errors errors;
    Spread frame_ms;
    Spread detect_ms;
    Spread build_ms;
    Spread record_ms;
    /// Frame times over those of "auto": for what is as little wrong, frames right beside each
    /// other, in either order in turn; else medians of rounds. Exactly 1 for "auto".
    Ratio against_auto = {1.0, 1.0, 1.0};
    std::uint64_t upload_bytes = 0;  ///< a frame, median
    std::uint64_t layers = 0;        ///< most stencil layers over a pixel in the last frame
    Thumbnail mask;
    Thumbnail difference;
};

/// One scene on one backend.
struct Cell {
    std::string scene;
    std::string source;
    Kind kind = Kind::Other;
    std::string backend;
    std::string adapter;
    std::uint64_t triangles = 0;
    std::uint64_t casters = 0;
    std::uint64_t lights = 0;
    std::uint32_t rounds = 0;  ///< that were played
    /// What clearing a mask and waiting for the device takes, median: part of every time of what
    /// is drawn. 0 where it failed.
    double empty_frame_ms = 0.0;
    Thumbnail truth;
    std::vector<std::string> notes;
    std::vector<Row> rows;
};

/// A scene that a reader would look for.
struct LeftOut {
    std::string scene;
    std::string source;
    std::string reason;  ///< a clause: no capital, no full stop
};

struct Report {
    Options options;
    machine::Machine machine;
    std::string command;
    std::vector<Cell> cells;
    std::vector<LeftOut> left_out = {};
};

/// A program on the processor draws, as far as the adapter's name tells.
[[nodiscard]] bool draws_in_software(std::string_view adapter);

/// Steps done and to do, and what is being done.
struct Progress {
    double done = 0.0;  ///< 0..1
    std::string what;
};

/// One cell: every technique, `options.rounds` times in turn. The subject's lights are turned, and
/// are as they were in the end. Fails for a scene without lights or
/// with nothing in it, and as the device does; a technique that the device cannot draw is a row
/// that says so; a device that is lost fails. Cost: what it measures, and the truth: some seconds a
/// light and frame.
[[nodiscard]] Result<Cell> measure(gpu::Device& device, Subject& subject, const Options& options,
                                   const std::function<void(const Progress&)>& progress = {});

/// Names of all techniques, in the order of the rows.
[[nodiscard]] std::vector<std::string> technique_names(bool quick = false);

/// Leaves the `most` lights that bring most to what the camera looks at; the truth of each costs
/// seconds. Says so in the notes.
void keep_lights(Subject& subject, const Options& options, std::size_t most);

/// What a cell is kept under: a hash of all that determines it, program and machine included; 16
/// hexadecimal digits.
[[nodiscard]] std::string cell_key(const Subject& subject, const Options& options,
                                   const machine::Machine& machine, const std::string& backend,
                                   const std::string& adapter);

}  // namespace gnomon::report
