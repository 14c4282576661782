// SPDX-License-Identifier: MIT
//
// World: the simulation. A level, a tick, an input; no clock, no device, no picture. The same level
// and the same inputs give the same states, tick by tick, on every run of one build on one machine:
// the sines and cosines of another one's C library may round otherwise.
#pragma once

#include <cstdint>
#include <vector>

#include <gnomon/core/result.hpp>

#include "exposure.hpp"
#include "level.hpp"
#include "player.hpp"
#include "stage.hpp"
#include "timing.hpp"

namespace gnomon::game {

enum class Outcome : std::uint8_t { Playing, Won, Caught };

class World {
public:
    /// Fails as Stage::create().
    [[nodiscard]] static Result<World> create(const Level& level);

    /// One sixtieth of a second. Once won or caught nothing moves until a restart; a pause holds
    /// everything. Fails as Stage::pose().
    [[nodiscard]] Status tick(const Input& input);

    [[nodiscard]] Tick now() const { return now_; }  ///< since the level began
    [[nodiscard]] Outcome outcome() const { return outcome_; }
    [[nodiscard]] const Level& level() const { return level_; }
    [[nodiscard]] const Player& player() const { return player_; }
    [[nodiscard]] const Meter& meter() const { return meter_; }
    [[nodiscard]] const Reading& reading() const { return reading_; }
    /// The scene of this tick: for drawing.
    [[nodiscard]] Stage& stage() { return stage_; }

    /// FNV-1a over all that the rules know, rounded to tenths of millimetres and of thousandths,
    /// what the shadow queries answered included. To compare with others of one build on one
    /// machine.
    [[nodiscard]] std::uint64_t hash() const;

private:
    World(const Level& level, Stage stage);
    void restart();
    void move_doors();
    [[nodiscard]] double noise(const Input& input) const;
    [[nodiscard]] Status look();

    Level level_;
    Stage stage_;
    Tick now_ = 0;
    Outcome outcome_ = Outcome::Playing;
    Player player_;
    std::vector<double> doors_;  // how far each is open
    Meter meter_;
    Reading reading_;
    std::vector<Obstacle> obstacles_;  // of this tick
};

}  // namespace gnomon::game
