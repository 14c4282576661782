// SPDX-License-Identifier: MIT
//
// Shadows in a texture: for renderers that shade each pixel once, with all of its lights (deferred,
// forward+), and have no place for a stencil test between two of them. A plain program of GLFW and
// OpenGL with six lamps; what gnomon adds to it is marked by "// guest". The host draws its depth;
// the guest counts each lamp's shadow volumes in the host's stencil and makes them one bit of an
// integer texture of the host's; the host shades once, and its shader looks the bits up.
//
// Draws one frame without showing it and writes mask_texture.ppm; with --show, a window.
#define GLFW_INCLUDE_NONE
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#include <GLFW/glfw3.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <gnomon/gl/backend.hpp>
#include <gnomon/gl/host_target.hpp>
#include <gnomon/shadow_pass/light_masks.hpp>

namespace {

using namespace gnomon;

constexpr int width = 640;
constexpr int height = 360;
constexpr int lamp_count = 6;

// ---- The host: what a renderer has anyway.

// Any loader will do; this one has no need of a library.
#define HOST_FUNCTIONS(X)                                                                         \
    X(AttachShader)                                                                               \
    X(BindBuffer) X(BindFramebuffer) X(BindRenderbuffer) X(BindTexture) X(BindVertexArray)        \
        X(BlitFramebuffer) X(BufferData) X(Clear) X(ClearColor) X(ColorMask) X(CompileShader)     \
            X(CreateProgram) X(CreateShader) X(DepthFunc) X(DrawElements) X(Enable)               \
                X(EnableVertexAttribArray) X(FramebufferRenderbuffer) X(GenBuffers)               \
                    X(GenFramebuffers) X(GenRenderbuffers) X(GenTextures) X(GenVertexArrays)      \
                        X(GetTexImage) X(GetUniformLocation) X(LinkProgram) X(PixelStorei)        \
                            X(ReadPixels) X(RenderbufferStorage) X(ShaderSource) X(TexParameteri) \
                                X(TexStorage2D) X(Uniform3f) X(Uniform3fv) X(UniformMatrix4fv)    \
                                    X(UseProgram) X(VertexAttribPointer) X(Viewport)
struct Gl {
#define HOST_MEMBER(name) \
    decltype(&::gl##name) name = reinterpret_cast<decltype(name)>(glfwGetProcAddress("gl" #name));
    HOST_FUNCTIONS(HOST_MEMBER)
};

constexpr const char* vertex_shader = R"(#version 430
layout(location = 0) in vec3 position;
uniform mat4 projection, view, model;
invariant gl_Position;
out vec3 world;
void main() {
    world = vec3(model * vec4(position, 1.0));
    gl_Position = projection * view * model * vec4(position, 1.0);
}
)";
constexpr const char* fragment_shader = R"(#version 430
const int lamp_count = 6;
in vec3 world;
uniform vec3 albedo, lamps[lamp_count], colors[lamp_count];
uniform usampler2D shadows;  // guest: bit l is set where lamp l does not arrive
out vec4 color;
void main() {
    vec3 n = normalize(cross(dFdx(world), dFdy(world)));
    uint shadowed = texelFetch(shadows, ivec2(gl_FragCoord.xy), 0).r;  // guest
    vec3 light = vec3(0.04);
    for (int l = 0; l < lamp_count; ++l) {
        if ((shadowed >> l & 1u) != 0u) continue;  // guest
        vec3 to_lamp = lamps[l] - world;
        float lambert = max(dot(n, normalize(to_lamp)), 0.0) / dot(to_lamp, to_lamp);
        light += colors[l] * lambert;
    }
    color = vec4(sqrt(albedo * light), 1.0);
}
)";

struct Thing {
    std::uint64_t id = 0;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    glm::vec3 albedo{1.0F};
    glm::mat4 model{1.0F};
    GLuint vertex_array = 0;
    std::shared_ptr<const shadows::ShadowMesh> shadow_mesh;  // guest
};

Thing make_box(std::uint64_t id, const glm::vec3& middle, const glm::vec3& half, float turn) {
    Thing box;
    box.id = id;
    for (unsigned i = 0; i < 8; ++i) {
        box.positions.emplace_back((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1,
                                   (i & 4U) != 0 ? 1 : -1);
    }
    box.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                   2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    box.model = glm::scale(
        glm::rotate(glm::translate(glm::mat4(1.0F), middle), turn, {0.3F, 1.0F, 0.2F}), half);
    return box;
}

class Host {
public:
    void create() {
        program_ = gl_.CreateProgram();
        for (const bool is_vertex : {true, false}) {
            const GLuint shader =
                gl_.CreateShader(is_vertex ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
            const char* text = is_vertex ? vertex_shader : fragment_shader;
            gl_.ShaderSource(shader, 1, &text, nullptr);
            gl_.CompileShader(shader);
            gl_.AttachShader(program_, shader);
        }
        gl_.LinkProgram(program_);
        things = {make_box(1, {0, -0.5F, 0}, {8, 0.5F, 8}, 0.0F),
                  make_box(2, {-0.9F, 1.1F, 0.2F}, {0.6F, 0.6F, 0.6F}, 0.7F),
                  make_box(3, {1.2F, 0.9F, -0.4F}, {0.25F, 0.9F, 0.25F}, 0.0F)};
        things[0].albedo = {0.7F, 0.7F, 0.7F};
        for (Thing& thing : things) upload(thing);
        create_framebuffer();
        gl_.Viewport(0, 0, width, height);
        gl_.Enable(GL_DEPTH_TEST);
        move_lamps(0.0F);
    }

    void move_lamps(float time) {
        for (int l = 0; l < lamp_count; ++l) {
            const float angle = time + 1.0472F * static_cast<float>(l);
            lamps[static_cast<std::size_t>(l)] = {3.0F * std::cos(angle), 3.0F,
                                                  3.0F * std::sin(angle)};
        }
    }

    void draw_depth() {
        gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        draw();
        gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }

    /// Once, with all lamps.
    void shade() {
        gl_.BindTexture(GL_TEXTURE_2D, mask);  // guest
        gl_.DepthFunc(GL_EQUAL);
        draw();
        gl_.DepthFunc(GL_LESS);
    }

    void show() const {
        gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        gl_.BlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                            GL_NEAREST);
    }

    /// How much of the picture each lamp's shadow takes, and the picture itself.
    void write_picture(const char* file) const {
        std::vector<std::uint32_t> bits(std::size_t{width} * height);
        std::vector<unsigned char> pixels(3 * bits.size());
        gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
        gl_.BindTexture(GL_TEXTURE_2D, mask);
        gl_.GetTexImage(GL_TEXTURE_2D, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, bits.data());
        gl_.ReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
        for (int l = 0; l < lamp_count; ++l) {
            std::size_t shadowed = 0;
            for (const std::uint32_t word : bits) shadowed += word >> l & 1U;
            std::printf("lamp %d: %zu of %zu pixels lie in shadow\n", l, shadowed, bits.size());
        }
        std::ofstream out(file, std::ios::binary);
        out << "P6 " << width << ' ' << height << " 255\n";
        for (std::size_t y = height; y-- > 0;) {
            out.write(reinterpret_cast<const char*>(&pixels[3 * width * y]), 3 * width);
        }
    }

    std::vector<Thing> things;
    std::array<glm::vec3, lamp_count> lamps{};
    glm::mat4 view =
        glm::lookAt(glm::vec3(-1.5F, 3.6F, 5.5F), glm::vec3(0, 0.3F, 0), glm::vec3(0, 1, 0));
    glm::mat4 projection = glm::perspective(0.8F, static_cast<float>(width) / height, 0.1F, 100.0F);
    GLuint framebuffer = 0;
    GLuint mask = 0;  // guest

private:
    void upload(Thing& thing) {
        gl_.GenVertexArrays(1, &thing.vertex_array);
        gl_.BindVertexArray(thing.vertex_array);
        std::array<GLuint, 2> buffers{};
        gl_.GenBuffers(2, buffers.data());
        gl_.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
        gl_.BufferData(GL_ARRAY_BUFFER,
                       static_cast<GLsizeiptr>(thing.positions.size() * sizeof(glm::vec3)),
                       thing.positions.data(), GL_STATIC_DRAW);
        gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
        gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(thing.indices.size() * 4),
                       thing.indices.data(), GL_STATIC_DRAW);
        gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
        gl_.EnableVertexAttribArray(0);
    }

    void create_framebuffer() {
        gl_.GenFramebuffers(1, &framebuffer);
        gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        const auto attach = [this](GLenum attachment, GLenum format) {
            GLuint buffer = 0;
            gl_.GenRenderbuffers(1, &buffer);
            gl_.BindRenderbuffer(GL_RENDERBUFFER, buffer);
            gl_.RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
            gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
        };
        attach(GL_COLOR_ATTACHMENT0, GL_RGBA8);
        attach(GL_DEPTH_STENCIL_ATTACHMENT, GL_DEPTH24_STENCIL8);
        gl_.GenTextures(1, &mask);                                            // guest
        gl_.BindTexture(GL_TEXTURE_2D, mask);                                 // guest
        gl_.TexStorage2D(GL_TEXTURE_2D, 1, GL_R32UI, width, height);          // guest
        // Integers are not filtered: with other filters the texture reads as nothing.
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);  // guest
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);  // guest
    }

    void draw() const {
        gl_.UseProgram(program_);
        const auto at = [this](const char* name) { return gl_.GetUniformLocation(program_, name); };
        constexpr std::array<glm::vec3, lamp_count> colors{
            {{4, 1, 1}, {3, 3, 1}, {1, 4, 1}, {1, 3, 3}, {1, 1, 4}, {3, 1, 3}}};
        gl_.UniformMatrix4fv(at("projection"), 1, GL_FALSE, glm::value_ptr(projection));
        gl_.UniformMatrix4fv(at("view"), 1, GL_FALSE, glm::value_ptr(view));
        gl_.Uniform3fv(at("lamps"), lamp_count, glm::value_ptr(lamps[0]));
        gl_.Uniform3fv(at("colors"), lamp_count, glm::value_ptr(colors[0]));
        for (const Thing& thing : things) {
            gl_.UniformMatrix4fv(at("model"), 1, GL_FALSE, glm::value_ptr(thing.model));
            gl_.Uniform3f(at("albedo"), thing.albedo.x, thing.albedo.y, thing.albedo.z);
            gl_.BindVertexArray(thing.vertex_array);
            gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(thing.indices.size()),
                             GL_UNSIGNED_INT, nullptr);
        }
    }

    Gl gl_;
    GLuint program_ = 0;
};

// ---- The guest: all that the host does for its shadows.

class Shadows {
public:
    /// The host's context is current.
    Status create(Host& host) {
        for (Thing& thing : host.things) {
            auto mesh = shadows::ShadowMesh::build(
                {.positions = reinterpret_cast<const std::byte*>(thing.positions.data()),
                 .vertex_count = thing.positions.size(),
                 .indices = thing.indices});
            if (!mesh) return forward_error(mesh);
            thing.shadow_mesh = std::move(*mesh);
        }
        auto context = gl::adopt_current_context(
            [](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); });
        if (!context) return forward_error(context);
        auto backend = gl::create_backend(std::move(*context));
        if (!backend) return forward_error(backend);
        device_.emplace(std::move(*backend));
        // What the host has: depth and stencil, and a texture to put the shadows into.
        gpu::TextureDesc desc{.label = "depth",
                              .width = width,
                              .height = height,
                              .format = gpu::Format::Depth24UnormStencil8,
                              .usage = gpu::TextureUsage::RenderAttachment};
        auto depth = device_->import_texture(desc, gl::HostTarget{.name = host.framebuffer});
        if (!depth) return forward_error(depth);
        desc.label = "mask";
        desc.format = gpu::Format::R32Uint;
        auto mask = device_->import_texture(
            desc, gl::HostTarget{.kind = gl::HostTarget::Kind::Texture, .name = host.mask});
        if (!mask) return forward_error(mask);
        depth_ = std::move(*depth);
        mask_ = std::move(*mask);
        auto masks = shadow_pass::LightMasks::create(
            *device_,
            {.host = {.target = depth_, .size = {width, height}, .conventions = conventions_},
             .masks = {mask_}});
        if (!masks) return forward_error(masks);
        masks_.emplace(std::move(*masks));
        auto system = shadows::ShadowSystem::create();
        if (!system) return forward_error(system);
        system_.emplace(std::move(*system));
        return {};
    }

    /// The host has drawn its depth; afterwards its mask has the shadows of all lamps.
    Status resolve(const Host& host) {
        const auto view = shadows::view_of_host(host.view, host.projection, conventions_);
        if (!view) return forward_error(view);
        auto frame = system_->begin_frame();
        for (const Thing& thing : host.things) {
            frame.caster({.key = thing.id,
                          .mesh = thing.shadow_mesh,
                          .world_from_local = glm::dmat4(thing.model)});
        }
        for (std::size_t l = 0; l < lamp_count; ++l) {  // by key: lamp l is bit l
            frame.light({.key = 1 + l, .position_world = glm::dvec4(host.lamps[l], 1.0)});
        }
        const shadows::DrawList& list = std::move(frame).finish(view->view);
        if (const Status prepared = masks_->prepare(list, *view); !prepared) return prepared;
        return masks_->resolve();
    }

private:
    // What glm::perspective and OpenGL do where nobody says otherwise.
    shadows::HostConventions conventions_{shadows::HostDepth::MinusOneToOne, false};
    std::optional<gpu::Device> device_;
    gpu::Texture depth_, mask_;
    std::optional<shadow_pass::LightMasks> masks_;
    std::optional<shadows::ShadowSystem> system_;
};

Status run(GLFWwindow* window, bool show) {
    Host host;
    host.create();
    Shadows shadows;                                                   // guest
    if (const Status made = shadows.create(host); !made) return made;  // guest
    do {
        host.move_lamps(static_cast<float>(show ? glfwGetTime() : 0.0));
        host.draw_depth();
        if (const Status done = shadows.resolve(host); !done) return done;  // guest
        host.shade();
        if (show) {
            host.show();
            glfwSwapBuffers(window);
        }
        glfwPollEvents();
    } while (show && glfwWindowShouldClose(window) == GLFW_FALSE);
    if (!show) host.write_picture("mask_texture.ppm");
    return {};
}

}  // namespace

int main(int argument_count, char** arguments) {
    const bool show = argument_count > 1 && std::string_view(arguments[1]) == "--show";
    if (glfwInit() == GLFW_FALSE) {
        std::fprintf(stderr, "GLFW finds no display.\n");
        return 1;
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, show ? GLFW_TRUE : GLFW_FALSE);
    GLFWwindow* window = glfwCreateWindow(width, height, "Shadows in a texture", nullptr, nullptr);
    int code = 1;
    if (window == nullptr) {
        std::fprintf(stderr, "GLFW makes no window with OpenGL 4.5.\n");
    } else {
        glfwMakeContextCurrent(window);
        const Status status = run(window, show);
        if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
        code = status ? 0 : 1;
    }
    glfwTerminate();
    return code;
}
