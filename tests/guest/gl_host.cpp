// SPDX-License-Identifier: MIT
#include "tests/guest/gl_host.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <glm/gtc/type_ptr.hpp>

#include <gnomon/scene/scene.hpp>
#include <gnomon/scene/transforms.hpp>

#include "tests/support/devices.hpp"

namespace gnomon::test {

namespace {

// `precise` as in position.glsl, for the way that shares its positions; the sums are the same.
constexpr const char* vertex_text = R"(#version 430
uniform mat4 clip_from_local, clip_from_view, view_from_world, world_from_local;
in vec3 position;
out gl_PerVertex { invariant vec4 gl_Position; };
vec4 clip_position(mat4 m, vec4 p) {
    precise vec4 clip = m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3] * p.w;
    return clip;
}
void main() {
    gl_Position = SHARED ? clip_position(clip_from_local, vec4(position, 1.0))
                         : clip_from_view * (view_from_world * (world_from_local * vec4(position, 1.0)));
}
)";
constexpr const char* fragment_text = R"(#version 430
out vec4 color;
void main() { color = vec4(0.5, 0.6, 0.7, 1.0); }
)";

// A sample's integer, at the pixel where it is.
constexpr const char* fetching_vertex_text = R"(#version 430
void main() {
    gl_Position = vec4(vec2(gl_VertexID << 1 & 2, gl_VertexID & 2) * 2.0 - 1.0, 0.0, 1.0);
}
)";
constexpr const char* fetching_fragment_text = R"(#version 430
uniform usampler2DMS source;
uniform int wanted;
out uint value;
void main() { value = texelFetch(source, ivec2(gl_FragCoord.xy), wanted).r; }
)";

GLuint link(const HostGl& gl, const char* vertex, const char* fragment) {
    const GLuint program = gl.CreateProgram();
    for (const bool is_vertex : {true, false}) {
        const GLuint shader = gl.CreateShader(is_vertex ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
        const char* text = is_vertex ? vertex : fragment;
        gl.ShaderSource(shader, 1, &text, nullptr);
        gl.CompileShader(shader);
        gl.AttachShader(program, shader);
    }
    gl.BindAttribLocation(program, 0, "position");
    gl.LinkProgram(program);
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) throw std::runtime_error("The host's shaders do not link.");
    return program;
}

}  // namespace

HostGl::HostGl(const gl::Context& context) {
#define GNOMON_HOST_LOAD(name) \
    name = reinterpret_cast<decltype(name)>(context.get_proc_address("gl" #name));
    GNOMON_HOST_FUNCTIONS(GNOMON_HOST_LOAD)
#undef GNOMON_HOST_LOAD
}

GlHost::GlHost(std::unique_ptr<gl::Context> context, HostWay way)
    : context_(std::move(context)), way_(std::move(way)), gl_(*context_) {
    make_current();
    make_program();
    make_framebuffer();
    set_clip_control();
}

GlHost::~GlHost() {
    make_current();
    gl_.DeleteTextures(static_cast<GLsizei>(masks_.size()), masks_.data());
    gl_.DeleteFramebuffers(1, &framebuffer_);
    gl_.DeleteRenderbuffers(1, &color_);
    if (depth_is_texture()) {
        gl_.DeleteTextures(1, &depth_stencil_);
    } else {
        gl_.DeleteRenderbuffers(1, &depth_stencil_);
    }
}

void GlHost::make_current() const { must(context_->make_current()); }

void GlHost::make_program() {
    std::string vertex = vertex_text;
    vertex.replace(vertex.find("SHARED"), 6, way_.shared_positions ? "true" : "false");
    program_ = link(gl_, vertex.c_str(), fragment_text);
    fetching_program_ = link(gl_, fetching_vertex_text, fetching_fragment_text);
    gl_.GenVertexArrays(1, &vertex_array_);
}

void GlHost::set_clip_control() const {
    gl_.ClipControl(way_.upper_left ? GL_UPPER_LEFT : GL_LOWER_LEFT,
                    way_.zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
}

void GlHost::make_framebuffer() {
    const auto width = static_cast<GLsizei>(row_width);
    const auto height = static_cast<GLsizei>(row_height);
    const GLenum format = way_.format == gpu::Format::Depth24UnormStencil8 ? GL_DEPTH24_STENCIL8
                                                                           : GL_DEPTH32F_STENCIL8;
    gl_.GenFramebuffers(1, &framebuffer_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.GenRenderbuffers(1, &color_);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, color_);
    gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, renderbuffer_samples(), GL_RGBA8, width,
                                       height);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
    make_depth_stencil(format);
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw std::runtime_error("The host's framebuffer is not complete.");
    }
}

void GlHost::make_depth_stencil(GLenum format) {
    const auto width = static_cast<GLsizei>(row_width);
    const auto height = static_cast<GLsizei>(row_height);
    if (!depth_is_texture()) {
        gl_.GenRenderbuffers(1, &depth_stencil_);
        gl_.BindRenderbuffer(GL_RENDERBUFFER, depth_stencil_);
        gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, renderbuffer_samples(), format, width,
                                           height);
        gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                                    depth_stencil_);
        return;
    }
    const GLenum target = way_.samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    gl_.GenTextures(1, &depth_stencil_);
    gl_.BindTexture(target, depth_stencil_);
    if (way_.samples > 1) {
        gl_.TexStorage2DMultisample(target, static_cast<GLsizei>(way_.samples), format, width,
                                    height, GL_TRUE);
        gl_.TexParameteri(target, GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
    } else {
        gl_.TexStorage2D(target, 1, format, width, height);
    }
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, target, depth_stencil_,
                             0);
}

gl::HostTarget GlHost::target() const {
    // Framebuffers are imported as they are drawn to; of the others it is said how.
    if (way_.kind == gl::HostTarget::Kind::Framebuffer) return {.name = framebuffer_};
    return {.kind = way_.kind,
            .name = depth_stencil_,
            .clip_zero_to_one = way_.zero_to_one,
            .clip_upper_left = way_.upper_left};
}

shadows::HostConventions GlHost::conventions() const {
    return {way_.zero_to_one ? shadows::HostDepth::ZeroToOne : shadows::HostDepth::MinusOneToOne,
            way_.reversed};
}

GlHost::Camera GlHost::camera_of(const Setting& setting) const {
    glm::dmat4 view = setting.view.view_from_world;
    glm::dmat4 clip = setting.view.clip_from_view;
    if (setting.view.projection == shadows::ProjectionKind::InfinitePerspective) {
        constexpr double far_m = 60.0;
        // The frustum stays; its near plane may be another.
        const bool finite = way_.far == Far::Finite;
        clip[2][2] = finite ? way_.near_m / (far_m - way_.near_m) : 0.0;
        clip[3][2] = finite ? way_.near_m * far_m / (far_m - way_.near_m) : way_.near_m;
        if (way_.far == Far::Epsilon) clip[2][2] = -2.4e-7;  // of what is 1 at the near plane
    }
    for (int c = 0; c < 4; ++c) {
        double z = way_.reversed ? clip[c][2] : clip[c][3] - clip[c][2];
        if (!way_.zero_to_one) z = 2.0 * z - clip[c][3];
        clip[c][2] = z;
        if (way_.y_down) clip[c][1] = -clip[c][1];
    }
    if (way_.along_plus_z) {
        for (int c = 0; c < 4; ++c) view[c][2] = -view[c][2];
        clip[2] = -clip[2];
    }
    return {glm::mat4(view), glm::mat4(clip)};
}

void GlHost::draw(const Setting& setting) {
    const Camera camera = camera_of(setting);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.Viewport(0, 0, static_cast<GLsizei>(row_width), static_cast<GLsizei>(row_height));
    set_clip_control();
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(way_.reversed ? GL_GREATER : GL_LESS);
    gl_.ClearDepth(way_.reversed ? 0.0 : 1.0);
    gl_.ClearStencil(0x55);  // the guest's to clear
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    gl_.UseProgram(program_);
    gl_.BindVertexArray(vertex_array_);
    gl_.EnableVertexAttribArray(0);
    const auto set = [this](const char* name, const glm::mat4& m) {
        gl_.UniformMatrix4fv(gl_.GetUniformLocation(program_, name), 1, GL_FALSE,
                             glm::value_ptr(m));
    };
    set("view_from_world", camera.view_from_world);
    set("clip_from_view", camera.clip_from_view);
    setting.scene.registry.each<scene::Receiver, scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::Receiver&, const scene::MeshInstance& instance,
            const scene::WorldTransform& transform) {
            const scene::Geometry geometry =
                scene::geometry_of(setting.scene.registry, entity, instance, transform);
            const glm::dmat4& world = geometry.world_from_positions;
            set("world_from_local", glm::mat4(world));
            set("clip_from_local", glm::mat4(glm::dmat4(camera.clip_from_view) *
                                             glm::dmat4(camera.view_from_world) * world));
            std::array<GLuint, 2> buffers{};
            gl_.GenBuffers(2, buffers.data());
            gl_.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
            const auto bytes = std::as_bytes(geometry.positions);
            gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(),
                           GL_STATIC_DRAW);
            gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
            const std::vector<std::uint32_t>& indices = instance.mesh->indices;
            gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
            gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(4 * indices.size()),
                           indices.data(), GL_STATIC_DRAW);
            gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices.size()), GL_UNSIGNED_INT,
                             nullptr);
        });
}

template <class T>
std::vector<T> GlHost::read(GLuint framebuffer, GLenum format, GLenum type) const {
    std::vector<T> rows(std::size_t{row_width} * row_height);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.ReadPixels(0, 0, static_cast<GLsizei>(row_width), static_cast<GLsizei>(row_height), format,
                   type, rows.data());
    if (!samples_are_mirrored()) return rows;
    std::vector<T> turned;
    for (std::size_t y = row_height; y-- > 0;) {
        const auto* row = rows.data() + y * row_width;
        turned.insert(turned.end(), row, row + row_width);
    }
    return turned;
}

std::vector<std::uint8_t> GlHost::stencil() const {
    return read<std::uint8_t>(framebuffer_, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE);
}

std::vector<std::uint8_t> GlHost::stencil_sample(int sample) const {
    const auto values = fetch_sample(depth_stencil_, sample);
    return {values.begin(), values.end()};
}

GLuint GlHost::make_mask(GLenum format, std::uint32_t samples) {
    const auto width = static_cast<GLsizei>(row_width);
    const auto height = static_cast<GLsizei>(row_height);
    GLuint mask = 0;
    gl_.GenTextures(1, &mask);
    if (samples > 1) {
        gl_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, mask);
        gl_.TexStorage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, static_cast<GLsizei>(samples),
                                    format, width, height, GL_TRUE);
    } else {
        gl_.BindTexture(GL_TEXTURE_2D, mask);
        gl_.TexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    }
    masks_.push_back(mask);
    return mask;
}

std::vector<std::uint32_t> GlHost::read_bits(GLuint mask, int sample) const {
    if (way_.samples > 1) return fetch_sample(mask, sample);
    GLuint framebuffer = 0;
    gl_.GenFramebuffers(1, &framebuffer);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, mask, 0);
    auto bits = read<std::uint32_t>(framebuffer, GL_RED_INTEGER, GL_UNSIGNED_INT);
    gl_.DeleteFramebuffers(1, &framebuffer);
    return bits;
}

std::vector<std::uint8_t> GlHost::read_bytes(GLuint mask) const {
    GLuint framebuffer = 0;
    gl_.GenFramebuffers(1, &framebuffer);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, mask, 0);
    auto bytes = read<std::uint8_t>(framebuffer, GL_RED, GL_UNSIGNED_BYTE);
    gl_.DeleteFramebuffers(1, &framebuffer);
    return bytes;
}

std::vector<std::uint32_t> GlHost::fetch_sample(GLuint texture, int sample) const {
    GLuint framebuffer = 0;
    GLuint target = 0;
    gl_.GenFramebuffers(1, &framebuffer);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_.GenRenderbuffers(1, &target);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, target);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_R32UI, static_cast<GLsizei>(row_width),
                            static_cast<GLsizei>(row_height));
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target);
    gl_.Viewport(0, 0, static_cast<GLsizei>(row_width), static_cast<GLsizei>(row_height));
    gl_.Disable(GL_DEPTH_TEST);
    gl_.UseProgram(fetching_program_);
    gl_.Uniform1i(gl_.GetUniformLocation(fetching_program_, "wanted"), sample);
    gl_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture);
    gl_.BindVertexArray(vertex_array_);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    auto values = read<std::uint32_t>(framebuffer, GL_RED_INTEGER, GL_UNSIGNED_INT);
    gl_.DeleteFramebuffers(1, &framebuffer);
    gl_.DeleteRenderbuffers(1, &target);
    return values;
}

}  // namespace gnomon::test
