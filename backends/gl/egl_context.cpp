// SPDX-License-Identifier: MIT
//
// EGL without a surface: on the first device that is no software, else on Mesa's surfaceless
// platform, else on any device that EGL lists. The declarations are repeated here so that EGL's
// headers are not needed to build.
#include <array>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string_view>
#include <vector>

#include "internal/current_context.hpp"
#include "internal/shared_library.hpp"

#include <gnomon/gl/context.hpp>

namespace gnomon::gl {
namespace {

using EglInt = std::int32_t;
using EglBoolean = unsigned int;
using EglEnum = unsigned int;
using EglDisplay = void*;
using EglConfig = void*;
using EglHandle = void*;
using EglSurface = void*;
using EglDevice = void*;

constexpr EglEnum egl_opengl_api = 0x30A2;
constexpr EglInt egl_extensions = 0x3055;
constexpr EglInt egl_surface_type = 0x3033;
constexpr EglInt egl_renderable_type = 0x3040;
constexpr EglInt egl_opengl_bit = 0x0008;
constexpr EglInt egl_none = 0x3038;
constexpr EglInt egl_context_major_version = 0x3098;
constexpr EglInt egl_context_minor_version = 0x30FB;
constexpr EglInt egl_context_opengl_profile_mask = 0x30FD;
constexpr EglInt egl_context_opengl_core_profile_bit = 1;
constexpr EglEnum egl_platform_surfaceless_mesa = 0x31DD;
constexpr EglEnum egl_platform_device_ext = 0x313F;

struct EglFunctions {
    void* (*get_proc_address)(const char*) = nullptr;
    const char* (*query_string)(EglDisplay, EglInt name) = nullptr;
    EglInt (*get_error)() = nullptr;
    EglBoolean (*initialize)(EglDisplay, EglInt* major, EglInt* minor) = nullptr;
    EglBoolean (*bind_api)(EglEnum) = nullptr;
    EglBoolean (*choose_config)(EglDisplay, const EglInt* attributes, EglConfig*, EglInt size,
                                EglInt* count) = nullptr;
    EglHandle (*create_context)(EglDisplay, EglConfig, EglHandle share,
                                const EglInt* attributes) = nullptr;
    EglBoolean (*destroy_context)(EglDisplay, EglHandle) = nullptr;
    EglBoolean (*make_current)(EglDisplay, EglSurface draw, EglSurface read, EglHandle) = nullptr;
    EglHandle (*get_current_context)() = nullptr;
    // extensions
    EglDisplay (*get_platform_display)(EglEnum platform, void* native,
                                       const EglInt* attributes) = nullptr;
    EglBoolean (*query_devices)(EglInt size, EglDevice*, EglInt* count) = nullptr;
    const char* (*query_device_string)(EglDevice, EglInt name) = nullptr;
};

std::string error_code(const EglFunctions& egl) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "0x%04X", static_cast<unsigned>(egl.get_error()));
    return text.data();
}

bool lists(const char* extensions, std::string_view name) {
    std::string_view rest = extensions != nullptr ? extensions : "";
    while (!rest.empty()) {
        const std::size_t end = rest.find(' ');
        if (rest.substr(0, end) == name) return true;
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    }
    return false;
}

class EglContext final : public Context, private CurrentContext {
public:
    EglContext(const EglFunctions& functions, EglDisplay display, EglHandle handle,
               std::string description)
        : egl_(functions),
          display_(display),
          handle_(handle),
          description_(std::move(description)) {}
    // The display stays initialised: EGL hands the same one to everybody in the process.
    ~EglContext() override {
        leave();
        egl_.destroy_context(display_, handle_);
    }

    Status make_current() override { return take(); }
    [[nodiscard]] void* get_proc_address(const char* name) const override {
        return egl_.get_proc_address(name);
    }
    [[nodiscard]] std::string description() const override { return description_; }

private:
    Status bind() override {
        if (egl_.make_current(display_, nullptr, nullptr, handle_) == 0) {
            return fail(ErrorCode::Unsupported,
                        "eglMakeCurrent refused a context without a surface (EGL error " +
                            error_code(egl_) + ").");
        }
        return {};
    }
    void unbind() override { egl_.make_current(display_, nullptr, nullptr, nullptr); }
    [[nodiscard]] bool is_bound() const override { return egl_.get_current_context() == handle_; }

    EglFunctions egl_;
    EglDisplay display_;
    EglHandle handle_;
    std::string description_;
};

enum class Renderers { Hardware, Any };

struct OpenDisplay {
    EglDisplay display = nullptr;
    std::string description;
};

/// A context without a surface and without a config is all that is asked of a display.
bool usable(const EglFunctions& egl, EglDisplay display) {
    return display != nullptr && egl.initialize(display, nullptr, nullptr) != 0 &&
           lists(egl.query_string(display, egl_extensions), "EGL_KHR_surfaceless_context");
}

std::vector<EglDevice> list_devices(const EglFunctions& egl, const char* client_extensions) {
    EglInt count = 0;
    if (!lists(client_extensions, "EGL_EXT_platform_device") || egl.query_devices == nullptr ||
        egl.query_devices(0, nullptr, &count) == 0) {
        return {};
    }
    std::vector<EglDevice> devices(static_cast<std::size_t>(count));
    if (egl.query_devices(count, devices.data(), &count) == 0) return {};
    devices.resize(static_cast<std::size_t>(count));
    return devices;
}

bool is_software(const EglFunctions& egl, EglDevice device) {
    return egl.query_device_string != nullptr &&
           lists(egl.query_device_string(device, egl_extensions), "EGL_MESA_device_software");
}

/// The first of the devices that can be used, of hardware or of software.
EglDisplay display_of(const EglFunctions& egl, std::span<const EglDevice> devices, bool software) {
    for (EglDevice device : devices) {
        if (is_software(egl, device) != software) continue;
        EglDisplay display = egl.get_platform_display(egl_platform_device_ext, device, nullptr);
        if (usable(egl, display)) return display;
    }
    return nullptr;
}

Result<OpenDisplay> open_display(const EglFunctions& egl, const char* client_extensions,
                                 Renderers renderers) {
    const std::vector<EglDevice> devices = list_devices(egl, client_extensions);
    if (EglDisplay display = display_of(egl, devices, false)) {
        return OpenDisplay{display, "EGL device"};
    }
    if (renderers == Renderers::Hardware) {
        return fail(ErrorCode::Unsupported, "EGL lists no device but software.");
    }
    if (lists(client_extensions, "EGL_MESA_platform_surfaceless")) {
        EglDisplay display =
            egl.get_platform_display(egl_platform_surfaceless_mesa, nullptr, nullptr);
        if (usable(egl, display)) return OpenDisplay{display, "EGL surfaceless"};
    }
    if (EglDisplay display = display_of(egl, devices, true)) {
        return OpenDisplay{display, "EGL device"};
    }
    return fail(ErrorCode::Unsupported,
                "EGL offers no display that works without a window: EGL_MESA_platform_surfaceless "
                "or EGL_EXT_platform_device is needed, with EGL_KHR_surfaceless_context.");
}

Result<std::unique_ptr<Context>> create_context(Renderers renderers) {
    const auto library = SharedLibrary::open("libEGL.so.1", "an EGL context");
    if (!library) return forward_error(library);

    EglFunctions egl;
    for (const Status& loaded :
         {library->load(egl.get_proc_address, "eglGetProcAddress"),
          library->load(egl.query_string, "eglQueryString"),
          library->load(egl.get_error, "eglGetError"),
          library->load(egl.initialize, "eglInitialize"), library->load(egl.bind_api, "eglBindAPI"),
          library->load(egl.choose_config, "eglChooseConfig"),
          library->load(egl.create_context, "eglCreateContext"),
          library->load(egl.destroy_context, "eglDestroyContext"),
          library->load(egl.make_current, "eglMakeCurrent"),
          library->load(egl.get_current_context, "eglGetCurrentContext")}) {
        if (!loaded) return forward_error(loaded);
    }
    const char* client_extensions = egl.query_string(nullptr, egl_extensions);
    if (!lists(client_extensions, "EGL_EXT_platform_base")) {
        return fail(ErrorCode::Unsupported,
                    "EGL lacks EGL_EXT_platform_base, without which there is no display without a "
                    "window.");
    }
    egl.get_platform_display = reinterpret_cast<decltype(egl.get_platform_display)>(
        egl.get_proc_address("eglGetPlatformDisplayEXT"));
    egl.query_devices =
        reinterpret_cast<decltype(egl.query_devices)>(egl.get_proc_address("eglQueryDevicesEXT"));
    egl.query_device_string = reinterpret_cast<decltype(egl.query_device_string)>(
        egl.get_proc_address("eglQueryDeviceStringEXT"));
    if (egl.get_platform_display == nullptr) {
        return fail(ErrorCode::Unsupported, "EGL lacks eglGetPlatformDisplayEXT.");
    }

    const auto display = open_display(egl, client_extensions, renderers);
    if (!display) return forward_error(display);
    if (egl.bind_api(egl_opengl_api) == 0) {
        return fail(ErrorCode::Unsupported,
                    "This EGL (" + display->description + ") does not offer OpenGL, only ES.");
    }
    // Any config that renders OpenGL will do, since no surface is ever made; a surface type of 0
    // keeps EGL from asking for windows.
    const std::array config_attributes{egl_renderable_type, egl_opengl_bit, egl_surface_type,
                                       EglInt{0}, egl_none};
    EglConfig config = nullptr;
    EglInt count = 0;
    if (egl.choose_config(display->display, config_attributes.data(), &config, 1, &count) == 0 ||
        count == 0) {
        return fail(ErrorCode::Unsupported,
                    "This EGL (" + display->description + ") has no config that renders OpenGL.");
    }
    EglHandle handle = nullptr;
    for (const EglInt minor : {5, 3}) {
        const std::array attributes{egl_context_major_version,
                                    EglInt{4},
                                    egl_context_minor_version,
                                    minor,
                                    egl_context_opengl_profile_mask,
                                    egl_context_opengl_core_profile_bit,
                                    egl_none};
        handle = egl.create_context(display->display, config, nullptr, attributes.data());
        if (handle != nullptr) break;
    }
    if (handle == nullptr) {
        return fail(ErrorCode::Unsupported,
                    "This EGL (" + display->description +
                        ") cannot make a core context of OpenGL 4.5 nor of 4.3 (EGL error " +
                        error_code(egl) + ").");
    }
    auto context =
        std::make_unique<EglContext>(egl, display->display, handle, display->description);
    if (const Status bound = context->make_current(); !bound) return forward_error(bound);
    return context;
}

}  // namespace

Result<std::unique_ptr<Context>> create_egl_context() { return create_context(Renderers::Any); }

Result<std::unique_ptr<Context>> create_headless_context() {
    if (auto hardware = create_context(Renderers::Hardware)) return hardware;
    auto osmesa = create_osmesa_context();
    if (osmesa) return osmesa;
    auto egl = create_context(Renderers::Any);
    if (egl) return egl;
    return fail(ErrorCode::Unsupported,
                "No OpenGL context: " + osmesa.error().message + " " + egl.error().message);
}

}  // namespace gnomon::gl
