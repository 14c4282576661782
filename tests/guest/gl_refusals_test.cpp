// SPDX-License-Identifier: MIT
//
// What a guest in OpenGL refuses of a host's, each with a sentence that says what to change.
#include <gmock/gmock.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <gnomon/gl/backend.hpp>
#include <gnomon/shadow_pass/light_masks.hpp>

#include "tests/guest/gl_host.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

class GuestRefusals : public testing::Test {
protected:
    void SetUp() override {
        auto context = gl::create_osmesa_context();
        if (!context) GTEST_SKIP() << context.error().message;
        host_ = std::make_unique<GlHost>(std::move(*context), HostWay{.name = "host"});
        device_.emplace(must(gl::create_backend(
            must(gl::adopt_current_context([this](const char* n) { return host_->find(n); })))));
    }
    void TearDown() override { device_.reset(); }

    std::string mask_refusal(const gl::HostTarget& target, gpu::TextureDesc desc) {
        desc.label = "mask";
        if (desc.width == 0) desc.width = row_width;
        desc.height = row_height;
        desc.usage = gpu::TextureUsage::RenderAttachment;
        const auto imported = device_->import_texture(desc, target);
        return imported ? "imported" : imported.error().message;
    }
    std::string refusal(const gl::HostTarget& target, gpu::TextureDesc desc = {}) {
        desc.label = "depth";
        if (desc.width == 0) desc.width = row_width;
        desc.height = row_height;
        if (desc.format == gpu::Format::Undefined) desc.format = gpu::Format::Depth24UnormStencil8;
        desc.usage = gpu::TextureUsage::RenderAttachment;
        const auto imported = device_->import_texture(desc, target);
        return imported ? "imported" : imported.error().message;
    }
    /// A framebuffer with this for depth, or without any.
    GLuint framebuffer_with(GLenum format, GLenum attachment, GLsizei samples = 0) {
        const HostGl& gl = host_->gl();
        GLuint framebuffer = 0;
        gl.GenFramebuffers(1, &framebuffer);
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        GLuint buffer = 0;
        gl.GenRenderbuffers(1, &buffer);
        gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
        gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, row_width, row_height);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
        return framebuffer;
    }

    template <class Function>
    [[nodiscard]] Function find(const char* name) const {
        return reinterpret_cast<Function>(host_->find(name));
    }

    std::unique_ptr<GlHost> host_;
    std::optional<gpu::Device> device_;
};

TEST_F(GuestRefusals, each_says_what_to_change) {
    EXPECT_EQ(refusal(host_->target()), "imported");
    EXPECT_THAT(refusal({.name = framebuffer_with(GL_RGBA8, GL_COLOR_ATTACHMENT0)}),
                HasSubstr("has 0 stencil bits, but shadows are counted in 8: attach depth and "
                          "stencil of GL_DEPTH24_STENCIL8"));
    EXPECT_THAT(refusal({.name = framebuffer_with(GL_STENCIL_INDEX8, GL_STENCIL_ATTACHMENT)}),
                HasSubstr("has no depth buffer"));
    EXPECT_THAT(
        refusal({.name = framebuffer_with(GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT)}),
        HasSubstr("has depth in floats of 32 bits, which is Depth32FloatStencil8"));
    EXPECT_THAT(
        refusal({.name = framebuffer_with(GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT, 4)}),
        HasSubstr("has 4 samples a pixel, not 1"));
    EXPECT_EQ(
        refusal({.name = framebuffer_with(GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT, 4)},
                {.sample_count = 4}),
        "imported");
    EXPECT_THAT(
        refusal({.name = framebuffer_with(GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT)},
                {.width = 17}),
        HasSubstr("has 320 x 240 pixels, not 17 x 240"));
    EXPECT_THAT(refusal(host_->target(), {.mip_level_count = 2}),
                HasSubstr("can only have 1 mip level, not 2"));
    EXPECT_THAT(refusal({.kind = gl::HostTarget::Kind::Texture}), HasSubstr("0 names no texture"));
    EXPECT_THAT(refusal({.kind = gl::HostTarget::Kind::Renderbuffer, .name = 4711}),
                HasSubstr("the host's renderbuffer 4711"));
    EXPECT_THAT(refusal({.name = 4711}), HasSubstr("the host's framebuffer 4711"));
    const auto nothing = device_->import_texture({.label = "depth",
                                                  .width = 4,
                                                  .height = 4,
                                                  .format = gpu::Format::Depth24UnormStencil8,
                                                  .usage = gpu::TextureUsage::RenderAttachment},
                                                 17);
    ASSERT_FALSE(nothing);
    EXPECT_THAT(nothing.error().message, HasSubstr("gl::HostTarget"));
    EXPECT_EQ(host_->gl().GetError(), GLenum{GL_NO_ERROR});
}

TEST_F(GuestRefusals, sizes_are_those_of_a_framebuffers_texture) {
    const HostGl& gl = host_->gl();
    GLuint framebuffer = 0;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexStorage2D(GL_TEXTURE_2D, 2, GL_DEPTH24_STENCIL8, 2 * row_width, 2 * row_height);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, texture, 1);
    EXPECT_EQ(refusal({.name = framebuffer}), "imported");
    EXPECT_THAT(refusal({.name = framebuffer}, {.width = 2 * row_width}),
                HasSubstr("has 320 x 240 pixels, not 640 x 240"));
    EXPECT_EQ(gl.GetError(), GLenum{GL_NO_ERROR});
}

TEST_F(GuestRefusals, sizes_are_those_of_the_hosts_texture) {
    GlHost other(must(gl::create_osmesa_context()),
                 {.name = "texture", .kind = gl::HostTarget::Kind::Texture});
    gpu::Device device(must(gl::create_backend(
        must(gl::adopt_current_context([&](const char* n) { return other.find(n); })))));
    const auto imported = device.import_texture({.label = "depth",
                                                 .width = 17,
                                                 .height = row_height,
                                                 .format = gpu::Format::Depth24UnormStencil8,
                                                 .usage = gpu::TextureUsage::RenderAttachment},
                                                other.target());
    ASSERT_FALSE(imported);
    EXPECT_THAT(imported.error().message, HasSubstr("has 320 x 240 pixels, not 17 x 240"));
}

TEST_F(GuestRefusals, a_mask_is_a_texture_of_what_was_said) {
    constexpr auto bits = gpu::Format::R32Uint;
    const GLuint mask = host_->make_mask(GL_R32UI);
    const gl::HostTarget target = GlHost::mask_target(mask);
    EXPECT_EQ(mask_refusal(target, {.format = bits}), "imported");
    EXPECT_THAT(mask_refusal(target, {.format = gpu::Format::R8Unorm}),
                HasSubstr("has the internal format 0x8236, not 0x8229"));
    EXPECT_THAT(mask_refusal(target, {.width = 17, .format = bits}),
                HasSubstr("has 320 x 240 pixels, not 17 x 240"));
    EXPECT_THAT(mask_refusal(target, {.format = bits, .sample_count = 4}),
                HasSubstr("as a 2D texture of 4 samples"));
    EXPECT_THAT(mask_refusal(target, {.format = bits, .mip_level_count = 2}),
                HasSubstr("can only have 1 mip level, not 2"));
    EXPECT_THAT(
        mask_refusal({.kind = gl::HostTarget::Kind::Renderbuffer, .name = 1}, {.format = bits}),
        HasSubstr("give a texture of the host's"));
    EXPECT_THAT(mask_refusal({.kind = gl::HostTarget::Kind::Texture}, {.format = bits}),
                HasSubstr("0 names no texture"));
    EXPECT_THAT(
        mask_refusal({.kind = gl::HostTarget::Kind::Texture, .name = 4711}, {.format = bits}),
        HasSubstr("the host's texture 4711"));
    EXPECT_EQ(host_->gl().GetError(), GLenum{GL_NO_ERROR});
}

// As little as the window's framebuffer, which OSMesa has without a stencil.
TEST_F(GuestRefusals, depth_in_an_array_takes_no_mask) {
    const HostGl& gl = host_->gl();
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, texture);
    find<decltype(&::glTexStorage3D)>("glTexStorage3D")(GL_TEXTURE_2D_ARRAY, 1, GL_DEPTH24_STENCIL8,
                                                        row_width, row_height, 3);
    GLuint framebuffer = 0;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    find<decltype(&::glFramebufferTextureLayer)>("glFramebufferTextureLayer")(
        GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, texture, 0, 2);
    gpu::TextureDesc desc{.label = "layer",
                          .width = row_width,
                          .height = row_height,
                          .format = gpu::Format::Depth24UnormStencil8,
                          .usage = gpu::TextureUsage::RenderAttachment};
    const auto layer = must(device_->import_texture(desc, gl::HostTarget{.name = framebuffer}));
    desc.label = "mask";
    desc.format = gpu::Format::R32Uint;
    const auto mask = must(device_->create_texture(desc));
    const auto masks = shadow_pass::LightMasks::create(
        *device_, {.host = {.target = layer, .size = {row_width, row_height}}, .masks = {mask}});
    ASSERT_FALSE(masks);
    EXPECT_EQ(masks.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(masks.error().message,
                HasSubstr("[Texture \"layer\"] takes no colours beside it, such as light masks"));
    EXPECT_THAT(masks.error().message,
                HasSubstr("such as the window's: draw the scene into a framebuffer that has"));
    EXPECT_EQ(gl.GetError(), GLenum{GL_NO_ERROR});
}

// A list of nothing, with a view for it.
void prepare_nothing(shadow_pass::LightMasks& masks) {
    const shadows::DrawList nothing;
    const auto view = must(shadows::view_of_host(
        glm::dmat4(1.0), glm::dmat4{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, -1}, {0, 0, -0.2, 0}},
        {}));
    must(masks.prepare(nothing, view));
}

TEST_F(GuestRefusals, samples_at_no_fixed_places_take_no_mask) {
    const HostGl& gl = host_->gl();
    const auto samples_anywhere = [&](GLenum format) {
        GLuint texture = 0;
        gl.GenTextures(1, &texture);
        gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture);
        gl.TexStorage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, 4, format, row_width, row_height,
                                   GL_FALSE);
        return texture;
    };
    const GLuint depth = samples_anywhere(GL_DEPTH24_STENCIL8);
    GLuint framebuffer = 0;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D_MULTISAMPLE,
                            depth, 0);
    gpu::TextureDesc desc{.label = "anywhere",
                          .width = row_width,
                          .height = row_height,
                          .format = gpu::Format::Depth24UnormStencil8,
                          .usage = gpu::TextureUsage::RenderAttachment,
                          .sample_count = 4};
    gpu::TextureDesc mask_desc = desc;
    mask_desc.label = "mask";
    mask_desc.format = gpu::Format::R32Uint;
    const auto mask = must(device_->create_texture(mask_desc));
    for (const gl::HostTarget& target :
         {gl::HostTarget{.name = framebuffer},
          gl::HostTarget{.kind = gl::HostTarget::Kind::Texture, .name = depth}}) {
        const auto imported = must(device_->import_texture(desc, target));
        const shadow_pass::GuestPassDesc host{
            .target = imported, .size = {row_width, row_height}, .sample_count = 4};
        EXPECT_TRUE(shadow_pass::GuestPass::create(*device_, host));
        const auto masks =
            shadow_pass::LightMasks::create(*device_, {.host = host, .masks = {mask}});
        ASSERT_FALSE(masks);
        EXPECT_THAT(masks.error().message,
                    HasSubstr("has its samples anywhere, while those of masks have fixed places: "
                              "make it with fixedsamplelocations GL_TRUE"));
    }
    EXPECT_THAT(mask_refusal(GlHost::mask_target(samples_anywhere(GL_R32UI)),
                             {.format = gpu::Format::R32Uint, .sample_count = 4}),
                HasSubstr("make it with fixedsamplelocations GL_TRUE"));
    EXPECT_EQ(gl.GetError(), GLenum{GL_NO_ERROR});
}

TEST_F(GuestRefusals, masks_lie_beside_the_depth_that_was_imported) {
    const HostGl& gl = host_->gl();
    const GLuint framebuffer = framebuffer_with(GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT);
    gpu::TextureDesc desc{.label = "depth",
                          .width = row_width,
                          .height = row_height,
                          .format = gpu::Format::Depth24UnormStencil8,
                          .usage = gpu::TextureUsage::RenderAttachment};
    const auto depth = must(device_->import_texture(desc, gl::HostTarget{.name = framebuffer}));
    desc.label = "mask";
    desc.format = gpu::Format::R32Uint;
    const auto mask = must(device_->create_texture(desc));
    auto masks = must(shadow_pass::LightMasks::create(
        *device_, {.host = {.target = depth, .size = {row_width, row_height}}, .masks = {mask}}));
    prepare_nothing(masks);
    must(masks.resolve());
    const auto attach = [&](GLenum attachment, GLuint renderbuffer) {
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, renderbuffer);
    };
    GLint before = 0;
    gl.GetIntegerv(GL_RENDERBUFFER_BINDING, &before);
    GLuint other = 0;
    gl.GenRenderbuffers(1, &other);
    gl.BindRenderbuffer(GL_RENDERBUFFER, other);
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, row_width, row_height);
    attach(GL_DEPTH_STENCIL_ATTACHMENT, other);
    const Status refused = masks.resolve();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidInput);
    EXPECT_THAT(refused.error().message,
                HasSubstr("has another depth or stencil than when it was imported: import it again "
                          "after they are attached"));
    attach(GL_DEPTH_STENCIL_ATTACHMENT, static_cast<GLuint>(before));
    must(masks.resolve());
    attach(GL_STENCIL_ATTACHMENT, 0);
    EXPECT_FALSE(masks.resolve());
    EXPECT_EQ(gl.GetError(), GLenum{GL_NO_ERROR});
}

TEST_F(GuestRefusals, depth_is_said_as_clip_control_has_it) {
    const auto answer = [&](shadows::HostDepth depth, const gl::HostTarget& host) {
        const auto target =
            must(device_->import_texture({.label = "depth",
                                          .width = row_width,
                                          .height = row_height,
                                          .format = gpu::Format::Depth24UnormStencil8,
                                          .usage = gpu::TextureUsage::RenderAttachment},
                                         host));
        const auto pass = shadow_pass::GuestPass::create(
            *device_, {.target = target,
                       .size = {row_width, row_height},
                       .conventions = {.depth = depth, .reversed = false}});
        return pass ? "made" : pass.error().message;
    };
    using shadows::HostDepth;
    gl::HostTarget host = host_->target();
    EXPECT_EQ(answer(HostDepth::MinusOneToOne, host), "made");
    EXPECT_THAT(answer(HostDepth::ZeroToOne, host),
                HasSubstr("HostConventions::depth of the guest pass is ZeroToOne, but what is "
                          "drawn into its target "
                          "[Texture \"depth\"] has depth from -1 to 1 in clip space: set it to "
                          "MinusOneToOne, or import the target while glClipControl() is set"));
    host.clip_zero_to_one = true;
    EXPECT_EQ(answer(HostDepth::ZeroToOne, host), "made");
    EXPECT_THAT(answer(HostDepth::MinusOneToOne, host), HasSubstr("set it to ZeroToOne, or"));
    host.clip_zero_to_one.reset();
    host_->gl().ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    EXPECT_EQ(answer(HostDepth::ZeroToOne, host), "made");
}

TEST_F(GuestRefusals, a_pass_is_made_for_the_target_as_it_was_imported) {
    const auto target = must(device_->import_texture({.label = "depth",
                                                      .width = row_width,
                                                      .height = row_height,
                                                      .format = gpu::Format::Depth24UnormStencil8,
                                                      .usage = gpu::TextureUsage::RenderAttachment},
                                                     host_->target()));
    const auto answer = [&](const shadow_pass::GuestPassDesc& desc) {
        const auto pass = shadow_pass::GuestPass::create(*device_, desc);
        return pass ? "made" : pass.error().message;
    };
    EXPECT_EQ(answer({.target = target, .size = {row_width, row_height}}), "made");
    EXPECT_THAT(answer({.size = {row_width, row_height}}),
                HasSubstr("There is no target for the guest pass"));
    EXPECT_THAT(answer({.target = target, .size = {row_width, 17}}),
                HasSubstr("[Texture \"depth\"] of the guest pass has 320 x 240 pixels of "
                          "Depth24UnormStencil8 with 1 sample, not 320 x 17 pixels of"));
    EXPECT_THAT(answer({.target = target,
                        .size = {row_width, row_height},
                        .format = gpu::Format::Depth32FloatStencil8}),
                HasSubstr("not 320 x 240 pixels of Depth32FloatStencil8"));
    EXPECT_THAT(answer({.target = target, .size = {row_width, row_height}, .sample_count = 4}),
                HasSubstr("with 4 samples."));
    EXPECT_THAT(
        answer({.target = {.index = 4711, .generation = 1}, .size = {row_width, row_height}}),
        HasSubstr("was freed"));
}

TEST_F(GuestRefusals, an_error_of_the_hosts_is_not_gnomons) {
    host_->gl().Enable(0xFFFF);
    EXPECT_TRUE(
        device_->create_buffer({.label = "own",
                                .size = 64,
                                .usage = gpu::BufferUsage::Vertex | gpu::BufferUsage::CopyDst}));
}

TEST_F(GuestRefusals, the_debug_callback_stays_the_hosts) {
    const auto backend = gl::create_backend(
        must(gl::adopt_current_context([this](const char* n) { return host_->find(n); })),
        {.debug = true});
    ASSERT_FALSE(backend);
    EXPECT_THAT(backend.error().message, HasSubstr("its debug callback is the host's"));
}

TEST(GuestContext, must_be_there) {
    EXPECT_THAT(gl::adopt_current_context(nullptr).error().message, HasSubstr("(null)"));
    const auto finds_nothing = [](const char*) -> void* { return nullptr; };
    EXPECT_THAT(gl::adopt_current_context(finds_nothing).error().message,
                HasSubstr("No OpenGL context is current"));
}

}  // namespace
}  // namespace gnomon::test
