// SPDX-License-Identifier: MIT
//
// Cells that are kept: what they are kept under, and as what.
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include <gnomon/report/writers.hpp>

#include "internal/json_forms.hpp"
#include "internal/technique.hpp"

namespace gnomon::report {

namespace internal {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::vector<std::byte> from_base64(const std::string& text) {
    std::vector<std::byte> bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const std::size_t value = digits.find(c);
        if (value == std::string_view::npos) break;
        bits = bits << 6U | static_cast<std::uint32_t>(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<std::byte>(bits >> count & 0xFFU));
    }
    return bytes;
}

// JSON has no infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
double number_from(const Json& json) {
    return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

Json json_of(const Spread& s) {
    return {{"median", s.median}, {"p95", s.p95}, {"low", s.low}, {"high", s.high}};
}
Spread spread_from(const Json& json) {
    return {json.at("median"), json.at("p95"), json.at("low"), json.at("high")};
}

Json json_of(const Thumbnail& t) {
    return {{"width", t.width}, {"height", t.height}, {"png", base64(t.png)}};
}
Thumbnail thumbnail_from(const Json& json) {
    return {json.at("width"), json.at("height"), from_base64(json.at("png"))};
}

Json json_of(const Errors& e) {
    return {{"wrong_median", e.wrong_median},
            {"wrong_worst", e.wrong_worst},
            {"false_shadow_worst", e.false_shadow_worst},
            {"false_light_worst", e.false_light_worst},
            {"wrong_at_all_median", e.wrong_at_all_median},
            {"wrong_at_all_worst", e.wrong_at_all_worst},
            {"band_share", e.band_share},
            {"wrong_share_worst", e.wrong_share_worst},
            {"edge_displacement_px", number(e.edge_displacement_px)},
            {"iou_worst", e.iou_worst},
            {"iou_median", e.iou_median}};
}
Errors errors_from(const Json& json) {
    return {json.at("wrong_median"),
            json.at("wrong_worst"),
            json.at("false_shadow_worst"),
            json.at("false_light_worst"),
            json.at("wrong_at_all_median"),
            json.at("wrong_at_all_worst"),
            json.at("band_share"),
            json.at("wrong_share_worst"),
            number_from(json.at("edge_displacement_px")),
            json.at("iou_worst"),
            json.at("iou_median")};
}

Json json_of(const Row& row, bool with_thumbnails) {
    Json json{{"technique", row.technique},
              {"family", row.family},
              {"summary", row.summary},
              {"caveat", row.caveat},
              {"general", row.general}};
    if (!row.skipped.empty()) {
        json["skipped"] = row.skipped;
        return json;
    }
    json["errors"] = json_of(row.errors);
    json["frame_ms"] = json_of(row.frame_ms);
    json["detect_ms"] = json_of(row.detect_ms);
    json["build_ms"] = json_of(row.build_ms);
    json["record_ms"] = json_of(row.record_ms);
    json["against_auto"] = {{"mean", row.against_auto.mean},
                            {"low", row.against_auto.low},
                            {"high", number(row.against_auto.high)}};
    json["upload_bytes"] = row.upload_bytes;
    json["layers"] = row.layers;
    if (with_thumbnails) {
        json["mask"] = json_of(row.mask);
        json["difference"] = json_of(row.difference);
    }
    return json;
}

Row row_from(const Json& json) {
    Row row;
    row.technique = json.at("technique");
    row.family = json.at("family");
    row.summary = json.at("summary");
    row.caveat = json.at("caveat");
    row.general = json.at("general");
    if (json.contains("skipped")) {
        row.skipped = json.at("skipped");
        return row;
    }
    row.errors = errors_from(json.at("errors"));
    row.frame_ms = spread_from(json.at("frame_ms"));
    row.detect_ms = spread_from(json.at("detect_ms"));
    row.build_ms = spread_from(json.at("build_ms"));
    row.record_ms = spread_from(json.at("record_ms"));
    const Json& ratio = json.at("against_auto");
    row.against_auto = {ratio.at("mean"), ratio.at("low"), number_from(ratio.at("high"))};
    row.upload_bytes = json.at("upload_bytes");
    row.layers = json.at("layers");
    row.mask = thumbnail_from(json.at("mask"));
    row.difference = thumbnail_from(json.at("difference"));
    return row;
}

}  // namespace

std::string base64(const std::vector<std::byte>& bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U;
        };
        const std::uint32_t bits = byte(0) << 16U | byte(1) << 8U | byte(2);
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? digits[bits >> (18U - 6U * k) & 63U] : '=';
        }
    }
    return text;
}

Json json_of(const Cell& cell, bool with_thumbnails) {
    Json rows = Json::array();
    for (const Row& row : cell.rows) rows.push_back(json_of(row, with_thumbnails));
    Json json{{"scene", cell.scene},          {"source", cell.source},
              {"kind", to_string(cell.kind)}, {"backend", cell.backend},
              {"adapter", cell.adapter},      {"triangles", cell.triangles},
              {"casters", cell.casters},      {"lights", cell.lights},
              {"rounds", cell.rounds},        {"empty_frame_ms", cell.empty_frame_ms},
              {"notes", cell.notes}};
    if (with_thumbnails) json["truth"] = json_of(cell.truth);
    json["rows"] = std::move(rows);
    return json;
}

}  // namespace internal

std::string cell_to_json(const Cell& cell) {
    return internal::json_of(cell, true)
        .dump(1, ' ', false, internal::Json::error_handler_t::replace);
}

Result<Cell> cell_from_json(const std::string& text) {
    try {
        const auto json = internal::Json::parse(text);
        Cell cell;
        cell.scene = json.at("scene");
        cell.source = json.at("source");
        const std::string kind = json.at("kind");
        for (const Kind k : {Kind::Indoor, Kind::Outdoor, Kind::Hero, Kind::Other}) {
            if (kind == to_string(k)) cell.kind = k;
        }
        cell.backend = json.at("backend");
        cell.adapter = json.at("adapter");
        cell.triangles = json.at("triangles");
        cell.casters = json.at("casters");
        cell.lights = json.at("lights");
        cell.rounds = json.at("rounds");
        cell.empty_frame_ms = json.at("empty_frame_ms");
        cell.notes = json.at("notes").get<std::vector<std::string>>();
        cell.truth = internal::thumbnail_from(json.at("truth"));
        for (const auto& row : json.at("rows")) cell.rows.push_back(internal::row_from(row));
        return cell;
    } catch (const nlohmann::json::exception& broken) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("This is no kept part of a report: {}.", broken.what()));
    }
}

namespace {

/// FNV-1a, 64 bits.
class Hash {
public:
    void bytes(const void* data, std::size_t size) {
        const auto* at = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) {
            value_ = (value_ ^ at[i]) * 0x100000001b3ULL;
        }
    }
    void text(std::string_view text) {
        value(text.size());
        bytes(text.data(), text.size());
    }
    template <class T>
    void value(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes(&value, sizeof value);
    }
    [[nodiscard]] std::uint64_t result() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

void add_scene(Hash& hash, const scene::Scene& scene) {
    const scene::Registry& registry = scene.registry;
    registry.each<scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::MeshInstance& instance,
            const scene::WorldTransform& world) {
            const auto geometry = scene::geometry_of(registry, entity, instance, world);
            hash.bytes(geometry.positions.data(), geometry.positions.size_bytes());
            hash.bytes(instance.mesh->indices.data(), instance.mesh->indices.size() * 4);
            hash.value(geometry.world_from_positions);
            hash.value(registry.has<scene::Caster>(entity));
            hash.value(registry.has<scene::Receiver>(entity));
        });
    const auto add_light = [&](scene::Entity entity, const auto& light) {
        hash.value(registry.get<scene::WorldTransform>(entity).world_from_local);
        hash.value(light.color);
        hash.value(light.intensity);
        if constexpr (requires { light.range_m; }) hash.value(light.range_m.value_or(-1.0));
    };
    registry.each<scene::PointLight>(add_light);
    registry.each<scene::SpotLight>(add_light);
    registry.each<scene::DirectionalLight>(add_light);
}

}  // namespace

std::string cell_key(const Subject& subject, const Options& options,
                     const machine::Machine& machine, const std::string& backend,
                     const std::string& adapter) {
    Hash hash;
    hash.text(machine.processor);
    hash.value(machine.cores);
    hash.text(machine.system);
    hash.text(options.version);
    hash.text(options.build);
    hash.text(backend);
    hash.text(adapter);
    hash.text(subject.name);
    hash.text(subject.source);
    hash.value(subject.kind);
    for (const std::string& note : subject.notes) hash.text(note);
    add_scene(hash, subject.scene);
    hash.value(subject.world_from_camera);
    hash.value(subject.near_m);
    if (const auto* camera = std::get_if<scene::PerspectiveCamera>(&subject.camera.projection)) {
        hash.value(camera->fovy_rad);
    }
    hash.value(options.width);
    hash.value(options.height);
    hash.value(options.rounds);
    hash.value(options.least_seconds);
    hash.value(options.frames);
    hash.value(options.degrees_per_frame);
    hash.value(options.quick);
    for (const std::string& name : options.only) hash.text(name);
    for (const internal::Entry& entry : internal::all_techniques()) {
        hash.text(entry.name);
        hash.text(entry.summary);
        hash.text(entry.caveat);
    }
    return fmt::format("{:016x}", hash.result());
}

}  // namespace gnomon::report
