// SPDX-License-Identifier: MIT
#include "game/game.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <gnomon/webgpu/backend.hpp>

#include "frame_times.hpp"
#include "game/given_input.hpp"
#include "play/words.hpp"

namespace gnomon::web {

namespace {

using Json = Game::Json;
using game::Outcome;
using game::Screen;

constexpr std::uint32_t largest_size_px = 8192;
/// How long the end of a recording stands.
constexpr double end_stands_s = 2.5;
/// A picture that is higher than this is wide shows the level from farther away, so that there is
/// something to its sides.
constexpr double narrow_aspect = 1.2;
/// A light that alone makes as much of the meter is one of those that see.
constexpr double seeing_share = 0.1;

std::string_view name_of(Screen screen) {
    switch (screen) {
        case Screen::Title: return "title";
        case Screen::Playing: return "playing";
        case Screen::Paused: return "paused";
        case Screen::Won: return "won";
        case Screen::Caught: return "caught";
        case Screen::Settings: return "settings";
    }
    return "";
}

std::string_view name_of(Outcome outcome) {
    switch (outcome) {
        case Outcome::Playing: return "playing";
        case Outcome::Won: return "won";
        case Outcome::Caught: return "caught";
    }
    return "";
}

/// The text of a member; nothing where that is null or missing.
std::optional<std::string> text_of(const Json& order, const char* name) {
    const auto found = order.find(name);
    if (found == order.end() || !found->is_string()) return std::nullopt;
    return found->get<std::string>();
}

double number_of(const Json& order, const char* name, double otherwise) {
    const auto found = order.find(name);
    if (found == order.end() || !found->is_number()) return otherwise;
    const auto value = found->get<double>();
    return std::isfinite(value) ? value : otherwise;
}

/// Names of those lights that make the player seen, each once, brightest first.
Json seeing_lights(game::World& world) {
    const game::Stage& stage = world.stage();
    const std::vector<glm::dvec3> points = stage.player_points();
    std::vector<std::pair<double, std::string>> seeing;
    for (std::size_t l = 0; l < stage.lights().size(); ++l) {
        const game::MeterLight& light = stage.lights()[l];
        double share = 0.0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            if ((world.reading().reached[l] >> p & 1U) == 0) continue;
            share += std::min(game::illuminance(light, points[p]) / world.level().seen_lux, 1.0);
        }
        share /= static_cast<double>(points.size());
        if (share < seeing_share) continue;
        std::string name;
        if (light.shadow.position_world.w == 0.0) {
            const glm::vec3 color = world.level().sun->color;
            name = color.b > color.r ? "moonlight" : "sunlight";
        } else {
            stage.scene().registry.each<scene::Name>(
                [&](scene::Entity entity, const scene::Name& of) {
                    if (entity.key() == light.shadow.key) name = of.value;
                });
        }
        seeing.emplace_back(-share, std::move(name));
    }
    std::sort(seeing.begin(), seeing.end());
    Json names = Json::array();
    for (const auto& [share, name] : seeing) {
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

}  // namespace

Json Game::obey(const Json& order) {
    const std::string what = text_of(order, "do").value_or("");
    Result<Json> answer = done(what, order);
    Json json = answer ? std::move(*answer) : Json{{"error", answer.error().message}};
    if (!complaint_.empty() && !json.contains("error"))
        json["error"] = std::exchange(complaint_, {});
    return json;
}

Result<Json> Game::done(const std::string& what, const Json& order) {
    if (what == "levels") return Json{{"levels", game::playing_order}};
    if (what == "level") return take_level(order);
    if (!level_) {
        return fail(ErrorCode::InvalidInput, fmt::format("\"{}\" comes before \"level\".", what));
    }
    if (what == "start") return start();
    if (what == "stop") {
        drawing_.reset();
        device_.reset();
        return Json::object();
    }
    if (what == "size") {
        take_size(order);
        return Json::object();
    }
    if (what == "replay") return replay();
    if (what == "watch") {
        if (!recording_) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("There is no recording of {}.", level_->name));
        }
        if (const Status begun = obey(screens_.watch()); !begun) return forward_error(begun);
        return state();
    }
    if (what == "frame") return frame(order);
    return fail(ErrorCode::InvalidInput, fmt::format("There is no order \"{}\".", what));
}

Result<Json> Game::take_level(const Json& order) {
    name_ = text_of(order, "name").value_or("");
    if (!game::is_level_name(name_)) {
        return fail(ErrorCode::InvalidInput,
                    "A level's name is 1 to 60 letters, digits, \"-\" or \"_\".");
    }
    auto level = game::read_level(text_of(order, "text").value_or(""), name_ + ".json");
    if (!level) return forward_error(level);
    recording_.reset();
    if (const auto text = text_of(order, "recording")) {
        auto recording = game::read_recording(*text, name_ + ".replay");
        if (!recording) return forward_error(recording);
        if (recording->level != name_) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("{}.replay: the recording is of the level \"{}\".", name_,
                                    recording->level));
        }
        recording_ = std::move(*recording);
    }
    keeps_still_ = order.value("keeps_still", false);
    speed_ = std::clamp(number_of(order, "speed", 1.0), 0.1, 100.0);
    std::string complaint;
    if (const auto text = text_of(order, "settings")) {
        auto settings = game::read_settings(*text, "The settings that this browser has kept");
        if (settings) {
            settings_ = std::move(*settings);
        } else {
            complaint = settings.error().message;
        }
    }
    level_ = std::move(*level);
    screens_ =
        game::Screens({.levels = 1,
                       .can_watch = recording_.has_value(),
                       .can_quit = false,
                       .settings = {game::Setting::Scale, game::Setting::Samples,
                                    game::Setting::MouseSpeed, game::Setting::MouseInverted}});
    if (const Status begun = begin(true); !begun) return forward_error(begun);
    Json keys = Json::array();
    for (const game::KeyLine& line : game::key_lines) {
        if (!line.is_window) keys.push_back({line.keys, line.deed});
    }
    return Json{{"name", level_->name},
                {"hint", level_->hint},
                {"title", game::words::name},
                {"promise", game::words::promise},
                {"first_step", game::words::first_step},
                {"recording", game::words::recording},
                {"light", game::words::light},
                {"alarm", game::words::alarm},
                {"seen_from", game::Meter::seen_from},
                {"keys", std::move(keys)},
                {"complaint", complaint}};
}

Result<Json> Game::start() {
    auto backend =
        webgpu::create_backend({.message_sink = [this](gpu::Severity, std::string_view message) {
            if (complaint_.empty()) complaint_ = message;
        }});
    if (!backend) return forward_error(backend);
    drawing_.reset();
    device_.emplace(std::move(*backend));
    return Json{{"adapter", device_->caps().adapter}};
}

void Game::take_size(const Json& order) {
    const auto side = [&](const char* name) {
        return static_cast<std::uint32_t>(
            std::clamp(number_of(order, name, 1.0), 1.0, double{largest_size_px}));
    };
    most_px_ = {side("width"), side("height")};
    const auto numbers = [&](const char* name, std::size_t count) {
        const auto found = order.find(name);
        std::vector<double> values;
        if (found == order.end() || !found->is_array()) return values;
        for (const Json& value : *found)
            values.push_back(value.is_number() ? value.get<double>() : 0.0);
        if (values.size() != count) values.clear();
        return values;
    };
    const auto shown = numbers("shown", 2);
    shown_ = shown.empty() ? glm::dvec2(most_px_) : glm::dvec2(shown[0], shown[1]);
    shown_ = glm::clamp(shown_, 1.0, double{largest_size_px});
    if (const auto margins = numbers("margins", 3); !margins.empty()) {
        margins_ = {static_cast<float>(margins[0]), static_cast<float>(margins[1]),
                    static_cast<float>(margins[2])};
    }
    share_ = std::clamp(number_of(order, "share", 1.0), 0.05, 1.0);
    most_samples_ = number_of(order, "samples", 4.0) < 4.0 ? 1 : 4;
}

// Orders of the menus

Status Game::begin(bool follows_recording) {
    auto session = game::Session::begin(*level_, name_);
    if (!session) return forward_error(session);
    session_.emplace(std::move(*session));
    if (follows_recording) {
        // Where there is none, nobody moves.
        session_->follow(recording_ ? recording_->inputs : std::vector<game::Input>(6000));
    }
    drawing_.reset();
    look_ = {};
    stepper_ = game::Stepper(screens_.watches() ? speed_ : 1.0);
    level_s_ = 0.0;
    ended_s_ = -1.0;
    is_under_way_ = false;
    return {};
}

Status Game::obey(const game::Order& order) {
    using Kind = game::Order::Kind;
    switch (order.kind) {
        case Kind::None:
        case Kind::Quit: return {};  // which nothing here offers
        case Kind::Begin: return begin(false);
        case Kind::Watch:
        case Kind::Leave: return begin(true);
        case Kind::Restart: is_under_way_ = false; return session_->restart();
        case Kind::Change:
            settings_ = game::changed(std::move(settings_), order.setting, order.by);
            return {};
        case Kind::Save: settings_to_keep_ = game::to_text(settings_); return {};
    }
    return {};
}

void Game::remember_win() {
    if (std::find(settings_.won.begin(), settings_.won.end(), name_) != settings_.won.end()) return;
    settings_.won.push_back(name_);
    settings_to_keep_ = game::to_text(settings_);
}

// Frames

Status Game::tick() {
    ++ticks_;
    if (is_title()) {
        const bool is_done = session_->is_over() || session_->world().outcome() != Outcome::Playing;
        return is_done ? session_->restart() : session_->tick({});
    }
    const double yaw_rad = level_->camera.yaw_rad + look_.yaw_rad;
    const Status ticked = session_->tick(game::input_of(game::pad_of(input_), yaw_rad));
    if (!ticked) return ticked;
    const Outcome outcome = session_->world().outcome();
    if (screens_.watches()) {
        if (session_->is_over()) ended_s_ = 0.0;
        return {};
    }
    if (outcome == Outcome::Won) remember_win();
    screens_.ended(outcome);
    return {};
}

Status Game::simulate(double seconds) {
    ticks_ = 0;
    const bool plays = screens_.now() == Screen::Playing;
    if (!plays && (!is_title() || keeps_still_)) return {};
    if (plays) {
        level_s_ += seconds;
        look_ = game::turned(
            look_, level_->camera, input_,
            {.mouse_speed = settings_.mouse_speed, .inverted = settings_.mouse_inverted}, seconds);
        if (ended_s_ >= 0.0) {
            ended_s_ += seconds;
            return ended_s_ < end_stands_s ? Status() : obey(screens_.leave());
        }
        if (waits()) {
            // Whoever reads what the level has to say is not caught meanwhile.
            is_under_way_ = game::pad_of(input_) != game::Pad{};
            if (!is_under_way_) return {};
        }
    }
    const Screen before = screens_.now();
    for (std::uint32_t due = stepper_.advance(seconds); due > 0; --due) {
        if (const Status ticked = tick(); !ticked) return ticked;
        if (ended_s_ >= 0.0 || screens_.now() != before) break;
    }
    return {};
}

Result<Json> Game::frame(const Json& order) {
    const auto begin = std::chrono::steady_clock::now();
    const double seconds =
        std::clamp(number_of(order, "seconds", 0.0), 0.0, game::Stepper::longest_s);
    const auto given = order.find("input");
    take(given != order.end() ? *given : Json(), input_);
    buttons_.see(input_);
    game::MenuPress press = game::menu_press(input_, buttons_);
    if (const auto choice = order.find("choice"); choice != order.end())
        take_choice(*choice, press);
    if (const Status done = obey(screens_.press(press)); !done) return forward_error(done);
    if (const Status done = simulate(seconds); !done) return forward_error(done);
    rules_ms_ = game::milliseconds_since(begin);
    if (order.value("draw", true)) {
        if (const Status drawn = draw(); !drawn) return forward_error(drawn);
    }
    frame_ms_ = game::milliseconds_since(begin);
    return state();
}

Result<Json> Game::replay() {
    if (!recording_) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("There is no recording of {}.", level_->name));
    }
    if (const Status begun = begin(true); !begun) return forward_error(begun);
    while (!session_->is_over()) {
        if (const Status ticked = session_->tick({}); !ticked) return forward_error(ticked);
    }
    const game::World& world = session_->world();
    Json answer{{"outcome", name_of(world.outcome())},
                {"ticks", world.now()},
                {"hash", fmt::format("{:016x}", world.hash())}};
    if (const Status begun = begin(true); !begun) return forward_error(begun);
    return answer;
}

game::Look Game::look() const {
    game::Look look = look_;
    const double aspect = shown_.x / shown_.y;
    if (aspect < narrow_aspect) look.nearer *= std::sqrt(std::max(aspect, 0.25) / narrow_aspect);
    return look;
}

shadows::View Game::view() const {
    return game::follow(*level_, session_->world().player(), shown_.x / shown_.y, look());
}

game::DrawingOptions Game::drawing_options() const {
    const double scale = share_ * settings_.scale_percent / 100.0;
    const glm::dvec2 size = glm::round(glm::dvec2(most_px_) * scale);
    return {.width = static_cast<std::uint32_t>(std::max(size.x, 1.0)),
            .height = static_cast<std::uint32_t>(std::max(size.y, 1.0)),
            .samples = std::min(settings_.samples, most_samples_)};
}

Status Game::draw() {
    if (!device_) {
        return fail(ErrorCode::InvalidInput, "A frame is drawn after \"start\".");
    }
    game::Stage& stage = session_->world().stage();
    if (drawing_) {
        if (const Status done = drawing_->configure(drawing_options()); !done) return done;
    } else {
        auto drawing = game::Drawing::create(*device_, stage, drawing_options());
        if (!drawing) return forward_error(drawing);
        drawing_.emplace(std::move(*drawing));
    }
    if (const Status drawn = drawing_->draw(stage, *level_, view()); !drawn) return drawn;
    return device_->present(drawing_->renderer().picture());
}

// What is answered

Json Game::state() {
    Json answer{{"screen", name_of(screens_.now())},
                {"behind", name_of(screens_.behind())},
                {"watches", screens_.watches()},
                {"waits", screens_.now() == Screen::Playing && waits()},
                {"menu", menu()},
                {"display", display()},
                {"figures", figures()}};
    if (ended_s_ >= 0.0) {
        const game::World& world = session_->world();
        answer["ended"] = {{"outcome", name_of(world.outcome())},
                           {"ticks", world.now()},
                           {"hash", fmt::format("{:016x}", world.hash())}};
    }
    if (!settings_to_keep_.empty()) answer["settings"] = std::exchange(settings_to_keep_, {});
    return answer;
}

Json Game::menu() const {
    Screen screen = screens_.now();
    // The end of what is watched stands like that of a game, without a menu.
    if (ended_s_ >= 0.0) {
        const bool won = session_->world().outcome() == Outcome::Won;
        screen = won ? Screen::Won : Screen::Caught;
    }
    std::string words;
    if (screen == Screen::Won || screen == Screen::Caught) words = game::end_of(*session_);
    if (screen == Screen::Paused) {
        words = fmt::format("{}, {}", level_->name, game::clock_text(session_->world().now()));
    }
    Json lines = Json::array();
    for (const game::MenuItem& item : screens_.items()) {
        Json line{{"label", game::label_of(item, level_->name)}};
        if (item.kind == game::MenuItem::Kind::Setting)
            line["value"] = game::value_of(item.setting, settings_, "webgpu");
        if (item.kind == game::MenuItem::Kind::Level)
            line["won"] =
                std::find(settings_.won.begin(), settings_.won.end(), name_) != settings_.won.end();
        lines.push_back(std::move(line));
    }
    return Json{{"heading", game::heading_of(screen)},
                {"words", words},
                {"lines", std::move(lines)},
                {"selected", screens_.selected()}};
}

Json Game::display() {
    game::World& world = session_->world();
    const game::Meter& meter = world.meter();
    const game::Captions captions = game::captions_at(level_s_, waits(), keeps_still_);
    Json answer{
        {"clock", game::clock_text(world.now())},
        {"light", meter.light},
        {"alarm", meter.alarm},
        {"seen", meter.is_seen},
        {"tint", game::alarm_tint(meter)},
        {"by", seeing_lights(world)},
        {"captions",
         {{"name", captions.name}, {"hint", captions.hint}, {"first_step", captions.first_step}}},
        {"at", {world.player().at.x, world.player().at.y}},
        {"outcome", name_of(world.outcome())}};
    const auto mark = game::exit_mark(*level_, view(), glm::vec2(shown_), margins_);
    if (mark) {
        answer["exit"] = {{"x", mark->at.x}, {"y", mark->at.y}};
        if (mark->way) answer["exit"]["turn_rad"] = std::atan2(mark->way->y, mark->way->x);
    }
    return answer;
}

Json Game::figures() const {
    Json answer{{"ticks", ticks_}, {"rules_ms", rules_ms_}, {"frame_ms", frame_ms_}};
    if (!drawing_) return answer;
    const render::RendererDesc& drawn = drawing_->renderer().desc();
    answer["width"] = drawn.width;
    answer["height"] = drawn.height;
    answer["samples"] = drawn.sample_count;
    answer["shadows_ms"] = drawing_->shadows_ms();
    answer["record_ms"] = drawing_->renderer().times().record_ms;
    return answer;
}

}  // namespace gnomon::web
