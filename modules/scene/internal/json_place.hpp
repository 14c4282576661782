// SPDX-License-Identifier: MIT
//
// JsonPlace: a value in a JSON document together with where it lies, so that whoever finds it wrong
// can say so in one sentence: "engine.glb: accessors[3].count is -1, but must be …".
//
// The readers inside modules/scene throw InputError for that and catch it at their public border;
// nothing of it leaves the module.
#pragma once

#include <cstdint>
#include <exception>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <gnomon/core/result.hpp>

namespace gnomon::scene::internal {

struct InputError : std::exception {
    explicit InputError(Error why) : error(std::move(why)) {}
    [[nodiscard]] const char* what() const noexcept override { return error.message.c_str(); }
    Error error;
};

/// Throws InputError("FILE: WHAT.").
[[noreturn]] void refuse_input(std::string_view file, std::string_view what,
                               ErrorCode code = ErrorCode::InvalidInput);

/// Parses `text`; a document that is broken, nested deeper than 64 levels or not an object is
/// refused. Floating-point numbers that are whole become integers, since JSON does not tell 1.0
/// from 1.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, const std::string& file);

class JsonPlace {
public:
    static constexpr double largest = std::numeric_limits<float>::max();

    /// `value` and `file` must outlive the place.
    JsonPlace(const nlohmann::json& value, const std::string& file, std::string path = {})
        : value_(&value), file_(&file), path_(std::move(path)) {}

    [[nodiscard]] const nlohmann::json& value() const { return *value_; }
    [[nodiscard]] const std::string& file() const { return *file_; }
    [[nodiscard]] const std::string& path() const { return path_; }

    /// "FILE: PATH WHAT."
    [[noreturn]] void refuse(std::string_view what) const;
    /// "FILE: PATH is VALUE, but must be LIMIT."
    [[noreturn]] void must_be(std::string_view limit) const;

    [[nodiscard]] bool has(const char* name) const { return value_->contains(name); }
    [[nodiscard]] JsonPlace member(const std::string& name) const;  ///< refused when absent
    [[nodiscard]] std::optional<JsonPlace> find(const std::string& name) const;
    [[nodiscard]] std::size_t size() const { return value_->size(); }
    [[nodiscard]] JsonPlace at(std::size_t index) const;

    const JsonPlace& object() const;  ///< itself, refused unless it is an object
    const JsonPlace& array() const;   ///< itself, refused unless it is an array
    /// Refuses members with other names.
    const JsonPlace& only(std::initializer_list<std::string_view> names) const;

    [[nodiscard]] double number(double min = -largest, double max = largest) const;
    [[nodiscard]] std::vector<double> numbers(std::size_t count, double min = -largest,
                                              double max = largest) const;
    [[nodiscard]] glm::dvec3 vec3(double min = -largest, double max = largest) const;
    [[nodiscard]] std::uint64_t whole(std::uint64_t min, std::uint64_t max) const;
    [[nodiscard]] bool boolean() const;
    [[nodiscard]] const std::string& text() const;
    /// The text, refused unless it is one of these.
    const std::string& one_of(std::initializer_list<std::string_view> allowed) const;

private:
    const nlohmann::json* value_;
    const std::string* file_;
    std::string path_;
};

}  // namespace gnomon::scene::internal
