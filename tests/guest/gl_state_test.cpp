// SPDX-License-Identifier: MIT
//
// A guest leaves OpenGL's state as it found it: all of it is asked for before and after, by a list
// that is not the backend's own, with values that are nobody's defaults.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include <gnomon/gl/backend.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/shadow_pass/guest_pass.hpp>
#include <gnomon/shadow_pass/light_masks.hpp>

#include "tests/guest/gl_host.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

using Snapshot = std::map<std::string, std::vector<double>>;

// `host`: anything that finds functions.
template <class Function, class Host>
Function load(const Host& host, const char* name) {
    return reinterpret_cast<Function>(host.find(name));
}
#define LOAD(host, name) load<decltype(&::name)>(host, #name)

struct Value {
    const char* name;
    GLenum token;
    int count;
};
#define V1(token) \
    { #token, token, 1 }
constexpr Value values[] = {
    V1(GL_ACTIVE_TEXTURE),
    V1(GL_ARRAY_BUFFER_BINDING),
    V1(GL_COPY_READ_BUFFER_BINDING),
    V1(GL_COPY_WRITE_BUFFER_BINDING),
    V1(GL_CULL_FACE_MODE),
    V1(GL_CURRENT_PROGRAM),
    V1(GL_DEPTH_FUNC),
    V1(GL_DEPTH_WRITEMASK),
    V1(GL_DRAW_FRAMEBUFFER_BINDING),
    V1(GL_ELEMENT_ARRAY_BUFFER_BINDING),
    V1(GL_FRONT_FACE),
    V1(GL_LINE_WIDTH),
    V1(GL_LOGIC_OP_MODE),
    V1(GL_PACK_ALIGNMENT),
    V1(GL_PACK_ROW_LENGTH),
    V1(GL_PACK_SKIP_PIXELS),
    V1(GL_PACK_SKIP_ROWS),
    V1(GL_PACK_SWAP_BYTES),
    V1(GL_PIXEL_PACK_BUFFER_BINDING),
    V1(GL_PIXEL_UNPACK_BUFFER_BINDING),
    V1(GL_POINT_SIZE),
    V1(GL_POLYGON_OFFSET_FACTOR),
    V1(GL_POLYGON_OFFSET_UNITS),
    V1(GL_PRIMITIVE_RESTART_INDEX),
    V1(GL_PROVOKING_VERTEX),
    V1(GL_READ_FRAMEBUFFER_BINDING),
    V1(GL_RENDERBUFFER_BINDING),
    V1(GL_SAMPLE_COVERAGE_VALUE),
    V1(GL_STENCIL_BACK_FAIL),
    V1(GL_STENCIL_BACK_FUNC),
    V1(GL_STENCIL_BACK_PASS_DEPTH_FAIL),
    V1(GL_STENCIL_BACK_PASS_DEPTH_PASS),
    V1(GL_STENCIL_BACK_REF),
    V1(GL_STENCIL_BACK_VALUE_MASK),
    V1(GL_STENCIL_BACK_WRITEMASK),
    V1(GL_STENCIL_CLEAR_VALUE),
    V1(GL_STENCIL_FAIL),
    V1(GL_STENCIL_FUNC),
    V1(GL_STENCIL_PASS_DEPTH_FAIL),
    V1(GL_STENCIL_PASS_DEPTH_PASS),
    V1(GL_STENCIL_REF),
    V1(GL_STENCIL_VALUE_MASK),
    V1(GL_STENCIL_WRITEMASK),
    V1(GL_UNIFORM_BUFFER_BINDING),
    V1(GL_UNPACK_ALIGNMENT),
    V1(GL_UNPACK_ROW_LENGTH),
    V1(GL_UNPACK_SKIP_PIXELS),
    V1(GL_UNPACK_SKIP_ROWS),
    V1(GL_UNPACK_SWAP_BYTES),
    V1(GL_VERTEX_ARRAY_BINDING),
    V1(GL_CLIP_ORIGIN),
    V1(GL_CLIP_DEPTH_MODE),
    V1(GL_READ_BUFFER),
    V1(GL_DRAW_BUFFER0),
    V1(GL_DRAW_BUFFER1),
    V1(GL_DEPTH_CLEAR_VALUE),
    V1(GL_DRAW_INDIRECT_BUFFER_BINDING),
    {"GL_BLEND_COLOR", GL_BLEND_COLOR, 4},
    {"GL_COLOR_CLEAR_VALUE", GL_COLOR_CLEAR_VALUE, 4},
    {"GL_POLYGON_MODE", GL_POLYGON_MODE, 1},
};

struct Switch {
    const char* name;
    GLenum token;
};
#define S1(token) \
    { #token, token }
constexpr Switch switches[] = {
    S1(GL_CLIP_DISTANCE0),
    S1(GL_CLIP_DISTANCE5),
    S1(GL_COLOR_LOGIC_OP),
    S1(GL_CULL_FACE),
    S1(GL_DEPTH_CLAMP),
    S1(GL_DEPTH_TEST),
    S1(GL_DITHER),
    S1(GL_FRAMEBUFFER_SRGB),
    S1(GL_LINE_SMOOTH),
    S1(GL_MULTISAMPLE),
    S1(GL_POLYGON_OFFSET_FILL),
    S1(GL_POLYGON_OFFSET_LINE),
    S1(GL_POLYGON_SMOOTH),
    S1(GL_PRIMITIVE_RESTART),
    S1(GL_PRIMITIVE_RESTART_FIXED_INDEX),
    S1(GL_PROGRAM_POINT_SIZE),
    S1(GL_RASTERIZER_DISCARD),
    S1(GL_SAMPLE_ALPHA_TO_COVERAGE),
    S1(GL_SAMPLE_ALPHA_TO_ONE),
    S1(GL_SAMPLE_COVERAGE),
    S1(GL_SAMPLE_MASK),
    S1(GL_SAMPLE_SHADING),
    S1(GL_STENCIL_TEST),
    S1(GL_TEXTURE_CUBE_MAP_SEAMLESS),
};

template <class Host>
Snapshot snapshot(const Host& host) {
    Snapshot all;
    const auto get_double = LOAD(host, glGetDoublev);
    const auto get_double_i = LOAD(host, glGetDoublei_v);
    const auto get_integer_i = LOAD(host, glGetIntegeri_v);
    const auto get_integer64_i = LOAD(host, glGetInteger64i_v);
    const auto is_enabled = LOAD(host, glIsEnabled);
    const auto is_enabled_i = LOAD(host, glIsEnabledi);
    const auto active_texture = LOAD(host, glActiveTexture);
    for (const Value& value : values) {
        std::array<double, 16> got{};
        get_double(value.token, got.data());
        all[value.name] = {got.begin(), got.begin() + value.count};
    }
    for (const Switch& s : switches) all[s.name] = {1.0 * is_enabled(s.token)};
    for (GLuint i = 0; i < 8; ++i) {
        const std::string at = " " + std::to_string(i);
        all["GL_BLEND" + at] = {1.0 * is_enabled_i(GL_BLEND, i)};
        all["GL_SCISSOR_TEST" + at] = {1.0 * is_enabled_i(GL_SCISSOR_TEST, i)};
        std::array<GLint, 4> mask{};
        get_integer_i(GL_COLOR_WRITEMASK, i, mask.data());
        all["GL_COLOR_WRITEMASK" + at] = {mask.begin(), mask.end()};
        std::array<double, 4> box{};
        for (const GLenum token :
             std::initializer_list<GLenum>{GL_VIEWPORT, GL_SCISSOR_BOX, GL_DEPTH_RANGE}) {
            get_double_i(token, i, box.data());
            all[std::to_string(token) + at] = {box.begin(),
                                               box.begin() + (token == GL_DEPTH_RANGE ? 2 : 4)};
        }
        for (const GLenum token : std::initializer_list<GLenum>{
                 GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA, GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB,
                 GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA, GL_UNIFORM_BUFFER_BINDING}) {
            GLint got = 0;
            get_integer_i(token, i, &got);
            all[std::to_string(token) + at] = {1.0 * got};
        }
        for (const GLenum token :
             std::initializer_list<GLenum>{GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE}) {
            GLint64 got = 0;
            get_integer64_i(token, i, &got);
            all[std::to_string(token) + at] = {static_cast<double>(got)};
        }
    }
    const auto active = static_cast<GLenum>(all["GL_ACTIVE_TEXTURE"][0]);
    for (GLuint unit = 0; unit < 12; ++unit) {
        active_texture(GL_TEXTURE0 + unit);
        for (const GLenum token :
             std::initializer_list<GLenum>{GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_MULTISAMPLE,
                                           GL_TEXTURE_BINDING_3D, GL_SAMPLER_BINDING}) {
            double got = 0.0;
            get_double(token, &got);
            all[std::to_string(token) + " of unit " + std::to_string(unit)] = {got};
        }
    }
    active_texture(active);
    return all;
}

/// Everything other than its default, and other than gnomon would leave it.
void make_strange(const GlHost& host) {
    const auto enable = LOAD(host, glEnable);
    const auto disable = LOAD(host, glDisable);
    for (const Switch& s : switches) {
        const GLboolean on = LOAD(host, glIsEnabled)(s.token);
        if (on != GL_FALSE) {
            disable(s.token);
        } else {
            enable(s.token);
        }
    }
    GLuint names[4] = {};
    LOAD(host, glGenBuffers)(4, names);
    const auto bind_buffer = LOAD(host, glBindBuffer);
    for (const GLuint name : names) {
        bind_buffer(GL_ARRAY_BUFFER, name);
        LOAD(host, glBufferData)(GL_ARRAY_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
    }
    bind_buffer(GL_COPY_READ_BUFFER, names[0]);
    bind_buffer(GL_COPY_WRITE_BUFFER, names[1]);
    bind_buffer(GL_PIXEL_PACK_BUFFER, names[2]);
    bind_buffer(GL_PIXEL_UNPACK_BUFFER, names[3]);
    LOAD(host, glBindBufferBase)(GL_UNIFORM_BUFFER, 0, names[0]);
    LOAD(host, glBindBufferRange)(GL_UNIFORM_BUFFER, 1, names[1], 1024, 512);
    bind_buffer(GL_UNIFORM_BUFFER, names[2]);
    GLuint textures[4] = {};
    LOAD(host, glGenTextures)(4, textures);
    GLuint sampler = 0;
    LOAD(host, glGenSamplers)(1, &sampler);
    const auto active_texture = LOAD(host, glActiveTexture);
    const auto bind_texture = LOAD(host, glBindTexture);
    for (GLuint unit = 0; unit < 10; ++unit) {
        active_texture(GL_TEXTURE0 + unit);
        bind_texture(GL_TEXTURE_2D, textures[unit % 2]);
        bind_texture(GL_TEXTURE_2D_MULTISAMPLE, textures[2]);
        bind_texture(GL_TEXTURE_3D, textures[3]);
        LOAD(host, glBindSampler)(unit, sampler);
    }
    active_texture(GL_TEXTURE0 + 3);
    GLuint vertex_array = 0;
    LOAD(host, glGenVertexArrays)(1, &vertex_array);
    LOAD(host, glBindVertexArray)(vertex_array);
    bind_buffer(GL_ELEMENT_ARRAY_BUFFER, names[1]);
    LOAD(host, glVertexAttribPointer)(2, 3, GL_FLOAT, GL_FALSE, 24, nullptr);
    LOAD(host, glEnableVertexAttribArray)(2);
    for (GLuint i = 0; i < 8; ++i) {
        if (i % 2 == 1) LOAD(host, glEnablei)(GL_BLEND, i);
        LOAD(host, glBlendEquationSeparatei)(i, GL_FUNC_SUBTRACT, GL_MAX);
        LOAD(host, glBlendFuncSeparatei)
        (i, GL_DST_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_ZERO, GL_SRC_ALPHA);
        LOAD(host, glColorMaski)(i, i % 2, i / 2 % 2, i / 4 % 2, 1);
        const auto shift = static_cast<GLfloat>(i);
        LOAD(host, glViewportIndexedf)(i, 3.0F + shift, 5.0F, 70.0F, 50.0F);
        LOAD(host, glScissorIndexed)(i, 1, static_cast<GLint>(i), 33, 44);
        LOAD(host, glDepthRangeIndexed)(i, 0.25, 0.75 - 0.01 * shift);
        if (i % 3 == 0) LOAD(host, glEnablei)(GL_SCISSOR_TEST, i);
    }
    LOAD(host, glBlendColor)(0.1F, 0.2F, 0.3F, 0.4F);
    LOAD(host, glClearColor)(0.5F, 0.6F, 0.7F, 0.8F);
    LOAD(host, glClearDepth)(0.125);
    LOAD(host, glClearStencil)(77);
    LOAD(host, glCullFace)(GL_FRONT);
    LOAD(host, glFrontFace)(GL_CW);
    LOAD(host, glDepthFunc)(GL_NOTEQUAL);
    LOAD(host, glDepthMask)(GL_FALSE);
    LOAD(host, glStencilFuncSeparate)(GL_FRONT, GL_LEQUAL, 3, 0x3F);
    LOAD(host, glStencilFuncSeparate)(GL_BACK, GL_GREATER, 9, 0x1F);
    LOAD(host, glStencilOpSeparate)(GL_FRONT, GL_INVERT, GL_INCR, GL_REPLACE);
    LOAD(host, glStencilOpSeparate)(GL_BACK, GL_ZERO, GL_DECR_WRAP, GL_INVERT);
    LOAD(host, glStencilMaskSeparate)(GL_FRONT, 0x0F);
    LOAD(host, glStencilMaskSeparate)(GL_BACK, 0x70);
    LOAD(host, glPolygonMode)(GL_FRONT_AND_BACK, GL_LINE);
    LOAD(host, glPolygonOffset)(2.5F, 7.0F);
    LOAD(host, glPointSize)(3.0F);
    LOAD(host, glLineWidth)(1.0F);
    LOAD(host, glProvokingVertex)(GL_LAST_VERTEX_CONVENTION);
    LOAD(host, glClipControl)(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    for (const GLenum token :
         std::initializer_list<GLenum>{GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT}) {
        LOAD(host, glPixelStorei)(token, 2);
    }
    for (const GLenum token : std::initializer_list<GLenum>{
             GL_PACK_ROW_LENGTH, GL_UNPACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_UNPACK_SKIP_ROWS,
             GL_PACK_SKIP_PIXELS, GL_UNPACK_SKIP_PIXELS}) {
        LOAD(host, glPixelStorei)(token, 5);
    }
    LOAD(host, glPixelStorei)(GL_UNPACK_SWAP_BYTES, 1);
    while (host.gl().GetError() != GL_NO_ERROR) {
    }
}

std::string differences(const Snapshot& before, const Snapshot& after) {
    std::string text;
    for (const auto& [name, value] : before) {
        if (after.at(name) == value) continue;
        text += name + ": " + std::to_string(value[0]) + " became " +
                std::to_string(after.at(name)[0]) + "\n";
    }
    return text;
}

struct StateCase {
    std::string name;
    Result<std::unique_ptr<gl::Context>> (*create)();
    gl::StencilPath path;
    std::string silhouette;
    std::uint32_t samples = 1;
};

void PrintTo(const StateCase& c, std::ostream* out) { *out << c.name; }

class GuestState : public testing::TestWithParam<StateCase> {};

TEST_P(GuestState, everything_is_as_it_was_after_every_call) {
    auto context = GetParam().create();
    if (!context) GTEST_SKIP() << context.error().message;
    const std::uint32_t samples = GetParam().samples;
    GlHost host(std::move(*context),
                {.name = "host", .zero_to_one = true, .upper_left = true, .samples = samples});
    const Setting setting = rows().front().make();
    host.draw(setting);
    const GLuint mask_name = host.make_mask(GL_R32UI, samples);
    std::vector<GLuint> share_names;
    for (int i = 0; i < 3; ++i) share_names.push_back(host.make_mask(GL_R8));
    make_strange(host);
    const Snapshot before = snapshot(host);
    EXPECT_EQ(before.at("GL_PROVOKING_VERTEX")[0], 1.0 * GL_LAST_VERTEX_CONVENTION);
    const auto expect_unchanged = [&](const char* after_what) {
        EXPECT_EQ(differences(before, snapshot(host)), "") << "after " << after_what;
        EXPECT_EQ(host.gl().GetError(), GLenum{GL_NO_ERROR}) << "after " << after_what;
    };
    {
        auto adopted = must(gl::adopt_current_context([&](const char* n) { return host.find(n); }));
        gpu::Device device(
            must(gl::create_backend(std::move(adopted), {.stencil_path = GetParam().path})));
        expect_unchanged("the device was made");
        auto target = must(device.import_texture({.label = "host",
                                                  .width = row_width,
                                                  .height = row_height,
                                                  .format = gpu::Format::Depth24UnormStencil8,
                                                  .usage = gpu::TextureUsage::RenderAttachment,
                                                  .sample_count = samples},
                                                 host.target()));
        expect_unchanged("the target was imported");
        {
            const auto texture = must(device.create_texture(
                {.label = "own",
                 .width = 4,
                 .height = 4,
                 .format = gpu::Format::Rgba8Unorm,
                 .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc |
                          gpu::TextureUsage::CopyDst}));
            expect_unchanged("a texture was made");
            must(device.write_texture(texture, 0, std::vector<std::byte>(64)));
            expect_unchanged("a texture was written");
            static_cast<void>(must(device.read_texture(texture)));
            expect_unchanged("a texture was read");
        }
        const shadow_pass::GuestPassDesc desc{.target = target,
                                              .size = {row_width, row_height},
                                              .sample_count = samples,
                                              .conventions = host.conventions()};
        auto guest = must(shadow_pass::GuestPass::create(device, desc));
        expect_unchanged("the pass was made");
        auto system = must(shadows::ShadowSystem::create({.silhouette = GetParam().silhouette}));
        const GlHost::Camera camera = host.camera_of(setting);
        const auto view = must(shadows::view_of_host(camera.view_from_world, camera.clip_from_view,
                                                     host.conventions()));
        auto frame = system.begin_frame();
        scene::ShadowAdapter adapter;
        must(adapter.submit(setting.scene, frame));
        const shadows::DrawList& list = std::move(frame).finish(view.view);
        must(guest.prepare(list, view));
        expect_unchanged("the volumes were uploaded");
        EXPECT_GT(guest.stats().draw_calls, 0U);
        for (std::size_t light = 0; light < list.lights.size(); ++light) {
            must(guest.count(light));
            expect_unchanged("a light was counted");
        }
        const auto import = [&](GLuint name, gpu::Format format, std::uint32_t mask_samples) {
            auto mask = must(device.import_texture({.label = "mask",
                                                    .width = row_width,
                                                    .height = row_height,
                                                    .format = format,
                                                    .usage = gpu::TextureUsage::RenderAttachment,
                                                    .sample_count = mask_samples},
                                                   GlHost::mask_target(name)));
            expect_unchanged("a mask was imported");
            return mask;
        };
        std::vector<gpu::Texture> shares;
        for (const GLuint name : share_names) {
            shares.push_back(import(name, gpu::Format::R8Unorm, 1));
        }
        const auto bits = import(mask_name, gpu::Format::R32Uint, samples);
        for (const std::vector<gpu::TextureId>& ids :
             {std::vector<gpu::TextureId>{bits},
              std::vector<gpu::TextureId>(shares.begin(), shares.end())}) {
            auto masks =
                must(shadow_pass::LightMasks::create(device, {.host = desc, .masks = ids}));
            expect_unchanged("light masks were made");
            must(masks.prepare(list, view));
            must(masks.resolve());
            expect_unchanged("light masks were resolved");
        }
        expect_unchanged("light masks were freed");
        target.reset();
        expect_unchanged("the target was let go");
    }
    expect_unchanged("the device was freed");
}

INSTANTIATE_TEST_SUITE_P(
    Contexts, GuestState,
    testing::Values(
        StateCase{"osmesa", gl::create_osmesa_context, gl::StencilPath::Separate, "auto"},
        StateCase{"two_side", gl::create_osmesa_context, gl::StencilPath::TwoSide, "auto"},
        StateCase{"four_samples", gl::create_osmesa_context, gl::StencilPath::Separate, "auto", 4},
        StateCase{"egl_quads", gl::create_egl_context, gl::StencilPath::Separate, "gpu_quads"}),
    [](const auto& info) { return info.param.name; });

// Finds functions, as GlHost does, of a context in which nothing was done.
struct Untouched {
    gl::Context& context;
    [[nodiscard]] void* find(const char* name) const { return context.get_proc_address(name); }
};

// What HostState::Defaults says is OpenGL's default afterwards.
bool is_left_as_default(const std::string& name) {
    for (const Switch& s : switches) {
        if (name == s.name) return true;
    }
    for (const char* listed :
         {"GL_DEPTH_WRITEMASK", "GL_STENCIL_WRITEMASK", "GL_STENCIL_BACK_WRITEMASK",
          "GL_DRAW_FRAMEBUFFER_BINDING", "GL_READ_FRAMEBUFFER_BINDING", "GL_CURRENT_PROGRAM",
          "GL_VERTEX_ARRAY_BINDING", "GL_CULL_FACE_MODE", "GL_FRONT_FACE", "GL_PROVOKING_VERTEX",
          "GL_CLIP_ORIGIN", "GL_CLIP_DEPTH_MODE"}) {
        if (name == listed) return true;
    }
    const std::string depth_range = std::to_string(GL_DEPTH_RANGE) + " ";
    for (const std::string& begin : {std::string("GL_BLEND "), std::string("GL_SCISSOR_TEST "),
                                     std::string("GL_COLOR_WRITEMASK "), depth_range}) {
        if (name.starts_with(begin)) return true;
    }
    return false;
}

Snapshot listed_defaults(const Snapshot& all) {
    Snapshot listed;
    for (const auto& [name, value] : all) {
        if (!is_left_as_default(name)) continue;
        // All ones, of which only those of the stencil's bits count.
        const bool of_stencil = name.starts_with("GL_STENCIL_") && name.ends_with("WRITEMASK");
        listed[name] = of_stencil ? std::vector{std::fmod(value[0], 256.0)} : value;
    }
    return listed;
}

// A host that asks for it has GL's defaults instead.
TEST(GuestDefaults, defaults_are_left_where_they_are_asked_for) {
    auto untouched = gl::create_osmesa_context();
    if (!untouched) GTEST_SKIP() << untouched.error().message;
    must((*untouched)->make_current());
    const Snapshot defaults = listed_defaults(snapshot(Untouched{**untouched}));
    EXPECT_GE(defaults.size(), std::size(switches) + 12U + 4U * 8U);
    GlHost host(must(gl::create_osmesa_context()), {.name = "host", .upper_left = true});
    const Setting setting = rows().front().make();
    const GLuint mask_name = host.make_mask(GL_R32UI);
    host.draw(setting);
    gpu::Device device(must(gl::create_backend(must(gl::adopt_current_context(
        [&](const char* n) { return host.find(n); }, gl::HostState::Defaults)))));
    gpu::TextureDesc desc{.label = "host",
                          .width = row_width,
                          .height = row_height,
                          .format = gpu::Format::Depth24UnormStencil8,
                          .usage = gpu::TextureUsage::RenderAttachment};
    gl::HostTarget framebuffer = host.target();
    framebuffer.clip_upper_left = true;
    const auto target = must(device.import_texture(desc, framebuffer));
    desc.format = gpu::Format::R32Uint;
    const auto mask = must(device.import_texture(desc, GlHost::mask_target(mask_name)));
    const shadow_pass::GuestPassDesc guest_desc{
        .target = target, .size = {row_width, row_height}, .conventions = host.conventions()};
    auto guest = must(shadow_pass::GuestPass::create(device, guest_desc));
    auto masks =
        must(shadow_pass::LightMasks::create(device, {.host = guest_desc, .masks = {mask}}));
    auto system = must(shadows::ShadowSystem::create());
    const GlHost::Camera camera = host.camera_of(setting);
    const auto view = must(
        shadows::view_of_host(camera.view_from_world, camera.clip_from_view, host.conventions()));
    auto frame = system.begin_frame();
    scene::ShadowAdapter adapter;
    must(adapter.submit(setting.scene, frame));
    const shadows::DrawList& list = std::move(frame).finish(view.view);
    must(guest.prepare(list, view));
    must(masks.prepare(list, view));
    const auto expect_defaults = [&](const char* after_what, const auto& call) {
        host.draw(setting);
        EXPECT_NE(differences(defaults, listed_defaults(snapshot(host))), "")
            << "before " << after_what;
        must(call());
        EXPECT_EQ(differences(defaults, listed_defaults(snapshot(host))), "")
            << "after " << after_what;
    };
    expect_defaults("a light was counted", [&] { return guest.count(0); });
    expect_defaults("light masks were resolved", [&] { return masks.resolve(); });
    EXPECT_THAT(host.read_bits(mask_name), testing::Contains(testing::Ne(0U)));
}

// Nor is an error of the host's gnomon's there, where errors are not asked for at each call.
TEST(GuestDefaults, an_error_of_the_hosts_is_not_gnomons) {
    auto context = gl::create_osmesa_context();
    if (!context) GTEST_SKIP() << context.error().message;
    GlHost host(std::move(*context), {.name = "host"});
    gpu::Device device(must(gl::create_backend(must(gl::adopt_current_context(
        [&](const char* n) { return host.find(n); }, gl::HostState::Defaults)))));
    const auto err = [&] { host.gl().Enable(0xFFFF); };
    err();
    auto buffer =
        must(device.create_buffer({.label = "own",
                                   .size = 64,
                                   .usage = gpu::BufferUsage::Vertex | gpu::BufferUsage::CopyDst |
                                            gpu::BufferUsage::CopySrc}));
    err();
    EXPECT_TRUE(device.write_buffer(buffer, 0, std::vector<std::byte>(64)));
    EXPECT_EQ(host.gl().GetError(), GLenum{GL_INVALID_ENUM});  // left alone
    err();
    EXPECT_TRUE(device.read_buffer(buffer, 0, 64));
    err();
    EXPECT_TRUE(device.wait_idle());
    EXPECT_EQ(host.gl().GetError(), GLenum{GL_NO_ERROR});
}

}  // namespace
}  // namespace gnomon::test
