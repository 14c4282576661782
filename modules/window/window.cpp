// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <gnomon/core/expects.hpp>
#include <gnomon/window/window.hpp>

#include "internal/devices.hpp"
#include "internal/events.hpp"

namespace gnomon::window {

namespace {

constexpr double minimised_wait_s = 0.1;

// GLFW is a global; it lives while any window does.
class GlfwUse {
public:
    static Result<GlfwUse> begin() {
        if (count_ == 0 && glfwInit() == GLFW_FALSE) {
            return fail(ErrorCode::Unsupported, fmt::format("There is no display for a window: {}",
                                                            internal::last_glfw_error()));
        }
        ++count_;
        return GlfwUse();
    }
    GlfwUse(GlfwUse&& other) noexcept : active_(std::exchange(other.active_, false)) {}
    GlfwUse& operator=(GlfwUse&&) = delete;
    ~GlfwUse() {
        if (active_ && --count_ == 0) glfwTerminate();
    }

private:
    GlfwUse() = default;
    bool active_ = true;
    inline static int count_ = 0;
};

struct Place {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

Place place_of(GLFWwindow* window) {
    Place place;
    glfwGetWindowPos(window, &place.x, &place.y);
    glfwGetWindowSize(window, &place.width, &place.height);
    return place;
}

// The monitor that most of the window lies on.
GLFWmonitor* monitor_of(const Place& place) {
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    GLFWmonitor* best = glfwGetPrimaryMonitor();
    int most = 0;
    for (int i = 0; i < count; ++i) {
        const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
        if (mode == nullptr) continue;
        int x = 0;
        int y = 0;
        glfwGetMonitorPos(monitors[i], &x, &y);
        const int width = std::min(place.x + place.width, x + mode->width) - std::max(place.x, x);
        const int height =
            std::min(place.y + place.height, y + mode->height) - std::max(place.y, y);
        if (width <= 0 || height <= 0 || width * height <= most) continue;
        most = width * height;
        best = monitors[i];
    }
    return best;
}

}  // namespace

struct Window::State {
    explicit State(GlfwUse used) : glfw(std::move(used)) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() { close(); }

    GlfwUse glfw;
    WindowDesc desc;
    GLFWwindow* window = nullptr;
    std::optional<gpu::Device> device;  // gone before the window is
    Backend backend = Backend::Gl;
    input::Input input;
    std::optional<Place> windowed;  // where it was before it filled the screen
    bool captured = false;

    void close() {
        device.reset();
        if (window != nullptr) glfwDestroyWindow(window);
        window = nullptr;
    }
    Status open(Backend wanted, const std::optional<Place>& place);
};

Status Window::State::open(Backend wanted, const std::optional<Place>& place) {
    internal::set_window_hints(wanted);
    // Shown when it stands where it shall.
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    const int width = place ? place->width : static_cast<int>(desc.size_px.x);
    const int height = place ? place->height : static_cast<int>(desc.size_px.y);
    window = glfwCreateWindow(width, height, desc.title.c_str(), nullptr, nullptr);
    if (window == nullptr) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("No window for the backend \"{}\": {}", name_of(wanted),
                                internal::last_glfw_error()));
    }
    auto made = internal::create_device(window, wanted, desc.vsync, desc.message_sink);
    if (!made) {
        close();
        return forward_error(made);
    }
    device.emplace(std::move(*made));
    backend = wanted;
    if (place) glfwSetWindowPos(window, place->x, place->y);
    internal::report_events(window, input);
    glfwShowWindow(window);
    return {};
}

Result<Window> Window::open(const WindowDesc& desc) {
    if (desc.size_px.x == 0 || desc.size_px.y == 0 || desc.size_px.x > 32768 ||
        desc.size_px.y > 32768) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("A window of {} x {} pixels: each side has 1 to 32768.",
                                desc.size_px.x, desc.size_px.y));
    }
    auto glfw = GlfwUse::begin();
    if (!glfw) return forward_error(glfw);
    auto state = std::make_unique<State>(std::move(*glfw));
    state->desc = desc;
    const std::vector<Backend> wanted = desc.backend ? std::vector{*desc.backend} : backends();
    std::string reasons;
    for (const Backend backend : wanted) {
        const Status opened = state->open(backend, std::nullopt);
        if (opened) return Window(std::move(state));
        if (wanted.size() == 1) return forward_error(opened);
        reasons += fmt::format(" {}: {}", name_of(backend), opened.error().message);
    }
    return fail(ErrorCode::Unsupported, "No backend can show a window here." + reasons);
}

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

const input::Input& Window::poll(double wait_s) {
    State& s = *state_;
    s.input.begin_frame();
    const double wait = is_minimised() ? std::max(wait_s, minimised_wait_s) : wait_s;
    if (wait > 0.0) {
        glfwWaitEventsTimeout(wait);
    } else {
        glfwPollEvents();
    }
    const bool has_focus =
        s.window != nullptr && glfwGetWindowAttrib(s.window, GLFW_FOCUSED) == GLFW_TRUE;
    s.input.see_gamepad(internal::read_gamepad(), has_focus);
    return s.input;
}

const input::Input& Window::input() const { return state_->input; }

bool Window::is_minimised() const {
    const State& s = *state_;
    if (s.window == nullptr || glfwGetWindowAttrib(s.window, GLFW_ICONIFIED) == GLFW_TRUE) {
        return true;
    }
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(s.window, &width, &height);
    return width <= 0 || height <= 0;
}

glm::uvec2 Window::size_px() const {
    if (is_minimised()) return {0, 0};
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(state_->window, &width, &height);
    return {width, height};
}

float Window::content_scale() const {
    float x = 1.0F;
    float y = 1.0F;
    if (state_->window != nullptr) glfwGetWindowContentScale(state_->window, &x, &y);
    return x > 0.0F ? x : 1.0F;
}

gpu::Device& Window::device() {
    GNOMON_EXPECTS(state_->device.has_value());
    return *state_->device;
}

bool Window::has_device() const { return state_->device.has_value(); }

Backend Window::backend() const { return state_->backend; }

Status Window::present(gpu::TextureId picture) {
    if (is_minimised()) return {};
    return device().present(picture);
}

Status Window::reopen(Backend backend) {
    State& s = *state_;
    const Backend before = s.backend;
    std::optional<Place> place;
    const bool was_fullscreen = is_fullscreen();
    if (s.window != nullptr) place = was_fullscreen ? s.windowed : place_of(s.window);
    s.close();
    s.input.release_all();  // the next window does not hear of keys that are let go
    const Status opened = s.open(backend, place);
    if (!opened && backend != before) {
        // The error that is returned is the first one: it says why the backend did not change.
        const Status back = s.open(before, place);
        if (!back) return opened;
    }
    if (s.window != nullptr) {
        set_fullscreen(was_fullscreen);
        capture_cursor(s.captured);
    }
    return opened;
}

void Window::set_vsync(bool vsync) {
    state_->desc.vsync = vsync;
    // It goes by the context that is current, which is this window's where it is OpenGL's and no
    // other is used in between.
    if (state_->window != nullptr && glfwGetCurrentContext() == state_->window) {
        glfwSwapInterval(vsync ? 1 : 0);
    }
}

void Window::set_title(const std::string& title) {
    state_->desc.title = title;
    if (state_->window != nullptr) glfwSetWindowTitle(state_->window, title.c_str());
}

void Window::set_size(const glm::uvec2& size_px) {
    State& s = *state_;
    if (s.window == nullptr || is_fullscreen()) return;
    const Place place = place_of(s.window);
    const glm::uvec2 now = this->size_px();
    // GLFW counts in the desktop's units.
    const double units = now.x > 0 ? static_cast<double>(place.width) / now.x : 1.0;
    glfwSetWindowSize(s.window, std::max(1, static_cast<int>(size_px.x * units)),
                      std::max(1, static_cast<int>(size_px.y * units)));
}

void Window::set_fullscreen(bool fullscreen) {
    State& s = *state_;
    if (s.window == nullptr || fullscreen == is_fullscreen()) return;
    if (fullscreen) {
        s.windowed = place_of(s.window);
        GLFWmonitor* monitor = monitor_of(*s.windowed);
        if (monitor == nullptr) return;
        const GLFWvidmode* mode = glfwGetVideoMode(monitor);
        if (mode == nullptr) return;  // it was just unplugged
        glfwSetWindowMonitor(s.window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    } else {
        const Place place = s.windowed.value_or(Place{0, 0, 1280, 720});
        glfwSetWindowMonitor(s.window, nullptr, place.x, place.y, place.width, place.height,
                             GLFW_DONT_CARE);
    }
}

bool Window::is_fullscreen() const {
    return state_->window != nullptr && glfwGetWindowMonitor(state_->window) != nullptr;
}

void Window::capture_cursor(bool captured) {
    state_->captured = captured;
    if (state_->window == nullptr) return;
    glfwSetInputMode(state_->window, GLFW_CURSOR,
                     captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

Result<std::optional<std::string>> exchange(Window& window, Backend backend,
                                            const std::function<void()>& let_go,
                                            const std::function<Status()>& attach) {
    const Backend before = window.backend();
    const auto reopen = [&](Backend wanted) {
        let_go();
        return window.reopen(wanted);
    };
    Status opened = reopen(backend);
    if (!opened && !window.has_device()) return forward_error(opened);
    Status attached = attach();
    if (!attached && attached.error().code != ErrorCode::DeviceLost && window.backend() != before) {
        // It has windows, but cannot draw this in them.
        opened = std::exchange(attached, Status());
        if (const Status back = reopen(before); !back) return forward_error(opened);
        attached = attach();
    }
    if (!attached) return forward_error(attached);
    return opened ? std::nullopt : std::optional(opened.error().message);
}

}  // namespace gnomon::window
