// SPDX-License-Identifier: MIT
#include "viewer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/scene/scene_description.hpp>
#include <gnomon/webgpu/backend.hpp>

#include "truth_job.hpp"
#include "view/mover.hpp"

namespace gnomon::web {

namespace {

using Json = Viewer::Json;

constexpr double radians_per_pixel = 0.008;
constexpr std::uint32_t largest_size_px = 8192;
constexpr int most_frames = 1000;
// The page holds them twice for a moment, here and as a copy.
constexpr std::size_t most_mask_mb = 512;

glm::dvec2 point_of(const Json& order) { return {order.value("x", 0.0), order.value("y", 0.0)}; }

std::optional<shadows::Technique> technique_named(const std::string& name) {
    if (name == "zpass") return shadows::Technique::DepthPass;
    if (name == "zfail") return shadows::Technique::DepthFail;
    return std::nullopt;
}

/// Another technique, and no debug views, for as long as this lives.
class Meanwhile {
public:
    explicit Meanwhile(cli::Stage& stage)
        : stage_(stage),
          technique_(stage.options().technique),
          overlays_(stage.options().overlays) {
        stage_.options().overlays = {};
    }
    Meanwhile(const Meanwhile&) = delete;
    Meanwhile& operator=(const Meanwhile&) = delete;
    ~Meanwhile() {
        stage_.options().technique = technique_;
        stage_.options().overlays = overlays_;
        stage_.shadows_changed();
    }
    void draw_by(std::optional<shadows::Technique> technique) {
        stage_.options().technique = technique;
        stage_.shadows_changed();
    }

private:
    cli::Stage& stage_;
    std::optional<shadows::Technique> technique_;
    render::Overlays overlays_;
};

Json numbers(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

Json one_of(const std::string& name) { return Json{{"name", name}}; }

}  // namespace

Json Viewer::obey(const Json& order) {
    const std::string what = order.value("do", "");
    // They may be larger than all else.
    std::vector<std::uint8_t>().swap(job_);
    std::vector<std::uint8_t>().swap(masks_);
    Result<Json> answer = done(what, order);
    Json json = answer ? std::move(*answer) : Json{{"error", answer.error().message}};
    if (!complaint_.empty() && !json.contains("error"))
        json["error"] = std::exchange(complaint_, {});
    return json;
}

Result<Json> Viewer::done(const std::string& what, const Json& order) {
    if (what == "start") return start();
    if (what == "stop") {
        stop();
        return Json::object();
    }
    if (what == "scenes") return Json{{"scenes", scene::builtin_scene_names()}};
    if (!device_) {
        return fail(ErrorCode::InvalidInput, fmt::format("\"{}\" comes before \"start\".", what));
    }
    if (what == "load") return load(order);
    if (what == "size") {
        const auto side = [&](const char* name) {
            return static_cast<std::uint32_t>(
                std::clamp(order.value(name, 1.0), 1.0, double{largest_size_px}));
        };
        size_px_ = {side("width"), side("height")};
        return Json::object();
    }
    if (!stage_) {
        return fail(ErrorCode::InvalidInput, fmt::format("\"{}\" comes before \"load\".", what));
    }
    if (!stage_->has_device()) {
        return fail(ErrorCode::Internal, "The scene could not be brought onto this device.");
    }
    if (what == "press") return press(order);
    if (what == "drag") return drag(order);
    if (what == "push") return push(order);
    if (what == "turn") return turn(order);
    if (what == "options") return options(order);
    if (what == "draw") return draw(order);
    if (what == "measure") return measure(order);
    if (what == "masks") return masks(order);
    if (what == "release") {
        drag_.reset();
        return Json::object();
    }
    if (what == "zoom") {
        camera_.zoom(order.value("notches", 0.0));
        return Json::object();
    }
    if (what == "frame") {
        camera_.frame(stage_->shot().bounds, canvas(), true);
        return Json::object();
    }
    if (what == "look") {
        camera_.orbit(glm::radians(order.value("yaw_deg", 0.0)),
                      glm::radians(order.value("pitch_deg", 0.0)));
        return Json::object();
    }
    if (what == "pan") {
        camera_.pan(point_of(order), canvas());
        return Json::object();
    }
    if (what == "light") {
        const auto place = light_of(order);
        if (!place) return forward_error(place);
        stage_->lights()[*place].on = order.value("on", true);
        return Json::object();
    }
    return fail(ErrorCode::InvalidInput, fmt::format("There is no order \"{}\".", what));
}

Result<Json> Viewer::start() {
    auto backend =
        webgpu::create_backend({.message_sink = [this](gpu::Severity, std::string_view message) {
            if (complaint_.empty()) complaint_ = message;
        }});
    if (!backend) return forward_error(backend);
    stop();
    device_.emplace(std::move(*backend));
    if (stage_) {
        if (const Status attached = attach(); !attached) return forward_error(attached);
    }
    const gpu::Caps& caps = device_->caps();
    return Json{{"adapter", caps.adapter},
                {"unclipped_depth", caps.features.unclipped_depth},
                {"timestamps", caps.features.timestamp_query}};
}

void Viewer::stop() {
    if (stage_) stage_->drop_device();
    device_.reset();
}

Status Viewer::attach() { return stage_->set_device(*device_, size_px_); }

Result<Json> Viewer::load(const Json& order) {
    cli::RenderOptions options;
    if (stage_) options = stage_->options();
    options.scene = order.value("source", "");
    options.size = {size_px_.x, size_px_.y};
    auto loaded = cli::Stage::load(options);
    if (!loaded) return forward_error(loaded);
    const bool ground = stage_ && stage_->has_ground();
    drag_.reset();
    if (stage_) stage_->drop_device();
    stage_.emplace(std::move(*loaded));
    time_s_ = 0.0;
    if (ground) stage_->show_ground(true);
    const cli::Shot& shot = stage_->shot();
    camera_ = cli::OrbitCamera(shot.camera, shot.world_from_camera, shot.near_m, shot.bounds);
    // What moves, plays.
    std::vector<std::size_t> all(shot.scene.animations.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    if (!all.empty()) all.resize(1);
    stage_->play(std::move(all));
    if (const Status attached = attach(); !attached) return forward_error(attached);
    Json lights = Json::array();
    for (const panel::LightLine& light : stage_->lights()) lights.push_back(one_of(light.name));
    return Json{{"triangles", stage_->triangles()},
                {"lights", std::move(lights)},
                {"animated", stage_->duration_s() > 0.0},
                {"messages", shot.scene.messages}};
}

Result<std::size_t> Viewer::light_of(const Json& order) const {
    const std::size_t place = order.value("place", std::size_t{0});
    if (place < stage_->lights().size()) return place;
    return fail(ErrorCode::InvalidInput, fmt::format("There is no light {}: the scene has {}.",
                                                     place, stage_->lights().size()));
}

Viewer::Drag Viewer::drag_of(std::size_t light, glm::dvec2 at_px) const {
    const panel::LightLine& held = stage_->lights()[light];
    return {.light = light,
            .at_px = at_px,
            .start_local = stage_->shot().scene.registry.get<scene::LocalTransform>(held.entity),
            .grabbed = stage_->handle_of(held)};
}

Result<Json> Viewer::press(const Json& order) {
    const bool pan = order.value("pan", false);
    const glm::dvec2 at_px = point_of(order);
    const auto light = stage_->light_under(view_, size_px_, at_px, order.value("reach", 16.0));
    drag_ = !pan && light ? drag_of(*light, at_px) : Drag{.pan = pan, .at_px = at_px};
    return Json{{"caught", drag_->light ? "light" : "camera"}};
}

Result<Json> Viewer::push(const Json& order) {
    const auto place = light_of(order);
    if (!place) return forward_error(place);
    const auto from = panel::pixel_of(view_, stage_->handle_of(stage_->lights()[*place]), size_px_);
    if (!from) return Json::object();
    drag_ = drag_of(*place, *from);
    const glm::dvec2 to = *from + point_of(order);
    const auto moved =
        drag({{"x", to.x}, {"y", to.y}, {"along_ground", order.value("along_ground", false)}});
    drag_.reset();
    return moved;
}

Result<Json> Viewer::drag(const Json& order) {
    if (!drag_) return Json::object();
    const glm::dvec2 now = point_of(order);
    const glm::dvec2 motion = now - drag_->at_px;
    if (!drag_->light) {
        drag_->at_px = now;
        if (drag_->pan) {
            camera_.pan(motion, canvas());
        } else {
            // As far as a picture of 720 pixels would be turned, whatever the screen's pixels.
            const double scale = radians_per_pixel * 720.0 / std::max(1U, size_px_.y);
            camera_.orbit(-motion.x * scale, -motion.y * scale);
        }
        return Json::object();
    }
    const panel::LightLine& light = stage_->lights()[*drag_->light];
    const glm::dvec3 normal =
        order.value("along_ground", false) ? glm::dvec3(0.0, 1.0, 0.0) : -camera_.forward();
    const auto way =
        cli::dragged_in_plane(panel::ray_through(view_, now, size_px_), drag_->grabbed, normal);
    if (!way) return Json::object();
    glm::dmat4 moved = glm::translate(glm::dmat4(1.0), *way);
    if (panel::is_directional(stage_->shot().scene.registry, light.entity)) {
        const scene::Bounds& all = stage_->shot().bounds;
        const glm::dvec3 pivot = all.empty() ? glm::dvec3(0.0) : all.center();
        moved = cli::turned_towards(pivot, drag_->grabbed - pivot, drag_->grabbed + *way - pivot);
    }
    if (const Status done = stage_->move(light.entity, drag_->start_local, moved); !done) {
        return forward_error(done);
    }
    return Json::object();
}

Result<Json> Viewer::turn(const Json& order) {
    if (stage_->lights().empty()) return Json::object();
    const panel::LightLine& light = stage_->lights().front();
    const scene::Bounds& all = stage_->shot().bounds;
    const glm::dvec3 pivot = all.empty() ? glm::dvec3(0.0) : all.center();
    const glm::dmat4 motion =
        cli::turned_about(pivot, {1.0, 0.0, 0.0}, glm::radians(order.value("yaw_deg", 0.0)), 0.0);
    const auto start = stage_->shot().scene.registry.get<scene::LocalTransform>(light.entity);
    if (const Status done = stage_->move(light.entity, start, motion); !done) {
        return forward_error(done);
    }
    return Json::object();
}

Result<Json> Viewer::options(const Json& order) {
    cli::RenderOptions& options = stage_->options();
    if (const auto overlays = order.find("overlays"); overlays != order.end()) {
        const auto read = [&](const char* name, bool& value) {
            value = overlays->value(name, value);
        };
        read("volumes", options.overlays.volumes);
        read("silhouettes", options.overlays.silhouettes);
        read("caps", options.overlays.caps);
        read("wireframe", options.overlays.wireframe);
        read("count", options.overlays.count);
        read("fill", options.overlays.fill);
    }
    if (order.contains("samples")) options.samples = order["samples"] == 4 ? 4 : 1;
    if (order.contains("technique")) {
        options.technique = technique_named(order.value("technique", "auto"));
        stage_->shadows_changed();
    }
    if (order.contains("ground")) stage_->show_ground(order.value("ground", false));
    return Json::object();
}

Result<Json> Viewer::draw(const Json& order) {
    const double seconds = order.value("seconds", 0.0);
    if (seconds != 0.0 && stage_->duration_s() > 0.0) {
        time_s_ += seconds;
        if (const Status posed = stage_->set_time(time_s_); !posed) return forward_error(posed);
    }
    stage_->wait_for_device(order.value("wait", false));
    view_ = camera_.view(canvas());
    if (const Status drawn = stage_->draw(view_, size_px_); !drawn) return forward_error(drawn);
    if (order.value("show", true)) {
        if (const Status shown = device_->present(stage_->picture()); !shown) {
            return forward_error(shown);
        }
    }
    return figures();
}

Result<Json> Viewer::measure(const Json& order) {
    const std::string technique = order.value("technique", "auto");
    const int frames = std::clamp(order.value("frames", 1), 1, most_frames);
    Meanwhile meanwhile(*stage_);
    meanwhile.draw_by(technique_named(technique));
    const std::vector<panel::LightLine> lights = stage_->lights();
    if (technique == "none") {
        for (panel::LightLine& light : stage_->lights()) light.casts = false;
    }
    stage_->wait_for_device(true);
    view_ = camera_.view(canvas());
    Json frame_ms = Json::array();
    Status drawn;
    // The first one finds what the others know.
    for (int frame = -1; frame < frames && drawn; ++frame) {
        drawn = stage_->draw(view_, size_px_);
        if (drawn && frame >= 0) frame_ms.push_back(stage_->figures().frame_ms);
    }
    stage_->lights() = lights;
    if (!drawn) return forward_error(drawn);
    return Json{{"frame_ms", std::move(frame_ms)}};
}

Result<Json> Viewer::masks(const Json& order) {
    Meanwhile meanwhile(*stage_);
    view_ = camera_.view(canvas());
    TruthJob job = job_of(truth::instances_of(stage_->shot().scene));
    job.width = size_px_.x;
    job.height = size_px_.y;
    job.samples = stage_->options().samples;
    job.band_px = order.value("band_px", job.band_px);
    job.view = view_;
    const Json techniques = order.value("techniques", Json::array());
    const auto casting = std::ranges::count_if(
        stage_->lights(), [](const panel::LightLine& light) { return light.on && light.casts; });
    const std::size_t bytes = std::size_t{job.width} * job.height * job.samples *
                              static_cast<std::size_t>(casting) * techniques.size();
    if (bytes > most_mask_mb * 1'000'000) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The masks of this view take {} MB, and the limit is {}: check a "
                                "smaller window, or one sample.",
                                bytes / 1'000'000, most_mask_mb));
    }
    masks_.reserve(bytes);
    for (const Json& technique : techniques) {
        meanwhile.draw_by(technique_named(technique.get<std::string>()));
        const auto drawn = stage_->draw_masks(view_, size_px_);
        if (!drawn) return forward_error(drawn);
        job.lights.clear();
        for (const cli::LightMask& mask : *drawn) {
            job.lights.push_back(mask.light);
            for (const std::vector<std::byte>& sample : mask.samples) {
                const auto* bytes = reinterpret_cast<const std::uint8_t*>(sample.data());
                masks_.insert(masks_.end(), bytes, bytes + sample.size());
            }
        }
    }
    if (job.lights.empty()) {
        return fail(ErrorCode::InvalidInput,
                    "No light that casts shadows is on, so there is nothing to check.");
    }
    job_ = write_job(job);
    const auto place = [](const std::vector<std::uint8_t>& bytes) {
        return Json::array({reinterpret_cast<std::uintptr_t>(bytes.data()), bytes.size()});
    };
    return Json{{"width", job.width},
                {"height", job.height},
                {"samples", job.samples},
                {"lights", job.lights.size()},
                {"bytes", {{"job", place(job_)}, {"masks", place(masks_)}}}};
}

Json Viewer::figures() const {
    const cli::FrameFigures& f = stage_->figures();
    Json reasons = Json::object();
    for (std::size_t i = 0; i < shadows::reason_count; ++i) {
        if (f.shadows.reasons[i] == 0) continue;
        const auto reason = static_cast<shadows::Reason>(i);
        reasons[std::string(shadows::to_string(reason))] = f.shadows.reasons[i];
    }
    Json lights = Json::array();
    for (const panel::LightLine& light : stage_->lights()) {
        const auto pixel = panel::pixel_of(view_, stage_->handle_of(light), size_px_);
        const bool sun = panel::is_directional(stage_->shot().scene.registry, light.entity);
        lights.push_back(pixel ? Json{{"x", pixel->x}, {"y", pixel->y}, {"sun", sun}} : Json());
    }
    return Json{{"detect_ms", f.detect_ms},
                {"build_ms", f.build_ms},
                {"record_ms", f.record_ms},
                {"device_ms", f.device_ms},
                {"frame_ms", f.frame_ms},
                {"upload_bytes", f.upload_bytes},
                {"draw_calls", f.draw_calls},
                {"pairs", f.shadows.pairs},
                {"pairs_redetected", f.shadows.pairs_redetected},
                {"pairs_reused", f.shadows.pairs_reused},
                {"pairs_culled", f.shadows.pairs_culled},
                {"zpass_pairs", f.shadows.zpass_pairs},
                {"zfail_pairs", f.shadows.zfail_pairs},
                {"silhouette_edges", f.shadows.silhouette_edges},
                {"eye", numbers(camera_.eye())},
                {"pivot", numbers(camera_.pivot())},
                {"reasons", std::move(reasons)},
                {"lights", std::move(lights)}};
}

}  // namespace gnomon::web
