// SPDX-License-Identifier: MIT
//
// The words of validation messages: how objects, values and sets of bits are written. Sentences
// themselves stand where the rule stands.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/types.hpp>

namespace gnomon::gpu {

/// `[Buffer "indices"]`, or `[Buffer]` where the label is empty.
[[nodiscard]] std::string object_name(std::string_view kind, std::string_view label);

[[nodiscard]] std::string_view to_text(Format format);
[[nodiscard]] std::string_view to_text(Aspect aspect);
[[nodiscard]] std::string_view to_text(SampleType type);
[[nodiscard]] std::string_view to_text(QueryType type);
[[nodiscard]] std::string_view to_text(BindingType type);
/// `Index | Vertex`; `None` for the empty set.
[[nodiscard]] std::string to_text(BufferUsage usage);
[[nodiscard]] std::string to_text(TextureUsage usage);
[[nodiscard]] std::string to_text(ShaderStage stages);

template <class... Args>
[[nodiscard]] tl::unexpected<Error> invalid(fmt::format_string<Args...> format, Args&&... args) {
    return fail(ErrorCode::Validation, fmt::format(format, std::forward<Args>(args)...));
}

/// Adds a frame, such as `While creating [Buffer "indices"].`, to a failed result.
template <class T>
[[nodiscard]] tl::unexpected<Error> in_frame(const Result<T>& failed, std::string_view frame) {
    return fail(failed.error().code, fmt::format("{} {}", failed.error().message, frame));
}

}  // namespace gnomon::gpu
