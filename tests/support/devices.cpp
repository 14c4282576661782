// SPDX-License-Identifier: MIT
#include "tests/support/devices.hpp"

#include <gnomon/gpu/null_backend.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string_view>
#include <utility>

#if GNOMON_HAS_GL
#include <gnomon/gl/backend.hpp>
#endif
#if GNOMON_HAS_VK
#include <gnomon/vk/backend.hpp>
#endif
#if GNOMON_HAS_WEBGPU
#include <gnomon/webgpu/backend.hpp>
#endif
#include "examples/09_skeleton_backend.hpp"

/// Read by the leak sanitizer where it is on: Mesa keeps a few hundred bytes for each OSMesa
/// context for ever. gnomon's own leaks of GL objects are counted by tests/gl/lifetime_test.cpp.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa.so\n"; }

namespace gnomon::test {
namespace {

using BackendResult = Result<std::unique_ptr<gpu::Backend>>;

#if GNOMON_HAS_GL
using CreateContext = Result<std::unique_ptr<gl::Context>> (*)();

BackendResult create_gl(CreateContext create_context, gl::StencilPath path, gpu::MessageSink sink) {
    auto context = create_context();
    if (!context) return forward_error(context);
    return gl::create_backend(std::move(*context), {.stencil_path = path,
                                                    .disabled_extensions = {},
                                                    .debug = true,
                                                    .message_sink = std::move(sink)});
}

DeviceCase gl_case(std::string name, CreateContext create_context, gl::StencilPath path) {
    return {.name = std::move(name),
            .draws = true,
            .create_backend = [create_context, path](gpu::MessageSink sink) {
                return create_gl(create_context, path, std::move(sink));
            }};
}

std::vector<DeviceCase> gl_cases() {
    using enum gl::StencilPath;
    const char* variable = std::getenv("GNOMON_TEST_GL");
    if (variable != nullptr && std::string_view(variable) == "egl") {
        return {gl_case("gl_egl_separate", gl::create_egl_context, Separate),
                gl_case("gl_egl_two_side", gl::create_egl_context, TwoSide),
                gl_case("gl_egl_two_pass", gl::create_egl_context, TwoPass)};
    }
    return {gl_case("gl_osmesa_separate", gl::create_osmesa_context, Separate),
            gl_case("gl_osmesa_two_side", gl::create_osmesa_context, TwoSide),
            gl_case("gl_osmesa_two_pass", gl::create_osmesa_context, TwoPass),
            gl_case("gl_egl", gl::create_egl_context, Separate)};
}
#endif

#if GNOMON_HAS_VK
DeviceCase vk_case(const std::string& adapter) {
    return {.name = "vk", .draws = true, .create_backend = [adapter](gpu::MessageSink sink) {
                vk::BackendOptions options;
                options.adapter = adapter;
                options.validation = true;
                options.message_sink = std::move(sink);
                if (std::getenv("GNOMON_TEST_Y_UP_BY_VIEWPORT") != nullptr) {
                    options.y_up = vk::YUp::Viewport;
                }
                return vk::create_backend(options);
            }};
}
#endif

/// The example of a backend, in front of another one.
DeviceCase skeleton_case(const DeviceCase& api) {
    return {.name = "skeleton_" + api.name,
            .draws = api.draws,
            .create_backend = [api](gpu::MessageSink sink) -> BackendResult {
                auto backend = api.create_backend(std::move(sink));
                if (!backend) return backend;
                return std::make_unique<skeleton::Backend>(gpu::Device(std::move(*backend)));
            }};
}

struct SharedDevice {
    std::unique_ptr<TestDevice> device;
    Error error;
};

std::map<std::string, SharedDevice>& shared_devices() {
    static std::map<std::string, SharedDevice> devices;
    return devices;
}

/// Frees the shared devices while the drivers' libraries are still whole, which static destructors
/// would not.
class FreeSharedDevices : public testing::Environment {
public:
    void TearDown() override { shared_devices().clear(); }
};

[[maybe_unused]] const testing::Environment* const free_shared_devices =
    testing::AddGlobalTestEnvironment(new FreeSharedDevices);

}  // namespace

void PrintTo(const DeviceCase& device_case, std::ostream* out) { *out << device_case.name; }

std::string device_case_name(const testing::TestParamInfo<DeviceCase>& info) {
    return info.param.name;
}

std::vector<DeviceCase> all_devices() {
    std::vector<DeviceCase> cases;
    const char* variable = std::getenv("GNOMON_TEST_ADAPTER");
    [[maybe_unused]] const std::string adapter = variable != nullptr ? variable : "";
#if GNOMON_HAS_GL
    if (adapter.empty()) cases = gl_cases();
#endif
#if GNOMON_HAS_VK
    cases.push_back(vk_case(adapter));
#endif
#if GNOMON_HAS_WEBGPU
    cases.push_back({.name = "webgpu", .draws = true, .create_backend = [](gpu::MessageSink sink) {
                         return webgpu::create_backend({.message_sink = std::move(sink)});
                     }});
#endif
    cases.push_back({.name = "null", .draws = false, .create_backend = [](const gpu::MessageSink&) {
                         return BackendResult(gpu::create_null_backend());
                     }});
    if (std::getenv("GNOMON_TEST_SKELETON") != nullptr) {
        std::vector<DeviceCase> skeletons;
        for (const char* name : {"gl_osmesa_separate", "vk", "null"}) {
            const auto api = std::ranges::find(cases, name, &DeviceCase::name);
            if (api != cases.end()) skeletons.push_back(skeleton_case(*api));
        }
        return skeletons;
    }
    return cases;
}

std::vector<DeviceCase> drawing_devices() {
    std::vector<DeviceCase> cases = all_devices();
    std::erase_if(cases, [](const DeviceCase& device_case) { return !device_case.draws; });
    return cases;
}

Result<std::unique_ptr<TestDevice>> open_device(const DeviceCase& device_case) {
    auto log = std::make_shared<MessageLog>(device_case.name);
    auto backend = device_case.create_backend(make_sink(log));
    if (!backend) return forward_error(backend);
    return std::make_unique<TestDevice>(
        TestDevice{.device = gpu::Device(std::move(*backend)), .log = std::move(log)});
}

Result<TestDevice*> shared_device(const DeviceCase& device_case) {
    auto found = shared_devices().find(device_case.name);
    if (found == shared_devices().end()) {
        SharedDevice shared;
        auto opened = open_device(device_case);
        if (opened) {
            shared.device = std::move(*opened);
        } else {
            shared.error = opened.error();
        }
        found = shared_devices().emplace(device_case.name, std::move(shared)).first;
    }
    if (!found->second.device) return tl::unexpected<Error>(found->second.error);
    return found->second.device.get();
}

std::string rasteriser_of(const gpu::Device& device) {
    const std::string& adapter = device.caps().adapter;
    for (const char* name : {"llvmpipe", "SwiftShader"}) {
        if (adapter.find(name) != std::string::npos) return name;
    }
    // What a browser calls it.
    return adapter.find("swiftshader") != std::string::npos ? "SwiftShader" : adapter;
}

bool is_required(const std::string& device_name) {
    const char* variable = std::getenv("GNOMON_REQUIRE_DEVICES");
    std::string_view rest = variable != nullptr ? variable : "";
    while (!rest.empty()) {
        const std::size_t end = rest.find(',');
        const std::string_view name = rest.substr(0, end);
        if (name == "all" || name == device_name) return true;
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    }
    return false;
}

std::size_t DeviceTest::number() const {
    const std::vector<DeviceCase> cases = all_devices();
    const auto found = std::ranges::find(cases, GetParam().name, &DeviceCase::name);
    return static_cast<std::size_t>(found - cases.begin());
}

void DeviceTest::SetUp() {
    const auto shared = shared_device(GetParam());
    if (!shared && is_required(GetParam().name)) {
        FAIL() << "The device \"" << GetParam().name
               << "\" is required here but cannot be made: " << shared.error().message;
    }
    if (!shared) {
        GTEST_SKIP() << "The device \"" << GetParam().name
                     << "\" cannot be made: " << shared.error().message;
    }
    shared_ = *shared;
    shared_->log->reset();
}

void DeviceTest::TearDown() {
    // What a driver says late still belongs to this test.
    if (shared_ != nullptr) {
        const Status idle = shared_->device.wait_idle();
        EXPECT_TRUE(idle) << idle.error().message;
    }
}

}  // namespace gnomon::test
