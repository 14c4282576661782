// SPDX-License-Identifier: MIT
#include "play/session.hpp"

#include <algorithm>
#include <utility>

namespace gnomon::game {

Session::Session(World world, std::string name) : world_(std::move(world)) {
    played_.level = std::move(name);
}

Result<Session> Session::begin(const Level& level, std::string name) {
    auto world = World::create(level);
    if (!world) return forward_error(world);
    return Session(std::move(*world), std::move(name));
}

void Session::follow(std::vector<Input> inputs) {
    script_ = std::move(inputs);
    played_.inputs.clear();
    inputs_ = 0;
    follows_ = true;
}

Status Session::tick(const Input& input) {
    if (is_over()) return {};
    const Input now = follows_ ? script_[played_.inputs.size()] : input;
    if (played_.inputs.size() < most_ticks) played_.inputs.push_back(now);
    ++inputs_;
    const Status done = world_.tick(now);
    worst_alarm_ = now.restart ? 0.0 : std::max(worst_alarm_, world_.meter().alarm);
    return done;
}

Status Session::restart() {
    if (!follows_) return tick({.restart = true});
    played_.inputs.clear();
    inputs_ = 0;
    worst_alarm_ = 0.0;
    return world_.tick({.restart = true});
}

}  // namespace gnomon::game
