// SPDX-License-Identifier: MIT
#include "internal/adapter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <string>
#include <string_view>

#include "internal/conv.hpp"

namespace gnomon::gl {
namespace {

struct Version {
    int major = 0;
    int minor = 0;
    [[nodiscard]] bool at_least(int wanted_major, int wanted_minor) const {
        return major > wanted_major || (major == wanted_major && minor >= wanted_minor);
    }
};

/// "4.5 (Compatibility Profile) Mesa 22.3.6" is 4.5; "OpenGL ES 3.2" is no desktop version: 0.0.
Version parse_version(std::string_view text) {
    Version version;
    const char* end = text.data() + text.size();
    const auto major = std::from_chars(text.data(), end, version.major);
    if (major.ec != std::errc{} || major.ptr == end || *major.ptr != '.') return {};
    if (std::from_chars(major.ptr + 1, end, version.minor).ec != std::errc{}) return {};
    return version;
}

std::string get_string(const GlFunctions& gl, GLenum name) {
    const GLubyte* text = gl.GetString(name);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

GLint get_integer(const GlFunctions& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

std::uint32_t get_limit(const GlFunctions& gl, GLenum name) {
    return static_cast<std::uint32_t>(std::max(get_integer(gl, name), 0));
}

/// What the driver has less what the caller switched off. An extension that went into a core
/// version is there from that version on, listed or not.
class Extensions {
public:
    Extensions(const GlFunctions& gl, Version version, const BackendOptions& options)
        : version_(version),
          disabled_(options.disabled_extensions.begin(), options.disabled_extensions.end()) {
        const GLint count = get_integer(gl, GL_NUM_EXTENSIONS);
        for (GLint i = 0; i < count; ++i) {
            const GLubyte* name = gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
            if (name != nullptr) listed_.insert(reinterpret_cast<const char*>(name));
        }
    }
    [[nodiscard]] bool has(const std::string& name) const {
        return listed_.count(name) != 0 && disabled_.count(name) == 0;
    }
    [[nodiscard]] bool has(const std::string& name, int core_major, int core_minor) const {
        return (version_.at_least(core_major, core_minor) || listed_.count(name) != 0) &&
               disabled_.count(name) == 0;
    }

private:
    Version version_;
    std::set<std::string> listed_;
    std::set<std::string> disabled_;
};

Status choose_stencil_path(const Context& context, const Extensions& extensions,
                           const BackendOptions& options, Adapter& adapter) {
    const StencilPath path = options.stencil_path.value_or(StencilPath::Separate);
    if (path == StencilPath::TwoSide) {
        for (const char* name : {"GL_EXT_stencil_two_side", "GL_EXT_stencil_wrap"}) {
            if (!extensions.has(name)) {
                return fail(ErrorCode::Unsupported,
                            fmt::format("The stencil path \"two-side\" needs {}, which this OpenGL "
                                        "context ({}) does not offer.",
                                        name, context.description()));
            }
        }
        if (const Status loaded =
                load_function(context, adapter.gl.ActiveStencilFaceEXT, "glActiveStencilFaceEXT");
            !loaded) {
            return loaded;
        }
    }
    adapter.stencil = make_stencil_strategy(path);
    adapter.caps.stencil_path = adapter.stencil->name();
    return {};
}

bool has_four_samples(const GlFunctions& gl, gpu::Format format) {
    const GLenum internal = to_gl(format).internal;
    GLint count = 0;
    gl.GetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, internal, GL_NUM_SAMPLE_COUNTS, 1, &count);
    std::array<GLint, 16> samples{};
    count = std::clamp(count, 0, static_cast<GLint>(samples.size()));
    if (count == 0) return false;
    gl.GetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, internal, GL_SAMPLES, count, samples.data());
    return std::find(samples.begin(), samples.begin() + count, 4) != samples.begin() + count;
}

gpu::Features read_features(const GlFunctions& gl, const Extensions& extensions) {
    gpu::Features features;
    features.unclipped_depth = extensions.has("GL_ARB_depth_clamp", 3, 2);
    features.depth_bounds = gl.DepthBoundsEXT != nullptr;
    if (extensions.has("GL_ARB_timer_query", 3, 3)) {
        GLint bits = 0;
        gl.GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
        features.timestamp_query = bits > 0;
    }
    if (extensions.has("GL_ARB_occlusion_query", 1, 5)) {
        GLint bits = 0;
        gl.GetQueryiv(GL_SAMPLES_PASSED, GL_QUERY_COUNTER_BITS, &bits);
        features.occlusion_query = bits > 0;
    }
    features.depth24unorm_stencil8 = true;  // both are required formats of OpenGL 3.0
    features.depth32float_stencil8 = true;
    // Per-sample fetch needs multisample textures, not renderbuffers.
    features.multisample_4 = extensions.has("GL_ARB_texture_multisample", 3, 2) &&
                             get_integer(gl, GL_MAX_SAMPLES) >= 4 &&
                             get_integer(gl, GL_MAX_COLOR_TEXTURE_SAMPLES) >= 4 &&
                             get_integer(gl, GL_MAX_DEPTH_TEXTURE_SAMPLES) >= 4 &&
                             has_four_samples(gl, gpu::Format::Rgba8Unorm) &&
                             has_four_samples(gl, gpu::Format::Depth24UnormStencil8) &&
                             has_four_samples(gl, gpu::Format::Depth32FloatStencil8);
    features.multisample_32bit = features.multisample_4;
    features.sample_shading = extensions.has("GL_ARB_sample_shading", 4, 0);
    features.sampled_stencil = extensions.has("GL_ARB_stencil_texturing", 4, 3);
    features.exact_clip_space = true;  // clip control was required above
    return features;
}

gpu::Limits read_limits(const GlFunctions& gl) {
    gpu::Limits limits;
    limits.max_texture_dimension_2d = get_limit(gl, GL_MAX_TEXTURE_SIZE);
    limits.max_color_attachments =
        std::min(get_limit(gl, GL_MAX_DRAW_BUFFERS), get_limit(gl, GL_MAX_COLOR_ATTACHMENTS));
    limits.max_vertex_buffers = get_limit(gl, GL_MAX_VERTEX_ATTRIB_BINDINGS);
    limits.max_vertex_attributes = get_limit(gl, GL_MAX_VERTEX_ATTRIBS);
    // GL names no limit; what every driver takes is the signed 32-bit range, in whole words.
    limits.max_buffer_size = 0x7FFFFFFC;
    limits.max_uniform_buffer_binding_size = get_limit(gl, GL_MAX_UNIFORM_BLOCK_SIZE);
    limits.min_uniform_buffer_offset_alignment =
        std::max(get_limit(gl, GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT), 1U);
    return limits;
}

}  // namespace

Result<Adapter> open_adapter(const Context& context, const BackendOptions& options) {
    Adapter adapter;
    GlFunctions& gl = adapter.gl;
    // The version comes first: on an old driver it is the reason, a missing function the symptom.
    if (const Status loaded = load_function(context, gl.GetString, "glGetString"); !loaded) {
        return forward_error(loaded);
    }
    const std::string version_text = get_string(gl, GL_VERSION);
    const Version version = parse_version(version_text);
    if (!version.at_least(4, 3)) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("OpenGL 4.3 is needed, but this context ({}) has version \"{}\".",
                                context.description(), version_text));
    }
    if (const Status loaded = load_required_functions(context, gl); !loaded) {
        return forward_error(loaded);
    }

    const Extensions extensions(gl, version, options);
    if (!extensions.has("GL_ARB_clip_control", 4, 5)) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("OpenGL 4.5 or the extension GL_ARB_clip_control is needed, but "
                                "this context ({}) has version \"{}\" without it.",
                                context.description(), version_text));
    }
    if (const Status loaded = load_function(context, gl.ClipControl, "glClipControl"); !loaded) {
        return forward_error(loaded);
    }
    if (extensions.has("GL_ARB_polygon_offset_clamp", 4, 6)) {
        if (const Status loaded =
                load_function(context, gl.PolygonOffsetClamp, "glPolygonOffsetClamp");
            !loaded) {
            return forward_error(loaded);
        }
    }
    if (extensions.has("GL_EXT_depth_bounds_test")) {
        if (const Status loaded = load_function(context, gl.DepthBoundsEXT, "glDepthBoundsEXT");
            !loaded) {
            return forward_error(loaded);
        }
    }
    if (extensions.has("GL_KHR_robustness", 4, 5)) {
        if (const Status loaded =
                load_function(context, gl.GetGraphicsResetStatus, "glGetGraphicsResetStatus");
            !loaded) {
            return forward_error(loaded);
        }
    }
    if (const Status chosen = choose_stencil_path(context, extensions, options, adapter); !chosen) {
        return forward_error(chosen);
    }

    adapter.debug_groups = extensions.has("GL_KHR_debug", 4, 3);
    adapter.debug = options.debug && adapter.debug_groups;
    adapter.texture_units = get_limit(gl, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS);
    adapter.uniform_buffer_bindings = get_limit(gl, GL_MAX_UNIFORM_BUFFER_BINDINGS);
    adapter.viewports = std::max(get_limit(gl, GL_MAX_VIEWPORTS), 1U);
    // Some drivers name no profile at all for the contexts of old, which are compatible.
    adapter.compatibility = (static_cast<GLuint>(get_integer(gl, GL_CONTEXT_PROFILE_MASK)) &
                             GL_CONTEXT_CORE_PROFILE_BIT) == 0;
    // Whatever the stencil path: a host may have used it.
    if (context.is_adopted() && adapter.compatibility &&
        extensions.has("GL_EXT_stencil_two_side")) {
        if (const Status loaded =
                load_function(context, gl.ActiveStencilFaceEXT, "glActiveStencilFaceEXT");
            !loaded) {
            return forward_error(loaded);
        }
    }
    adapter.caps.backend = "gl";
    adapter.caps.adapter = get_string(gl, GL_RENDERER) + ", OpenGL " + version_text;
    adapter.caps.features = read_features(gl, extensions);
    adapter.caps.limits = read_limits(gl);
    adapter.caps.limits.multisample_scissor_alignment =
        gpu::multisample_scissor_alignment_of(adapter.caps.adapter);
    return adapter;
}

}  // namespace gnomon::gl
