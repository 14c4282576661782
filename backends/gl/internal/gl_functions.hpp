// SPDX-License-Identifier: MIT
//
// The OpenGL entry points that gnomon uses, and no others, loaded through the context: no GL
// library is ever linked. The types come from the prototypes of <GL/glcorearb.h>, which are only
// named, never called.
#pragma once

#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES
#endif
#include <GL/glcorearb.h>

#include <gnomon/core/result.hpp>
#include <gnomon/gl/context.hpp>

// clang-format off
/// In every OpenGL 4.3.
#define GNOMON_GL_REQUIRED_FUNCTIONS(X)                                                           \
    X(ActiveTexture) X(AttachShader) X(BeginQuery) X(BindBuffer) X(BindBufferBase)                \
    X(BindBufferRange) X(BindFramebuffer) X(BindRenderbuffer) X(BindSampler) X(BindTexture)       \
    X(BindVertexArray) X(BindVertexBuffer) X(BlendColor) X(BlendEquationSeparatei)                \
    X(BlendFuncSeparatei) X(BlitFramebuffer) X(BufferData) X(BufferSubData)                       \
    X(CheckFramebufferStatus) X(ClearBufferfi) X(ClearBufferfv) X(ClearBufferiv)                  \
    X(ClearBufferuiv) X(ColorMask) X(ColorMaski) X(CompileShader) X(CopyBufferSubData)            \
    X(CreateProgram) X(CreateShader) X(CullFace) X(DebugMessageCallback) X(DebugMessageControl)   \
    X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram) X(DeleteQueries) X(DeleteSamplers)    \
    X(DeleteShader) X(DeleteTextures) X(DeleteVertexArrays) X(DepthFunc) X(DepthMask)             \
    X(DepthRangeIndexed) X(DetachShader) X(Disable) X(DisableVertexAttribArray) X(Disablei)       \
    X(DrawArraysInstancedBaseInstance) X(DrawBuffers)                                             \
    X(DrawElementsInstancedBaseVertexBaseInstance) X(Enable) X(EnableVertexAttribArray)           \
    X(Enablei) X(EndQuery) X(Finish) X(FramebufferRenderbuffer) X(FramebufferTexture2D)           \
    X(FrontFace) X(GenBuffers) X(GenFramebuffers) X(GenQueries) X(GenSamplers) X(GenTextures)     \
    X(GenVertexArrays) X(GetBooleani_v) X(GetBooleanv) X(GetBufferSubData) X(GetDoublei_v)        \
    X(GetError) X(GetFloati_v) X(GetFloatv) X(GetFramebufferAttachmentParameteriv)                \
    X(GetInteger64i_v) X(GetIntegeri_v) X(GetIntegerv) X(GetInternalformativ)                     \
    X(GetProgramInfoLog) X(GetProgramiv) X(GetQueryObjectui64v) X(GetQueryiv)                     \
    X(GetRenderbufferParameteriv) X(GetShaderInfoLog) X(GetShaderiv) X(GetString) X(GetStringi)   \
    X(GetTexLevelParameteriv) X(GetUniformLocation) X(InvalidateFramebuffer) X(IsEnabled)         \
    X(IsEnabledi) X(IsTexture) X(LineWidth) X(LinkProgram) X(ObjectLabel) X(PixelStorei) X(PointSize)          \
    X(PolygonMode) X(PolygonOffset) X(PopDebugGroup) X(ProvokingVertex) X(PushDebugGroup)         \
    X(QueryCounter) X(ReadBuffer) X(ReadPixels) X(SamplerParameteri) X(ScissorIndexed)            \
    X(ShaderSource) X(StencilFunc) X(StencilFuncSeparate) X(StencilMask) X(StencilMaskSeparate)   \
    X(StencilOp) X(StencilOpSeparate) X(TexParameteri) X(TexStorage2D)                            \
    X(TexStorage2DMultisample) X(TexSubImage2D) X(TextureView) X(Uniform1i) X(UseProgram)         \
    X(VertexAttribBinding) X(VertexAttribFormat) X(VertexAttribIFormat) X(VertexBindingDivisor)   \
    X(ViewportIndexedf)
// clang-format on

namespace gnomon::gl {

// GL_EXT_stencil_two_side: a compatibility extension, so <GL/glcorearb.h> does not know it.
inline constexpr GLenum stencil_test_two_side_ext = 0x8910;
using ActiveStencilFaceExt = void(APIENTRY*)(GLenum face);

// GL_EXT_depth_bounds_test: the same.
inline constexpr GLenum depth_bounds_test_ext = 0x8890;
using DepthBoundsExt = void(APIENTRY*)(GLdouble min, GLdouble max);

struct GlFunctions {
#define GNOMON_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
    GNOMON_GL_REQUIRED_FUNCTIONS(GNOMON_GL_MEMBER)
#undef GNOMON_GL_MEMBER

    // Of extensions; the adapter loads them where it found the extension, else they are null.
    decltype(&::glClipControl) ClipControl = nullptr;
    decltype(&::glPolygonOffsetClamp) PolygonOffsetClamp = nullptr;
    decltype(&::glGetGraphicsResetStatus) GetGraphicsResetStatus = nullptr;
    ActiveStencilFaceExt ActiveStencilFaceEXT = nullptr;
    DepthBoundsExt DepthBoundsEXT = nullptr;
};

/// Loads one entry point; the error names it.
template <class Function>
[[nodiscard]] Status load_function(const Context& context, Function& function, const char* name) {
    function = reinterpret_cast<Function>(context.get_proc_address(name));
    if (function == nullptr) {
        return fail(ErrorCode::Unsupported, "The OpenGL driver behind this context (" +
                                                context.description() + ") has no function " +
                                                name + ".");
    }
    return {};
}

/// Loads what every OpenGL 4.3 has.
[[nodiscard]] Status load_required_functions(const Context& context, GlFunctions& gl);

}  // namespace gnomon::gl
