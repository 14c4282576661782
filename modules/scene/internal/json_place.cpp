// SPDX-License-Identifier: MIT
#include "internal/json_place.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gnomon::scene::internal {
namespace {

constexpr int deepest = 64;

/// The parser itself is not recursive, but readers of its result are.
void refuse_deep(std::string_view text, const std::string& file) {
    int depth = 0;
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
                refuse_input(file, fmt::format("the JSON is nested deeper than {} levels at byte "
                                               "{}",
                                               deepest, i));
            }
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
}

void make_whole_numbers_integers(nlohmann::json& value) {
    if (value.is_structured()) {
        for (auto& child : value) make_whole_numbers_integers(child);
    } else if (value.is_number_float()) {
        constexpr double exact = 9007199254740992.0;  // 2^53: beyond it a double skips integers
        const double number = value.get<double>();
        if (std::abs(number) < exact && std::floor(number) == number) {
            value = static_cast<std::int64_t>(number);
        }
    }
}

std::string short_text(const nlohmann::json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return fmt::format("an array of {}", value.size());
    std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    if (text.size() > 60) text = text.substr(0, 60) + "…";
    return text;
}

}  // namespace

void refuse_input(std::string_view file, std::string_view what, ErrorCode code) {
    throw InputError(Error{code, fmt::format("{}: {}.", file, what)});
}

nlohmann::json parse_json(std::string_view text, const std::string& file) {
    refuse_deep(text, file);
    nlohmann::json document;
    try {
        document = nlohmann::json::parse(text);
    } catch (const nlohmann::json::parse_error& error) {
        refuse_input(file,
                     fmt::format("the JSON is broken at byte {} of {}", error.byte, text.size()));
    } catch (const nlohmann::json::exception&) {
        refuse_input(file, "the JSON holds a number that is too large for double precision");
    }
    if (!document.is_object()) {
        refuse_input(file,
                     fmt::format("the JSON is {}, but must be an object", short_text(document)));
    }
    make_whole_numbers_integers(document);
    return document;
}

void JsonPlace::refuse(std::string_view what) const {
    refuse_input(*file_, fmt::format("{} {}", path_.empty() ? "the document" : path_, what));
}

void JsonPlace::must_be(std::string_view limit) const {
    refuse(fmt::format("is {}, but must be {}", short_text(*value_), limit));
}

JsonPlace JsonPlace::member(const std::string& name) const {
    auto found = find(name);
    if (!found) refuse(fmt::format("has no member \"{}\"", name));
    return *std::move(found);
}

std::optional<JsonPlace> JsonPlace::find(const std::string& name) const {
    const auto found = value_->find(name);
    if (found == value_->end()) return std::nullopt;
    return JsonPlace(*found, *file_, path_.empty() ? name : path_ + "." + name);
}

JsonPlace JsonPlace::at(std::size_t index) const {
    return {(*value_)[index], *file_, fmt::format("{}[{}]", path_, index)};
}

const JsonPlace& JsonPlace::object() const {
    if (!value_->is_object()) must_be("an object");
    return *this;
}

const JsonPlace& JsonPlace::array() const {
    if (!value_->is_array()) must_be("an array");
    return *this;
}

const JsonPlace& JsonPlace::only(std::initializer_list<std::string_view> names) const {
    object();
    for (const auto& item : value_->items()) {
        if (std::find(names.begin(), names.end(), item.key()) == names.end()) {
            refuse(fmt::format("has the unknown member \"{}\"; known are {}", item.key(),
                               fmt::join(names, ", ")));
        }
    }
    return *this;
}

double JsonPlace::number(double min, double max) const {
    const bool good =
        value_->is_number() && value_->get<double>() >= min && value_->get<double>() <= max;
    if (!good) must_be(fmt::format("a number from {} to {}", min, max));
    return value_->get<double>();
}

std::vector<double> JsonPlace::numbers(std::size_t count, double min, double max) const {
    if (!value_->is_array() || value_->size() != count) {
        must_be(fmt::format("an array of {} numbers", count));
    }
    std::vector<double> result(count);
    for (std::size_t i = 0; i < count; ++i) result[i] = at(i).number(min, max);
    return result;
}

glm::dvec3 JsonPlace::vec3(double min, double max) const {
    const std::vector<double> xyz = numbers(3, min, max);
    return {xyz[0], xyz[1], xyz[2]};
}

std::uint64_t JsonPlace::whole(std::uint64_t min, std::uint64_t max) const {
    const bool is_whole = value_->is_number_unsigned() ||
                          (value_->is_number_integer() && value_->get<std::int64_t>() >= 0);
    const bool good =
        is_whole && value_->get<std::uint64_t>() >= min && value_->get<std::uint64_t>() <= max;
    if (!good) must_be(fmt::format("a whole number from {} to {}", min, max));
    return value_->get<std::uint64_t>();
}

bool JsonPlace::boolean() const {
    if (!value_->is_boolean()) must_be("true or false");
    return value_->get<bool>();
}

const std::string& JsonPlace::text() const {
    if (!value_->is_string()) must_be("a text");
    return value_->get_ref<const std::string&>();
}

const std::string& JsonPlace::one_of(std::initializer_list<std::string_view> allowed) const {
    const bool known =
        value_->is_string() && std::find(allowed.begin(), allowed.end(), text()) != allowed.end();
    if (!known) must_be(fmt::format("one of {}", fmt::join(allowed, ", ")));
    return text();
}

}  // namespace gnomon::scene::internal
