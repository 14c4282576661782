// SPDX-License-Identifier: MIT
#pragma once

#include <gnomon/gl/host_target.hpp>

#include "internal/adapter.hpp"
#include "internal/objects.hpp"

namespace gnomon::gl {

/// Looks at what the host has there; ErrorCode::Unsupported where shadows cannot be counted in it,
/// InvalidInput where `desc` says something else than GL.
[[nodiscard]] Result<TextureObject> import_host_target(const Adapter& adapter,
                                                       const gpu::TextureDesc& desc,
                                                       const HostTarget& host);

}  // namespace gnomon::gl
