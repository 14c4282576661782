// SPDX-License-Identifier: MIT
//
// The options that say what is drawn and how: those of every subcommand that draws a scene.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "render_options.hpp"

namespace gnomon::cli {

/// For CLI11, which validates by exception and wants a string; our parsers give Results.
template <class T, class Parser>
std::function<void(const std::string&)> parsed_into(T& target, Parser parse) {
    return [&target, parse](const std::string& text) {
        auto value = parse(text);
        if (!value) throw CLI::ValidationError("", value.error().message);
        target = std::move(*value);
    };
}

[[nodiscard]] CLI::Validator not_empty();

/// Size, camera, lights, casters and receivers, how shadows are made, debug views, the time of
/// animations. `options` outlives the app.
void add_scene_options(CLI::App& app, RenderOptions& options);

}  // namespace gnomon::cli
