// SPDX-License-Identifier: MIT
//
// The context that a host made, has made current and keeps. Nothing is known of its platform but
// the way to its functions.
#include <utility>

#include <gnomon/gl/context.hpp>

#include "internal/gl_functions.hpp"

namespace gnomon::gl {
namespace {

class AdoptedContext final : public Context {
public:
    AdoptedContext(GetProcAddress get_proc_address, HostState state)
        : get_proc_address_(std::move(get_proc_address)), state_(state) {}

    Status make_current() override { return {}; }
    [[nodiscard]] void* get_proc_address(const char* name) const override {
        return get_proc_address_(name);
    }
    [[nodiscard]] std::string description() const override { return "the host's"; }
    [[nodiscard]] bool is_adopted() const override { return true; }
    [[nodiscard]] bool restores_state() const override { return state_ == HostState::Restored; }

private:
    GetProcAddress get_proc_address_;
    HostState state_;
};

}  // namespace

Result<std::unique_ptr<Context>> adopt_current_context(GetProcAddress get_proc_address,
                                                       HostState state) {
    if (!get_proc_address) {
        return fail(ErrorCode::InvalidInput,
                    "There is no function (null) to find OpenGL's functions with.");
    }
    const auto get_string =
        reinterpret_cast<decltype(&::glGetString)>(get_proc_address("glGetString"));
    if (get_string == nullptr || get_string(GL_VERSION) == nullptr) {
        return fail(ErrorCode::InvalidInput,
                    "No OpenGL context is current on this thread: make the host's current before "
                    "it is adopted, and whenever gnomon is called.");
    }
    return std::make_unique<AdoptedContext>(std::move(get_proc_address), state);
}

}  // namespace gnomon::gl
