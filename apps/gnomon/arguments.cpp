// SPDX-License-Identifier: MIT
#include "arguments.hpp"

#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace gnomon::cli {

namespace {

constexpr std::uint32_t largest_size = 16384;

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        const auto end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

template <class Integer>
std::optional<Integer> whole_number(std::string_view text) {
    Integer value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

Result<double> parse_number(std::string_view text, std::string_view what) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{}: \"{}\" is not a finite number.", what, text));
    }
    return value;
}

Result<double> parse_number(std::string_view text, std::string_view what, double min, double max) {
    const auto value = parse_number(text, what);
    if (!value) return forward_error(value);
    if (*value < min || *value > max) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{}: \"{}\" is not from {} to {}.", what, text, min, max));
    }
    return value;
}

Result<glm::dvec3> parse_vector(std::string_view text, std::string_view what) {
    const auto parts = split(text, ',');
    if (parts.size() != 3) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{}: \"{}\" has {} numbers; three are needed, as in 1,2.5,-3.",
                                what, text, parts.size()));
    }
    glm::dvec3 v(0.0);
    for (int i = 0; i < 3; ++i) {
        const auto number = parse_number(parts[static_cast<std::size_t>(i)], what,
                                         -largest_coordinate, largest_coordinate);
        if (!number) return forward_error(number);
        v[i] = *number;
    }
    return v;
}

Result<Size> parse_size(std::string_view text) {
    const auto parts = split(text, 'x');
    const auto bad = [&] {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("--size: \"{}\" is not WIDTHxHEIGHT with both from 1 to {}.", text,
                                largest_size));
    };
    if (parts.size() != 2) return bad();
    const auto width = whole_number<std::uint32_t>(parts[0]);
    const auto height = whole_number<std::uint32_t>(parts[1]);
    if (!width || !height || *width < 1 || *height < 1 || *width > largest_size ||
        *height > largest_size)
        return bad();
    return Size{*width, *height};
}

Result<LightArgument> parse_light(std::string_view text) {
    LightArgument light;
    std::string_view rest = text;
    if (rest.starts_with("dir:")) {
        light.directional = true;
        rest.remove_prefix(4);
    } else if (rest.starts_with("point:")) {
        rest.remove_prefix(6);
    } else {
        return fail(
            ErrorCode::InvalidInput,
            fmt::format("--light: \"{}\" is neither point:x,y,z[,range=R] nor dir:x,y,z.", text));
    }
    if (const auto at = rest.find(",range="); at != std::string_view::npos) {
        if (light.directional) {
            return fail(
                ErrorCode::InvalidInput,
                fmt::format("--light: \"{}\" has a range; only a point light has one.", text));
        }
        const auto range =
            parse_number(rest.substr(at + 7), "--light range", smallest_length, largest_coordinate);
        if (!range) return forward_error(range);
        light.range_m = *range;
        rest = rest.substr(0, at);
    }
    const auto value = parse_vector(rest, "--light");
    if (!value) return forward_error(value);
    light.value = *value;
    if (light.directional && glm::length(light.value) < smallest_length) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("--light: \"{}\" has no direction.", text));
    }
    return light;
}

Result<Motion> parse_motion(std::string_view text) {
    Motion motion;
    const auto colon = text.find(':');
    const std::string_view kind = text.substr(0, colon);
    const std::string_view value =
        colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1);
    if (text == "static") return motion;
    if (text == "camera") {
        motion.kind = MotionKind::Camera;
        return motion;
    }
    if (kind == "light" && !value.empty()) {
        motion.kind = MotionKind::Light;
        const auto degrees = parse_number(value, "--animate light");
        if (!degrees) return forward_error(degrees);
        motion.degrees = *degrees;
        return motion;
    }
    if (kind == "time" && !value.empty()) {
        motion.kind = MotionKind::Time;
        const auto seconds = parse_number(value, "--animate time", -1e9, 1e9);
        if (!seconds) return forward_error(seconds);
        motion.seconds = *seconds;
        return motion;
    }
    if (kind == "casters" && !value.empty()) {
        if (const auto count = whole_number<std::uint32_t>(value)) {
            motion.kind = MotionKind::Casters;
            motion.casters = *count;
            return motion;
        }
    }
    return fail(ErrorCode::InvalidInput,
                fmt::format("--animate: \"{}\" is none of static, camera, light:DEG, casters:K, "
                            "time:SECONDS.",
                            text));
}

Result<render::Overlays> parse_overlays(std::string_view text) {
    render::Overlays overlays;
    for (const std::string_view part : split(text, ',')) {
        if (part == "volumes") {
            overlays.volumes = true;
        } else if (part == "silhouettes") {
            overlays.silhouettes = true;
        } else if (part == "caps") {
            overlays.caps = true;
        } else if (part == "wireframe") {
            overlays.wireframe = true;
        } else if (part == "count") {
            overlays.count = true;
        } else if (part == "fill") {
            overlays.fill = true;
        } else {
            return fail(
                ErrorCode::InvalidInput,
                fmt::format(
                    "--show: \"{}\" is none of volumes, silhouettes, caps, wireframe, count, "
                    "fill.",
                    part));
        }
    }
    return overlays;
}

Result<shadows::FillOptions> parse_without(std::string_view text) {
    shadows::FillOptions fill;
    for (const std::string_view part : split(text, ',')) {
        if (part == "view-cull") {
            fill.cull_by_view = false;
        } else if (part == "receiver-cull") {
            fill.cull_by_receivers = false;
        } else if (part == "umbra-cull") {
            fill.cull_by_umbra = false;
        } else if (part == "clamp") {
            fill.clamp = false;
        } else if (part == "scissor") {
            fill.scissor = false;
        } else if (part == "depth-bounds") {
            fill.depth_bounds = false;
        } else if (part == "all") {
            fill = shadows::FillOptions::none();
        } else {
            return fail(
                ErrorCode::InvalidInput,
                fmt::format(
                    "--without: \"{}\" is none of view-cull, receiver-cull, umbra-cull, clamp, "
                    "scissor, depth-bounds, all.",
                    part));
        }
    }
    return fill;
}

}  // namespace gnomon::cli
