// SPDX-License-Identifier: MIT
#include "json_place.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gnomon::game {

namespace {

constexpr std::size_t deepest = 16;  // a level needs five

std::string short_text(const nlohmann::json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return fmt::format("an array of {}", value.size());
    std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    if (text.size() > 60) text = text.substr(0, 60) + "…";
    return text;
}

/// U+0080 to U+009F, which terminals obey as well. The parser has seen to it that it is UTF-8.
bool has_control_of_two_bytes(std::string_view text) {
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        if (text[i] == '\xC2' && static_cast<unsigned char>(text[i + 1]) < 0xA0) return true;
    }
    return false;
}

}  // namespace

void JsonPlace::refuse(std::string_view what) const {
    throw BadLevel(fmt::format("{}: {} {}.", *file_, path_.empty() ? "the document" : path_, what));
}

void JsonPlace::must_be(std::string_view limit) const {
    refuse(fmt::format("is {}, but must be {}", short_text(*value_), limit));
}

const JsonPlace& JsonPlace::only(std::initializer_list<std::string_view> names) const {
    if (!value_->is_object()) must_be("an object");
    for (const auto& item : value_->items()) {
        if (std::find(names.begin(), names.end(), item.key()) == names.end()) {
            refuse(fmt::format("has the unknown member {}; known are {}", short_text(item.key()),
                               fmt::join(names, ", ")));
        }
    }
    return *this;
}

JsonPlace JsonPlace::member(const std::string& name) const {
    auto found = find(name);
    if (!found) refuse(fmt::format("has no member \"{}\"", name));
    return *std::move(found);
}

std::optional<JsonPlace> JsonPlace::find(const std::string& name) const {
    if (!value_->is_object()) must_be("an object");
    const auto found = value_->find(name);
    if (found == value_->end()) return std::nullopt;
    return JsonPlace(*found, *file_, path_.empty() ? name : path_ + "." + name);
}

std::vector<JsonPlace> JsonPlace::entries(std::size_t least, std::size_t most) const {
    if (!value_->is_array() || value_->size() < least || value_->size() > most) {
        must_be(fmt::format("an array of {} to {} entries", least, most));
    }
    std::vector<JsonPlace> places;
    for (std::size_t i = 0; i < value_->size(); ++i) {
        places.push_back({(*value_)[i], *file_, fmt::format("{}[{}]", path_, i)});
    }
    return places;
}

double JsonPlace::number(double min, double max) const {
    const bool good =
        value_->is_number() && value_->get<double>() >= min && value_->get<double>() <= max;
    if (!good) must_be(fmt::format("a number from {} to {}", min, max));
    return value_->get<double>();
}

std::uint32_t JsonPlace::whole(std::uint32_t min, std::uint32_t max) const {
    const bool good = value_->is_number_unsigned() && value_->get<std::uint64_t>() >= min &&
                      value_->get<std::uint64_t>() <= max;
    if (!good) must_be(fmt::format("a whole number from {} to {}", min, max));
    return value_->get<std::uint32_t>();
}

std::vector<double> JsonPlace::numbers(std::size_t count, double min, double max) const {
    if (!value_->is_array() || value_->size() != count) {
        must_be(fmt::format("an array of {} numbers", count));
    }
    std::vector<double> result;
    for (const JsonPlace& entry : entries(count, count)) result.push_back(entry.number(min, max));
    return result;
}

glm::dvec2 JsonPlace::vec2(double min, double max) const {
    const std::vector<double> n = numbers(2, min, max);
    return {n[0], n[1]};
}

glm::dvec3 JsonPlace::vec3(double min, double max) const {
    const std::vector<double> n = numbers(3, min, max);
    return {n[0], n[1], n[2]};
}

const std::string& JsonPlace::text(std::size_t most) const {
    if (!value_->is_string()) must_be("a text");
    const auto& text = value_->get_ref<const std::string&>();
    if (text.empty() || text.size() > most) {
        must_be(fmt::format("a text of 1 to {} bytes", most));
    }
    if (std::ranges::any_of(text, [](char c) { return (c >= 0 && c < ' ') || c == 0x7F; }) ||
        has_control_of_two_bytes(text)) {
        must_be("a text without control characters");
    }
    return text;
}

nlohmann::json parse_level_json(std::string_view text, const std::string& file) {
    // The parser is not recursive, but destroying and printing what it made is.
    std::size_t depth = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_text) {
            if (c == '\\') ++i;
            if (c == '"') in_text = false;
        } else if (c == '"') {
            in_text = true;
        } else if (c == '[' || c == '{') {
            if (++depth > deepest) {
                throw BadLevel(fmt::format(
                    "{}: the JSON is nested deeper than {} levels at byte {}.", file, deepest, i));
            }
        } else if ((c == ']' || c == '}') && depth > 0) {
            --depth;
        }
    }
    nlohmann::json document;
    try {
        document = nlohmann::json::parse(text);
    } catch (const nlohmann::json::parse_error& error) {
        throw BadLevel(
            fmt::format("{}: the JSON is broken at byte {} of {}.", file, error.byte, text.size()));
    } catch (const nlohmann::json::exception&) {
        throw BadLevel(fmt::format("{}: the JSON holds a number that is too large.", file));
    }
    if (!document.is_object()) {
        throw BadLevel(
            fmt::format("{}: the JSON is {}, but must be an object.", file, short_text(document)));
    }
    return document;
}

}  // namespace gnomon::game
