// SPDX-License-Identifier: MIT
//
// gnomon as a guest in somebody else's renderer: a plain program of GLFW and OpenGL, with shaders,
// matrices and a framebuffer of its own. What gnomon adds to it is marked by "// guest". The host
// draws its ambient light and depth; the guest counts shadow volumes in the host's stencil; the
// host adds its lamp where that is 0.
//
// Draws one frame without showing it and writes guest_in_opengl.ppm; with --show, a window.
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
#include <gnomon/shadow_pass/guest_pass.hpp>

namespace {

using namespace gnomon;

constexpr int width = 640;
constexpr int height = 360;

// ---- The host: what a renderer has anyway.

// Any loader will do; this one has no need of a library.
#define HOST_FUNCTIONS(X)                                                                     \
    X(AttachShader)                                                                           \
    X(BindBuffer)                                                                             \
    X(BindVertexArray)                                                                        \
    X(BlendFunc) X(BufferData) X(Clear) X(ClearColor) X(CompileShader) X(CreateProgram)       \
        X(CreateShader) X(DepthFunc) X(DepthMask) X(Disable) X(DrawElements) X(Enable)        \
            X(EnableVertexAttribArray) X(GenBuffers) X(GenVertexArrays) X(GetUniformLocation) \
                X(LinkProgram) X(PixelStorei) X(ReadPixels) X(ShaderSource) X(StencilFunc)    \
                    X(StencilOp) X(Uniform3f) X(UniformMatrix4fv) X(UseProgram)               \
                        X(VertexAttribPointer) X(Viewport)
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
in vec3 world;
uniform vec3 albedo, lamp, intensity;  // a lamp without intensity is the ambient light
out vec4 color;
void main() {
    vec3 n = normalize(cross(dFdx(world), dFdy(world)));
    vec3 to_lamp = lamp - world;
    float lambert = max(dot(n, normalize(to_lamp)), 0.0) / dot(to_lamp, to_lamp);
    color = vec4(albedo * (intensity == vec3(0.0) ? vec3(0.15) : intensity * lambert), 1.0);
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
        things[0].albedo = {0.5F, 0.55F, 0.5F};
        things[1].albedo = {0.8F, 0.4F, 0.3F};
        for (Thing& thing : things) {
            gl_.GenVertexArrays(1, &thing.vertex_array);
            gl_.BindVertexArray(thing.vertex_array);
            std::array<GLuint, 2> buffers{};
            gl_.GenBuffers(2, buffers.data());
            gl_.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
            gl_.BufferData(GL_ARRAY_BUFFER,
                           static_cast<GLsizeiptr>(thing.positions.size() * sizeof(glm::vec3)),
                           thing.positions.data(), GL_STATIC_DRAW);
            gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
            gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                           static_cast<GLsizeiptr>(thing.indices.size() * 4), thing.indices.data(),
                           GL_STATIC_DRAW);
            gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
            gl_.EnableVertexAttribArray(0);
        }
        gl_.Viewport(0, 0, width, height);
        gl_.Enable(GL_DEPTH_TEST);
        gl_.ClearColor(0.05F, 0.06F, 0.08F, 1.0F);
    }

    void draw_depth_and_ambient_light() {
        gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        draw(glm::vec3(0.0F));
    }

    /// Once more, added up: where nothing but this surface is in front, and no shadow.
    void add_lamp() {
        gl_.DepthFunc(GL_EQUAL);
        gl_.DepthMask(GL_FALSE);
        gl_.Enable(GL_BLEND);
        gl_.BlendFunc(GL_ONE, GL_ONE);
        gl_.Enable(GL_STENCIL_TEST);
        gl_.StencilFunc(GL_EQUAL, 0, 0xFF);
        gl_.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        draw({20.0F, 18.0F, 14.0F});
        gl_.Disable(GL_STENCIL_TEST);
        gl_.Disable(GL_BLEND);
        gl_.DepthMask(GL_TRUE);
        gl_.DepthFunc(GL_LESS);
    }

    /// How much of the picture lies in shadow, and the picture itself.
    void write_picture(const char* file) const {
        std::vector<unsigned char> counts(std::size_t{width} * height);
        std::vector<unsigned char> colors(3 * counts.size());
        gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
        gl_.ReadPixels(0, 0, width, height, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, counts.data());
        gl_.ReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, colors.data());
        std::size_t shadowed = 0;
        for (const unsigned char count : counts) shadowed += count != 0 ? 1 : 0;
        std::printf("%zu of %zu pixels lie in shadow\n", shadowed, counts.size());
        std::ofstream out(file, std::ios::binary);
        out << "P6 " << width << ' ' << height << " 255\n";
        for (std::size_t y = height; y-- > 0;) {
            out.write(reinterpret_cast<const char*>(&colors[3 * width * y]), 3 * width);
        }
    }

    std::vector<Thing> things;
    glm::vec3 lamp{2.0F, 4.0F, 2.5F};
    glm::mat4 view =
        glm::lookAt(glm::vec3(-1.5F, 3.0F, 5.5F), glm::vec3(0, 0.6F, 0), glm::vec3(0, 1, 0));
    glm::mat4 projection = glm::perspective(0.8F, static_cast<float>(width) / height, 0.1F, 100.0F);

private:
    void draw(const glm::vec3& intensity) const {
        gl_.UseProgram(program_);
        const auto at = [this](const char* name) { return gl_.GetUniformLocation(program_, name); };
        gl_.UniformMatrix4fv(at("projection"), 1, GL_FALSE, glm::value_ptr(projection));
        gl_.UniformMatrix4fv(at("view"), 1, GL_FALSE, glm::value_ptr(view));
        gl_.Uniform3f(at("lamp"), lamp.x, lamp.y, lamp.z);
        gl_.Uniform3f(at("intensity"), intensity.x, intensity.y, intensity.z);
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
        // The window's own framebuffer, which has 24 bits of depth and 8 of stencil.
        auto target = device_->import_texture({.label = "window",
                                               .width = width,
                                               .height = height,
                                               .format = gpu::Format::Depth24UnormStencil8,
                                               .usage = gpu::TextureUsage::RenderAttachment},
                                              gl::HostTarget{.name = 0});
        if (!target) return forward_error(target);
        target_ = std::move(*target);
        auto pass = shadow_pass::GuestPass::create(
            *device_, {.target = target_, .size = {width, height}, .conventions = conventions_});
        if (!pass) return forward_error(pass);
        pass_.emplace(std::move(*pass));
        auto system = shadows::ShadowSystem::create();
        if (!system) return forward_error(system);
        system_.emplace(std::move(*system));
        return {};
    }

    /// The host has drawn its depth; afterwards its stencil is 0 where the lamp shines.
    Status count(const Host& host) {
        const auto view = shadows::view_of_host(host.view, host.projection, conventions_);
        if (!view) return forward_error(view);
        auto frame = system_->begin_frame();
        for (const Thing& thing : host.things) {
            frame.caster({.key = thing.id,
                          .mesh = thing.shadow_mesh,
                          .world_from_local = glm::dmat4(thing.model)});
        }
        frame.light({.key = 1, .position_world = glm::dvec4(glm::dvec3(host.lamp), 1.0)});
        const shadows::DrawList& list = std::move(frame).finish(view->view);
        if (const Status prepared = pass_->prepare(list, *view); !prepared) return prepared;
        return pass_->count(0);
    }

private:
    // What glm::perspective and OpenGL do where nobody says otherwise.
    shadows::HostConventions conventions_{shadows::HostDepth::MinusOneToOne, false};
    std::optional<gpu::Device> device_;
    gpu::Texture target_;
    std::optional<shadow_pass::GuestPass> pass_;
    std::optional<shadows::ShadowSystem> system_;
};

Status run(GLFWwindow* window, bool show) {
    Host host;
    host.create();
    Shadows shadows;                                                   // guest
    if (const Status made = shadows.create(host); !made) return made;  // guest
    do {
        const auto angle = static_cast<float>(show ? glfwGetTime() : 0.0);
        host.lamp = {2.0F * std::cos(angle), 4.0F, 2.5F + 2.0F * std::sin(angle)};
        host.draw_depth_and_ambient_light();
        if (const Status counted = shadows.count(host); !counted) return counted;  // guest
        host.add_lamp();
        if (show) glfwSwapBuffers(window);
        glfwPollEvents();
    } while (show && glfwWindowShouldClose(window) == GLFW_FALSE);
    if (!show) host.write_picture("guest_in_opengl.ppm");
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
    glfwWindowHint(GLFW_STENCIL_BITS, 8);  // guest
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, show ? GLFW_TRUE : GLFW_FALSE);
    GLFWwindow* window = glfwCreateWindow(width, height, "A guest in OpenGL", nullptr, nullptr);
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
