// SPDX-License-Identifier: MIT
//
// Which of our contexts is current on this thread. Mesa's OSMesa, EGL and GLX share one dispatch
// table per thread, and each believes that its own context stays current until told otherwise: so
// whoever takes over has to release the one before through the very library that bound it. Shared
// libraries show it, though it is not public: gnomon::gl_glfw is a library of its own.
#pragma once

#include <gnomon/core/result.hpp>

#pragma GCC visibility push(default)
namespace gnomon::gl {

/// What a context file provides; the rest of the rules live in current_context.cpp.
class CurrentContext {
public:
    CurrentContext() = default;
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;

    /// Makes this one current; does nothing when it is already.
    Status take();
    /// Releases this one if it is current on this thread. Every context calls it before it dies.
    void leave();

protected:
    ~CurrentContext() = default;

private:
    virtual Status bind() = 0;
    virtual void unbind() = 0;
    /// Asks the platform's library, since a host may have bound a context of its own.
    [[nodiscard]] virtual bool is_bound() const = 0;
};

}  // namespace gnomon::gl
#pragma GCC visibility pop
