// SPDX-License-Identifier: MIT
//
// Session: a level that is played, by whoever is there or by a recording, and what was pressed in
// it so far. It draws nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>

#include "recording.hpp"
#include "world.hpp"

namespace gnomon::game {

class Session {
public:
    /// Fails as World::create().
    [[nodiscard]] static Result<Session> begin(const Level& level, std::string name);

    /// From now on the inputs are these.
    void follow(std::vector<Input> inputs);
    [[nodiscard]] bool is_over() const {
        return follows_ && played_.inputs.size() >= script_.size();
    }

    /// A tick with this input, or with the recording's next one where it follows one; nothing when
    /// that is over. Fails as World::tick().
    [[nodiscard]] Status tick(const Input& input);
    /// The level anew; of one that follows a recording, from its first input.
    [[nodiscard]] Status restart();

    [[nodiscard]] World& world() { return world_; }
    [[nodiscard]] const World& world() const { return world_; }
    /// What was pressed: at most `most_ticks`, the first ones.
    [[nodiscard]] const Recording& played() const { return played_; }
    /// How many inputs there were, those that played() has no room for included.
    [[nodiscard]] std::uint64_t inputs() const { return inputs_; }
    /// Inputs are lost to played().
    [[nodiscard]] bool is_beyond_recording() const { return inputs_ > played_.inputs.size(); }
    /// The last input is the first one that is lost to played().
    [[nodiscard]] bool has_just_filled_recording() const {
        return inputs_ == played_.inputs.size() + 1;
    }
    /// The most that the alarm has come to since the level began.
    [[nodiscard]] double worst_alarm() const { return worst_alarm_; }
    [[nodiscard]] bool follows() const { return follows_; }

private:
    Session(World world, std::string name);

    World world_;
    Recording played_;
    std::uint64_t inputs_ = 0;
    std::vector<Input> script_;
    bool follows_ = false;
    double worst_alarm_ = 0.0;
};

}  // namespace gnomon::game
