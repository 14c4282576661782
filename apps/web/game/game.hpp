// SPDX-License-Identifier: MIT
//
// The game behind its page: one level, its menus and what its head-up display shows, driven by
// orders in JSON and answering in JSON. Rules, menus and words are those of the window's game
// (apps/game); the page (page/game.js) owns the canvas, the loop, and everything that is text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include <gnomon/gpu/device.hpp>
#include <gnomon/input/input.hpp>

#include "drawing.hpp"
#include "play/hands.hpp"
#include "play/readout.hpp"
#include "play/screens.hpp"
#include "play/session.hpp"
#include "play/settings.hpp"
#include "play/stepper.hpp"

namespace gnomon::web {

class Game {
public:
    using Json = nlohmann::json;

    /// An order is an object whose member "do" is one of
    ///   levels  {}                     names of those that there are
    ///   level   {name, text, recording, settings, keeps_still, speed}
    ///                                  before the others, once: the level's file, the recording's
    ///                                  or null, and what "settings" answered earlier or null.
    ///                                  Answers what the pages say. `keeps_still`: nothing moves by
    ///                                  itself; `speed`: of what is watched
    ///   start   {}                     the device, or another one; answers its adapter
    ///   stop    {}                     forgets the device, for "start" with another one
    ///   size    {width, height, shown: [width, height], margins: [side, above, below], share,
    ///            samples}              in pixels of the screen, and in those of the page, with
    ///            what
    ///                                  of it is covered; how it is drawn: `share` of what the
    ///                                  settings allow of each side, and samples at most
    ///   watch   {}                     the recording, as its line in the title does
    ///   frame   {seconds, input, choice, draw}
    ///                                  (given_input.hpp) plays and shows; answers the state
    ///   replay  {}                     the recording at once, without pictures; answers outcome,
    ///                                  ticks and hash, and ends on the title
    /// The answer has a member "error", one sentence, where it was not done.
    [[nodiscard]] Json obey(const Json& order);

private:
    [[nodiscard]] Result<Json> done(const std::string& what, const Json& order);
    [[nodiscard]] Result<Json> take_level(const Json& order);
    [[nodiscard]] Result<Json> start();
    [[nodiscard]] Result<Json> frame(const Json& order);
    [[nodiscard]] Result<Json> replay();
    void take_size(const Json& order);

    [[nodiscard]] Status obey(const game::Order& order);
    [[nodiscard]] Status begin(bool follows_recording);
    [[nodiscard]] Status simulate(double seconds);
    [[nodiscard]] Status tick();
    void remember_win();
    [[nodiscard]] Status draw();
    [[nodiscard]] game::Look look() const;
    [[nodiscard]] shadows::View view() const;
    [[nodiscard]] game::DrawingOptions drawing_options() const;
    [[nodiscard]] bool is_title() const { return screens_.behind() == game::Screen::Title; }
    [[nodiscard]] bool waits() const { return !screens_.watches() && !is_under_way_; }

    [[nodiscard]] Json state();
    [[nodiscard]] Json menu() const;
    [[nodiscard]] Json display();
    [[nodiscard]] Json figures() const;

    std::optional<gpu::Device> device_;
    std::string complaint_;  // the first that the device had since the last answer
    std::optional<game::Level> level_;
    std::string name_;  // the level's, for recordings and wins
    std::optional<game::Recording> recording_;
    bool keeps_still_ = false;
    double speed_ = 1.0;

    game::Settings settings_;
    std::string settings_to_keep_;  // as text, until it was answered
    game::Screens screens_{game::ScreensDesc{}};
    std::optional<game::Session> session_;
    std::optional<game::Drawing> drawing_;
    game::Stepper stepper_;
    input::Input input_;
    game::Buttons buttons_;
    game::Look look_;

    glm::dvec2 shown_{640.0, 360.0};  // of the page, in its pixels
    game::Margins margins_;           // likewise
    glm::uvec2 most_px_{640, 360};    // of the screen
    double share_ = 1.0;              // of each side
    std::uint32_t most_samples_ = 4;

    bool is_under_way_ = false;
    double level_s_ = 0.0;     // since the level began
    double ended_s_ = -1.0;    // since what is watched ended; negative: it goes on
    std::uint32_t ticks_ = 0;  // of the last frame
    double rules_ms_ = 0.0;
    double frame_ms_ = 0.0;
};

}  // namespace gnomon::web
