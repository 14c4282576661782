// SPDX-License-Identifier: MIT
//
// The devices that tests run on: a table of named rows for parametrised tests. A test on a device
// that this machine cannot make is skipped with the reason, or fails when the environment variable
// GNOMON_REQUIRE_DEVICES names the device (comma-separated, or "all"). Where GNOMON_TEST_ADAPTER is
// set, the Vulkan adapter with that in its name is the only device that draws: another rasteriser,
// whose masks differ from Mesa's within the band. Where GNOMON_TEST_GL is "egl", OpenGL is drawn
// with through EGL alone, on all stencil paths: a graphics card's, beside its Vulkan. Where
// GNOMON_TEST_Y_UP_BY_VIEWPORT is set, Vulkan draws as browsers do (vk::YUp::Viewport). Where
// GNOMON_TEST_SKELETON is set, the backend of examples/09_write_a_backend.cpp is tested instead, in
// front of one OpenGL, Vulkan and the null device.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>

#include "tests/support/message_log.hpp"

namespace gnomon::test {

struct DeviceCase {
    std::string name;
    bool draws = true;  ///< false for the null backend
    std::function<Result<std::unique_ptr<gpu::Backend>>(gpu::MessageSink)> create_backend;
};

/// gtest prints a case as its name.
void PrintTo(const DeviceCase& device_case, std::ostream* out);
[[nodiscard]] std::string device_case_name(const testing::TestParamInfo<DeviceCase>& info);

/// Every device that was built, the null one included.
[[nodiscard]] std::vector<DeviceCase> all_devices();
/// Those that draw.
[[nodiscard]] std::vector<DeviceCase> drawing_devices();

struct TestDevice {
    gpu::Device device;
    std::shared_ptr<MessageLog> log;
};

/// A device of the test's own. Slow on software drivers: prefer shared_device.
[[nodiscard]] Result<std::unique_ptr<TestDevice>> open_device(const DeviceCase& device_case);

/// One device per case and process, made when first asked for; a failure is remembered too. Freed
/// before the program ends.
[[nodiscard]] Result<TestDevice*> shared_device(const DeviceCase& device_case);

/// What turns triangles into samples: "llvmpipe" for OSMesa, EGL and lavapipe alike, "SwiftShader",
/// else the adapter's own name, which is another for OpenGL than for Vulkan.
[[nodiscard]] std::string rasteriser_of(const gpu::Device& device);

/// Whether GNOMON_REQUIRE_DEVICES names the device.
[[nodiscard]] bool is_required(const std::string& device_name);

/// A test on one device of the table: `device()` is ready when the body runs.
class DeviceTest : public testing::TestWithParam<DeviceCase> {
protected:
    void SetUp() override;
    void TearDown() override;

    [[nodiscard]] gpu::Device& device() { return shared_->device; }
    /// Its place among all_devices(): which share of many combinations falls to it (share.hpp).
    [[nodiscard]] std::size_t number() const;
    [[nodiscard]] MessageLog& log() { return *shared_->log; }
    [[nodiscard]] const gpu::Features& features() { return device().caps().features; }

private:
    TestDevice* shared_ = nullptr;
};

/// The value, or an exception with the error's sentence, which fails the test.
template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace gnomon::test
