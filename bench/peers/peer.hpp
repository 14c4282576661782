// SPDX-License-Identifier: MIT
//
// Peer: one engine that draws the shared scenes, and the program round it. A program holds one
// scene and answers commands, one JSON object a line on its standard input, each with one line on
// its standard output:
//
//   {"do": "frames", "motion": "lights", "shadows": true, "dry": false, "first": 0, "count": 3}
//       draws frame `first` to warm up and then `count` more, and says what each of these took:
//       "ms" by the clock and "processor_ms" of all threads
//   {"do": "picture", "motion": "static", "shadows": true, "first": 0, "file": "out.png"}
//       draws frame `first`, writes it and says how bright it is on the mean, of 255
//
// So programs of several engines can stand side by side and be measured in turns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <nlohmann/json.hpp>

#include <gnomon/core/result.hpp>

#include "scenes.hpp"

namespace gnomon::peers {

struct Size {
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
};

class Peer {
public:
    virtual ~Peer() = default;

    /// Poses of the next frame; what is told nothing stays where it is.
    virtual void move_instance(std::size_t instance, const glm::dmat4& world_from_local) = 0;
    virtual void move_light(std::size_t light, const glm::dvec4& position_world) = 0;
    /// One frame. Returns when the device has finished it. Dry: all is done but what the device
    /// would do: no draw, no clear reaches it, so that what remains is the processor's work.
    [[nodiscard]] virtual Status draw(bool shadows, bool dry) = 0;
    /// The last frame that was not dry: four bytes a pixel, row 0 on top.
    [[nodiscard]] virtual Result<std::vector<std::byte>> picture() = 0;
    /// Whether draw() can be dry.
    [[nodiscard]] virtual bool runs_dry() const { return true; }
    /// What it is and draws with: "engine", "device".
    [[nodiscard]] virtual nlohmann::ordered_json describe() const = 0;
};

using MakePeer = std::function<Result<std::unique_ptr<Peer>>(const PeerScene&, Size)>;

/// The main() of a peer: `PROGRAM --scene NAME [--size 1280x720]`. Its first line says what it is,
/// or, as {"unsupported": …}, why the engine cannot draw the scene. Ends with its input. Whatever
/// engines print goes to standard error.
[[nodiscard]] int run_peer(int argc, char** argv, const MakePeer& make);

}  // namespace gnomon::peers
