// SPDX-License-Identifier: MIT
//
// New buffers and textures are zero because the backend clears them, not because a driver happens
// to: every allocation passes through a context that fills it with rubbish first.
#include <GL/glcorearb.h>
#include <gnomon/gl/backend.hpp>

#include <array>
#include <utility>
#include <vector>

#include "tests/support/devices.hpp"

namespace gnomon::gl_tests {
namespace {

using test::must;

// Loaded when a backend asks for the functions they stand in for.
PFNGLBUFFERDATAPROC real_buffer_data = nullptr;
PFNGLTEXSTORAGE2DPROC real_tex_storage = nullptr;
PFNGLCLEARTEXIMAGEPROC clear_tex_image = nullptr;
PFNGLGETINTEGERVPROC get_integer = nullptr;
int poisoned_textures = 0;

void APIENTRY poisoning_buffer_data(GLenum target, GLsizeiptr size, const void* data,
                                    GLenum usage) {
    const std::vector<unsigned char> rubbish(static_cast<std::size_t>(size), 0xCD);
    real_buffer_data(target, size, data != nullptr ? data : rubbish.data(), usage);
}

void APIENTRY poisoning_tex_storage(GLenum target, GLsizei levels, GLenum internal, GLsizei width,
                                    GLsizei height) {
    real_tex_storage(target, levels, internal, width, height);
    GLint name = 0;
    get_integer(GL_TEXTURE_BINDING_2D, &name);
    for (GLint level = 0; level < levels; ++level) {
        const auto fill = [&](GLenum format, GLenum type, const void* texel) {
            clear_tex_image(static_cast<GLuint>(name), level, format, type, texel);
        };
        constexpr std::array<GLubyte, 4> bytes{0xCD, 0xCD, 0xCD, 0xCD};
        constexpr std::pair<GLfloat, GLuint> depth_stencil{0.75F, 0xCD};
        switch (internal) {
            case GL_R8UI:
            case GL_R32UI: fill(GL_RED_INTEGER, GL_UNSIGNED_BYTE, bytes.data()); break;
            case GL_RGBA32UI: fill(GL_RGBA_INTEGER, GL_UNSIGNED_BYTE, bytes.data()); break;
            case GL_DEPTH_COMPONENT32F:
                fill(GL_DEPTH_COMPONENT, GL_FLOAT, &depth_stencil.first);
                break;
            case GL_DEPTH24_STENCIL8:
            case GL_DEPTH32F_STENCIL8:
                fill(GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, &depth_stencil);
                break;
            default: fill(GL_RGBA, GL_UNSIGNED_BYTE, bytes.data()); break;
        }
    }
    ++poisoned_textures;
}

class PoisoningContext final : public gl::Context {
public:
    explicit PoisoningContext(std::unique_ptr<gl::Context> inner) : inner_(std::move(inner)) {
        load(clear_tex_image, "glClearTexImage");
        load(get_integer, "glGetIntegerv");
        load(real_buffer_data, "glBufferData");
        load(real_tex_storage, "glTexStorage2D");
    }
    Status make_current() override { return inner_->make_current(); }
    [[nodiscard]] void* get_proc_address(const char* name) const override {
        const std::string_view function = name;
        if (function == "glBufferData") return reinterpret_cast<void*>(&poisoning_buffer_data);
        if (function == "glTexStorage2D") return reinterpret_cast<void*>(&poisoning_tex_storage);
        return inner_->get_proc_address(name);
    }
    [[nodiscard]] std::string description() const override { return inner_->description(); }

private:
    template <class Function>
    void load(Function& function, const char* name) {
        function = reinterpret_cast<Function>(inner_->get_proc_address(name));
    }
    std::unique_ptr<gl::Context> inner_;
};

class ZeroContents : public testing::Test {
protected:
    void SetUp() override {
        auto context = gl::create_osmesa_context();
        if (!context) {
            ASSERT_FALSE(test::is_required("gl_osmesa_separate")) << context.error().message;
            GTEST_SKIP() << context.error().message;
        }
        device_.emplace(must(gl::create_backend(
            std::make_unique<PoisoningContext>(std::move(*context)), {.debug = true})));
    }
    std::optional<gpu::Device> device_;
};

TEST_F(ZeroContents, OfBuffers) {
    const auto buffer = must(
        device_->create_buffer({.label = "zero",
                                .size = 1000,
                                .usage = gpu::BufferUsage::CopySrc | gpu::BufferUsage::CopyDst}));
    EXPECT_EQ(must(device_->read_buffer(buffer, 0, 1000)), std::vector<std::byte>(1000));
}

TEST_F(ZeroContents, OfTexturesOfEveryFormat) {
    for (int i = 1; i <= static_cast<int>(gpu::Format::Depth32FloatStencil8); ++i) {
        SCOPED_TRACE(i);
        const auto format = static_cast<gpu::Format>(i);
        const int poisoned_before = poisoned_textures;
        const auto texture = must(device_->create_texture(
            {.label = "zero",
             .width = 8,
             .height = 8,
             .format = format,
             .usage = gpu::TextureUsage::CopySrc | gpu::TextureUsage::RenderAttachment}));
        EXPECT_EQ(poisoned_textures, poisoned_before + 1);
        const auto expect_zero = [&](gpu::Aspect aspect) {
            const auto bytes = must(device_->read_texture(texture, aspect));
            EXPECT_EQ(bytes, std::vector<std::byte>(bytes.size()));
        };
        if (gpu::has_color(format)) expect_zero(gpu::Aspect::Color);
        if (gpu::has_depth(format)) expect_zero(gpu::Aspect::DepthOnly);
        if (gpu::has_stencil(format)) expect_zero(gpu::Aspect::StencilOnly);
    }
}

}  // namespace
}  // namespace gnomon::gl_tests
