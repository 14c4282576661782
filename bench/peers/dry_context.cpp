// SPDX-License-Identifier: MIT
#include "dry_context.hpp"

#include <array>
#include <string_view>

#include <GL/glcorearb.h>

namespace gnomon::peers {

namespace {

template <class F>
struct Nothing;
template <class... Arguments>
struct Nothing<void(APIENTRYP)(Arguments...)> {
    static void APIENTRY call(Arguments...) {}
};

struct Replaced {
    std::string_view name;
    void* function;
};

template <class F>
Replaced by_nothing(std::string_view name) {
    return {name, reinterpret_cast<void*>(&Nothing<F>::call)};
}

// Every function of the core that has the device draw, fill or copy pixels.
const auto& replaced() {
    static const std::array table{
        by_nothing<PFNGLDRAWARRAYSPROC>("glDrawArrays"),
        by_nothing<PFNGLDRAWARRAYSINSTANCEDPROC>("glDrawArraysInstanced"),
        by_nothing<PFNGLDRAWARRAYSINSTANCEDBASEINSTANCEPROC>("glDrawArraysInstancedBaseInstance"),
        by_nothing<PFNGLDRAWARRAYSINDIRECTPROC>("glDrawArraysIndirect"),
        by_nothing<PFNGLDRAWELEMENTSPROC>("glDrawElements"),
        by_nothing<PFNGLDRAWELEMENTSBASEVERTEXPROC>("glDrawElementsBaseVertex"),
        by_nothing<PFNGLDRAWELEMENTSINSTANCEDPROC>("glDrawElementsInstanced"),
        by_nothing<PFNGLDRAWELEMENTSINSTANCEDBASEVERTEXPROC>("glDrawElementsInstancedBaseVertex"),
        by_nothing<PFNGLDRAWELEMENTSINSTANCEDBASEVERTEXBASEINSTANCEPROC>(
            "glDrawElementsInstancedBaseVertexBaseInstance"),
        by_nothing<PFNGLDRAWELEMENTSINDIRECTPROC>("glDrawElementsIndirect"),
        by_nothing<PFNGLMULTIDRAWARRAYSPROC>("glMultiDrawArrays"),
        by_nothing<PFNGLMULTIDRAWARRAYSINDIRECTPROC>("glMultiDrawArraysIndirect"),
        by_nothing<PFNGLMULTIDRAWELEMENTSPROC>("glMultiDrawElements"),
        by_nothing<PFNGLMULTIDRAWELEMENTSBASEVERTEXPROC>("glMultiDrawElementsBaseVertex"),
        by_nothing<PFNGLMULTIDRAWELEMENTSINDIRECTPROC>("glMultiDrawElementsIndirect"),
        by_nothing<PFNGLDISPATCHCOMPUTEPROC>("glDispatchCompute"),
        by_nothing<PFNGLCLEARPROC>("glClear"),
        by_nothing<PFNGLCLEARBUFFERFIPROC>("glClearBufferfi"),
        by_nothing<PFNGLCLEARBUFFERFVPROC>("glClearBufferfv"),
        by_nothing<PFNGLCLEARBUFFERIVPROC>("glClearBufferiv"),
        by_nothing<PFNGLCLEARBUFFERUIVPROC>("glClearBufferuiv"),
        by_nothing<PFNGLBLITFRAMEBUFFERPROC>("glBlitFramebuffer"),
    };
    return table;
}

class DryContext final : public gl::Context {
public:
    explicit DryContext(std::unique_ptr<gl::Context> context) : context_(std::move(context)) {}

    Status make_current() override { return context_->make_current(); }
    void* get_proc_address(const char* name) const override {
        for (const Replaced& it : replaced()) {
            if (it.name == name) return it.function;
        }
        return context_->get_proc_address(name);
    }
    std::string description() const override { return context_->description() + ", dry"; }

private:
    std::unique_ptr<gl::Context> context_;
};

}  // namespace

std::unique_ptr<gl::Context> make_dry(std::unique_ptr<gl::Context> context) {
    return std::make_unique<DryContext>(std::move(context));
}

}  // namespace gnomon::peers
