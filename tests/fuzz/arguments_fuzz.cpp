// SPDX-License-Identifier: MIT
//
// Any text as an argument of every little language of the command line: a value within its limits,
// or one sentence.
#include "arguments.hpp"

#include <cmath>

#include "fuzz_input.hpp"

namespace gnomon::test {
namespace {

template <class T, class Check>
void require_value(const Result<T>& result, Check check) {
    if (result) {
        require(check(*result), "a parsed argument is within its limits");
    } else {
        require_sentence(result.error(), ErrorCode::InvalidInput);
    }
}

bool within(const glm::dvec3& v) {
    return std::abs(v.x) <= cli::largest_coordinate && std::abs(v.y) <= cli::largest_coordinate &&
           std::abs(v.z) <= cli::largest_coordinate;
}

void parse_everything(const std::string& text) {
    require_value(cli::parse_number(text, "number"), [](double v) { return std::isfinite(v); });
    require_value(cli::parse_number(text, "number", -1.0, 1.0),
                  [](double v) { return v >= -1.0 && v <= 1.0; });
    require_value(cli::parse_vector(text, "vector"), within);
    require_value(cli::parse_size(text), [](const cli::Size& size) {
        return size.width >= 1 && size.width <= 16384 && size.height >= 1 && size.height <= 16384;
    });
    require_value(cli::parse_light(text), [](const cli::LightArgument& light) {
        if (light.directional && light.range_m) return false;
        if (light.range_m && !(*light.range_m >= cli::smallest_length)) return false;
        return within(light.value) &&
               !(light.directional && glm::length(light.value) < cli::smallest_length);
    });
    require_value(cli::parse_motion(text),
                  [](const cli::Motion& motion) { return std::isfinite(motion.degrees); });
    require_value(cli::parse_overlays(text), [](const render::Overlays&) { return true; });

    const std::string line = cli::one_line(text);
    require(line.size() == text.size(), "one_line only replaces");
    for (const char c : line) {
        require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F, "one line has no controls");
    }
}

}  // namespace
}  // namespace gnomon::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    gnomon::test::parse_everything(std::string(reinterpret_cast<const char*>(data), size));
    return 0;
}
