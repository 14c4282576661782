// SPDX-License-Identifier: MIT
#include "peer.hpp"

#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>

#include <time.h>
#include <unistd.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <files.hpp>

namespace gnomon::peers {

namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Of all threads: what a frame costs whoever else wants the processor.
double processor_milliseconds() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

// Standard output as it was; from here on whatever engines print goes to standard error.
class Answers {
public:
    Answers() {
        std::fflush(stdout);
        file_ = ::fdopen(::dup(STDOUT_FILENO), "w");
        ::dup2(STDERR_FILENO, STDOUT_FILENO);
    }
    void send(const Json& answer) {
        fmt::print(file_, "{}\n", answer.dump(-1, ' ', false, Json::error_handler_t::replace));
        std::fflush(file_);
    }

private:
    std::FILE* file_;
};

class Session {
public:
    Session(Peer& peer, const PeerScene& scene, Size size)
        : peer_(peer), scene_(scene), size_(size) {}

    Result<Json> answer(const Json& command);

private:
    Status draw(const Json& command, std::int64_t frame, bool everything, bool dry);

    Peer& peer_;
    const PeerScene& scene_;
    Size size_;
};

Status Session::draw(const Json& command, std::int64_t frame, bool everything, bool dry) {
    const auto motion = motion_named(command.at("motion").get<std::string>());
    if (!motion) return forward_error(motion);
    for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
        const Instance& instance = scene_.instances[i];
        if (everything || (*motion == Motion::Casters && instance.moves))
            peer_.move_instance(i, pose_in(scene_, instance, *motion, frame));
    }
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
        if (everything || *motion == Motion::Lights || (*motion == Motion::Light && i == 0))
            peer_.move_light(i, light_in(scene_, i, *motion, frame));
    }
    return peer_.draw(command.at("shadows").get<bool>(), dry);
}

Result<Json> Session::answer(const Json& command) {
    const auto what = command.at("do").get<std::string>();
    const auto first = command.at("first").get<std::int64_t>();
    if (what == "picture") {
        if (const Status drawn = draw(command, first, true, false); !drawn)
            return forward_error(drawn);
        const auto picture = peer_.picture();
        if (!picture) return forward_error(picture);
        double sum = 0.0;
        for (std::size_t i = 0; i < picture->size(); ++i)
            sum += i % 4 == 3 ? 0.0 : std::to_integer<int>((*picture)[i]);
        const double mean = sum / (3.0 * size_.width * size_.height);
        cli::OutputFiles files;
        const Status added = files.add_png(command.at("file").get<std::string>(), size_.width,
                                           size_.height, *picture);
        if (!added) return forward_error(added);
        if (const Status written = files.commit(); !written) return forward_error(written);
        return Json{{"written", command.at("file")}, {"mean", mean}};
    }
    if (what != "frames")
        return fail(ErrorCode::InvalidInput, fmt::format("There is no command \"{}\".", what));
    const bool dry = command.at("dry").get<bool>();
    if (dry && !peer_.runs_dry())
        return fail(ErrorCode::Unsupported, "This peer has no dry frames.");
    const auto count = command.at("count").get<std::int64_t>();
    if (const Status warm = draw(command, first, true, dry); !warm) return forward_error(warm);
    Json times = Json::array();
    Json processor_times = Json::array();
    for (std::int64_t i = 1; i <= count; ++i) {
        const double processor_start = processor_milliseconds();
        const auto start = Clock::now();
        if (const Status drawn = draw(command, first + i, false, dry); !drawn)
            return forward_error(drawn);
        times.push_back(milliseconds_since(start));
        processor_times.push_back(processor_milliseconds() - processor_start);
    }
    return Json{{"ms", times}, {"processor_ms", processor_times}};
}

int serve(Answers& answers, const PeerScene& scene, Size size, const MakePeer& make) {
    const auto start = Clock::now();
    auto peer = make(scene, size);
    if (!peer) {
        const bool cannot = peer.error().code == ErrorCode::Unsupported;
        answers.send({{cannot ? "unsupported" : "error", peer.error().message}});
        return cannot ? 0 : 1;
    }
    Session session(**peer, scene, size);
    // What engines put off until they first draw belongs to the set-up.
    const auto first = session.answer({{"do", "frames"},
                                       {"motion", "static"},
                                       {"shadows", true},
                                       {"dry", false},
                                       {"first", 0},
                                       {"count", 0}});
    if (!first) {
        answers.send({{"error", first.error().message}});
        return 1;
    }
    Json hello = (*peer)->describe();
    hello["scene"] = scene.name;
    hello["casters"] = scene.caster_count();
    hello["lights"] = scene.lights.size();
    hello["triangles"] = scene.triangle_count();
    hello["dry"] = (*peer)->runs_dry();
    hello["setup_ms"] = milliseconds_since(start);
    answers.send(hello);
    for (std::string line; std::getline(std::cin, line);) {
        const Json command = Json::parse(line);
        const auto answer = session.answer(command);
        if (!answer) {
            answers.send({{"error", answer.error().message}});
            return 1;
        }
        answers.send(*answer);
    }
    return 0;
}

}  // namespace

int run_peer(int argc, char** argv, const MakePeer& make) {
    CLI::App app("Draws the shared scenes by one engine and answers commands with what they took.");
    std::string name;
    std::string size_text = "1280x720";
    app.add_option("--scene", name, "which of the shared scenes")->required();
    app.add_option("--size", size_text, "of the picture, in pixels");
    CLI11_PARSE(app, argc, argv);

    Answers answers;
    const auto refuse = [&](const std::string& why) {
        answers.send({{"error", why}});
        return 2;
    };
    Size size;
    if (std::sscanf(size_text.c_str(), "%ux%u", &size.width, &size.height) != 2 ||
        size.width - 1 > 8191 || size.height - 1 > 8191) {
        return refuse(
            fmt::format("--size: \"{}\" is not like 1280x720, up to 8192x8192.", size_text));
    }
    const auto scene = make_scene(name);
    if (!scene) return refuse(scene.error().message);
    try {  // engines and the JSON library throw
        return serve(answers, *scene, size, make);
    } catch (const std::exception& error) {
        answers.send({{"error", error.what()}});
        return 1;
    }
}

}  // namespace gnomon::peers
