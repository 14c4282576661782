// SPDX-License-Identifier: MIT
//
// Which device is taken, what can be switched off, and the sentences when there is none.
#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/support/paths.hpp"
#include "tests/vk/fixture.hpp"

namespace gnomon::vk_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class Adapter : public DeviceFixture {
protected:
    Result<gpu::Device> open_with(vk::BackendOptions options) {
        return open(log, std::move(options));
    }
    std::string device_name() const {
        const std::string& adapter = device->caps().adapter;
        return adapter.substr(0, adapter.find(','));
    }
};

/// Sets an environment variable for as long as it lives.
class ScopedVariable {
public:
    ScopedVariable(const char* name, const std::string& value) : name_(name) {
        if (const char* before = std::getenv(name)) {
            before_ = before;
        }
        setenv(name, value.c_str(), 1);
    }
    ~ScopedVariable() {
        if (before_) {
            setenv(name_, before_->c_str(), 1);
        } else {
            unsetenv(name_);
        }
    }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;

private:
    const char* name_;
    std::optional<std::string> before_;
};

TEST_F(Adapter, SaysWhatItIs) {
    const gpu::Caps& caps = device->caps();
    EXPECT_EQ(caps.backend, "vk");
    EXPECT_EQ(caps.stencil_path, "native");
    EXPECT_THAT(caps.adapter, HasSubstr(", Vulkan 1."));
    EXPECT_TRUE(caps.features.exact_clip_space);
    EXPECT_TRUE(caps.features.depth24unorm_stencil8 || caps.features.depth32float_stencil8);
    EXPECT_GE(caps.limits.max_texture_dimension_2d, 4096U);
    EXPECT_GE(caps.limits.max_color_attachments, 4U);
    EXPECT_GE(caps.limits.max_buffer_size, 1U << 28U);
    EXPECT_EQ(256U % caps.limits.min_uniform_buffer_offset_alignment, 0U);
}

TEST_F(Adapter, IsFoundByPartOfItsNameInAnyCase) {
    std::string part = device_name().substr(1, 6);
    for (char& c : part) {
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    const Result<gpu::Device> found = open_with({.adapter = part});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_THAT(found->caps().adapter, StartsWith(device_name()));
}

TEST_F(Adapter, ThatIsNotThereIsNamedTogetherWithThoseThatAre) {
    const Result<gpu::Device> found = open_with({.adapter = "No Such Device"});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(found.error().message,
                StartsWith("No Vulkan device's name contains 'No Such Device': there is '"));
    EXPECT_THAT(found.error().message, HasSubstr(device_name()));
}

struct FeatureCase {
    const char* name;
    bool gpu::Features::*feature;
};

TEST_F(Adapter, LosesTheFeaturesThatAreDisabled) {
    for (const auto& [name, feature] : {
             FeatureCase{"depthClamp", &gpu::Features::unclipped_depth},
             FeatureCase{"depthBounds", &gpu::Features::depth_bounds},
             FeatureCase{"occlusionQueryPrecise", &gpu::Features::occlusion_query},
             FeatureCase{"timestamps", &gpu::Features::timestamp_query},
             FeatureCase{"sampleRate", &gpu::Features::sample_shading},
             FeatureCase{"sampledStencil", &gpu::Features::sampled_stencil},
         }) {
        SCOPED_TRACE(name);
        const Result<gpu::Device> without = open_with({.disabled_features = {name}});
        ASSERT_TRUE(without) << without.error().message;
        EXPECT_FALSE(without->caps().features.*feature);
    }
}

TEST_F(Adapter, LosesTheFormatsThatAreDisabled) {
    const gpu::Features& features = device->caps().features;
    if (!features.depth24unorm_stencil8 || !features.depth32float_stencil8) {
        GTEST_SKIP() << "The adapter has one of the two formats alone.";
    }
    const Result<gpu::Device> without_32 = open_with({.disabled_features = {"D32_SFLOAT_S8_UINT"}});
    ASSERT_TRUE(without_32) << without_32.error().message;
    EXPECT_FALSE(without_32->caps().features.depth32float_stencil8);
    EXPECT_TRUE(without_32->caps().features.depth24unorm_stencil8);
    const Result<gpu::Device> without_24 = open_with({.disabled_features = {"D24_UNORM_S8_UINT"}});
    ASSERT_TRUE(without_24) << without_24.error().message;
    EXPECT_FALSE(without_24->caps().features.depth24unorm_stencil8);
}

TEST_F(Adapter, WithoutADepthStencilFormatDoesNotFit) {
    const Result<gpu::Device> none =
        open_with({.adapter = device_name(),
                   .disabled_features = {"D32_SFLOAT_S8_UINT", "D24_UNORM_S8_UINT"}});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(none.error().message,
                HasSubstr("it draws to neither D32_SFLOAT_S8_UINT nor D24_UNORM_S8_UINT"));
}

TEST_F(Adapter, KnowsNoOtherFeaturesThanItsOwn) {
    const Result<gpu::Device> none = open_with({.disabled_features = {"depthCramp"}});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::InvalidInput);
    EXPECT_THAT(none.error().message, StartsWith("'depthCramp' cannot be disabled"));
}

TEST_F(Adapter, BlendsTargetsAlikeWithoutIndependentBlend) {
    Result<gpu::Device> without = open_with({.disabled_features = {"independentBlend"}});
    ASSERT_TRUE(without) << without.error().message;
    Painter painter{*without, 4, 4};  // one target blends like itself
    const gpu::Texture target = painter.make_target();
    painter.set_color(0, 1, 0);
    painter.fill(target);
    EXPECT_EQ(painter.read_uniform(target), (Rgba8{0, 255, 0, 255}));
}

TEST_F(Adapter, HasNothingToPresentOnWithoutAWindow) {
    const Painter painter{*device, 4, 4};
    const Status presented = device->present(painter.make_target());
    ASSERT_FALSE(presented);
    EXPECT_EQ(presented.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(presented.error().message, HasSubstr("without a window"));
}

TEST(Instance, WithoutTheValidationLayerSaysSo) {
    // The loader looks for explicit layers in this folder alone.
    const ScopedVariable folder{"VK_LAYER_PATH", test::source_folder() / "tests/vk/shaders"};
    const auto backend = vk::create_backend({.validation = true});
    ASSERT_FALSE(backend);
    EXPECT_EQ(backend.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(backend.error().message,
                HasSubstr("VK_LAYER_KHRONOS_validation is not installed."));
}

TEST(Instance, WithoutADriverSaysSo) {
    // By both of its names: the newer one wins where it is set.
    const ScopedVariable driver{"VK_ICD_FILENAMES", test::source_folder() / "no_driver.json"};
    const ScopedVariable newer{"VK_DRIVER_FILES", test::source_folder() / "no_driver.json"};
    const auto backend = vk::create_backend();
    ASSERT_FALSE(backend);
    EXPECT_EQ(backend.error().code, ErrorCode::Unsupported);
    EXPECT_FALSE(backend.error().message.empty());
}

TEST(Instance, WithAWindowNeedsItsExtensions) {
    vk::BackendOptions options;
    options.window = vk::Window{.instance_extensions = {"VK_KHR_no_such_surface"},
                                .create_surface = [](void*) { return std::uint64_t{0}; },
                                .framebuffer_size = [] { return vk::Extent{}; }};
    const auto backend = vk::create_backend(options);
    ASSERT_FALSE(backend);
    EXPECT_EQ(backend.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(backend.error().message, HasSubstr("VK_KHR_no_such_surface"));
}

}  // namespace
}  // namespace gnomon::vk_test
