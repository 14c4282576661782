// SPDX-License-Identifier: MIT
//
// JsonPlace: a value of a level file together with where it lies, so that whoever finds it wrong
// says so in one sentence: "yard.json: guards[1].speed_m_s is -2, but must be a number from 0.1 to
// 4.". It throws BadLevel; the reader catches that at its border (level.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace gnomon::game {

struct BadLevel : std::exception {
    explicit BadLevel(std::string why) : sentence(std::move(why)) {}
    [[nodiscard]] const char* what() const noexcept override { return sentence.c_str(); }
    std::string sentence;
};

class JsonPlace {
public:
    /// `value` and `file` must outlive the place.
    JsonPlace(const nlohmann::json& value, const std::string& file, std::string path = {})
        : value_(&value), file_(&file), path_(std::move(path)) {}

    /// "FILE: PATH WHAT."
    [[noreturn]] void refuse(std::string_view what) const;
    /// "FILE: PATH is VALUE, but must be LIMIT."
    [[noreturn]] void must_be(std::string_view limit) const;

    /// Refuses what is no object, and members with other names.
    const JsonPlace& only(std::initializer_list<std::string_view> names) const;
    [[nodiscard]] JsonPlace member(const std::string& name) const;  ///< refused when absent
    [[nodiscard]] std::optional<JsonPlace> find(const std::string& name) const;
    /// The entries of an array of at least `least` and at most `most`.
    [[nodiscard]] std::vector<JsonPlace> entries(std::size_t least, std::size_t most) const;

    [[nodiscard]] double number(double min, double max) const;
    [[nodiscard]] std::uint32_t whole(std::uint32_t min, std::uint32_t max) const;
    [[nodiscard]] glm::dvec2 vec2(double min, double max) const;
    [[nodiscard]] glm::dvec3 vec3(double min, double max) const;
    /// Of 1 to `most` bytes, without control characters: it may be shown as it is.
    [[nodiscard]] const std::string& text(std::size_t most) const;

private:
    [[nodiscard]] std::vector<double> numbers(std::size_t count, double min, double max) const;

    const nlohmann::json* value_;
    const std::string* file_;
    std::string path_;
};

/// Throws BadLevel where the text is no JSON object, or nests deeper than a level can.
[[nodiscard]] nlohmann::json parse_level_json(std::string_view text, const std::string& file);

}  // namespace gnomon::game
