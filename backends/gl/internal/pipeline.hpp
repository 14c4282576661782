// SPDX-License-Identifier: MIT
//
// Shaders and pipelines: GLSL in, a linked program and translated state out.
#pragma once

#include <string>

#include "internal/adapter.hpp"
#include "internal/objects.hpp"

namespace gnomon::gl {

/// The compiler's log is part of the error.
[[nodiscard]] Result<ShaderObject> make_shader(const Adapter& adapter, const gpu::ShaderDesc& desc);

/// `fragment` may be null. The linker's log is part of the error.
[[nodiscard]] Result<PipelineObject> make_pipeline(const Adapter& adapter,
                                                   const gpu::RenderPipelineDesc& desc,
                                                   const ShaderObject& vertex,
                                                   const ShaderObject* fragment);

}  // namespace gnomon::gl
