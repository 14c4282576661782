// SPDX-License-Identifier: MIT
//
// OSMesa: Mesa's renderer into plain memory. The declarations are repeated here because
// <GL/osmesa.h> pulls in <GL/gl.h>, and because a machine that builds need not have it.
#include <GL/glcorearb.h>

#include <array>
#include <cstddef>

#include "internal/current_context.hpp"
#include "internal/shared_library.hpp"

#include <gnomon/gl/context.hpp>

namespace gnomon::gl {
namespace {

constexpr int osmesa_format = 0x22;
constexpr int osmesa_depth_bits = 0x30;
constexpr int osmesa_stencil_bits = 0x31;
constexpr int osmesa_accum_bits = 0x32;
constexpr int osmesa_profile = 0x33;
constexpr int osmesa_compat_profile = 0x35;
constexpr int osmesa_context_major_version = 0x36;
constexpr int osmesa_context_minor_version = 0x37;
constexpr int osmesa_rgba = GL_RGBA;

struct OsmesaContextRecord;
using OsmesaHandle = OsmesaContextRecord*;

struct OsmesaFunctions {
    OsmesaHandle (*create_context_attribs)(const int* attributes, OsmesaHandle share) = nullptr;
    void (*destroy_context)(OsmesaHandle) = nullptr;
    unsigned char (*make_current)(OsmesaHandle, void* buffer, GLenum type, GLsizei width,
                                  GLsizei height) = nullptr;
    OsmesaHandle (*get_current_context)() = nullptr;
    void (*(*get_proc_address)(const char*))() = nullptr;
};

class OsmesaContext final : public Context, private CurrentContext {
public:
    OsmesaContext(const OsmesaFunctions& functions, OsmesaHandle handle)
        : osmesa_(functions), handle_(handle) {}
    ~OsmesaContext() override {
        leave();
        osmesa_.destroy_context(handle_);
    }

    Status make_current() override { return take(); }
    [[nodiscard]] void* get_proc_address(const char* name) const override {
        return reinterpret_cast<void*>(osmesa_.get_proc_address(name));
    }
    [[nodiscard]] std::string description() const override { return "OSMesa"; }

private:
    Status bind() override {
        if (osmesa_.make_current(handle_, buffer_.data(), GL_UNSIGNED_BYTE, buffer_side,
                                 buffer_side) == GL_FALSE) {
            return fail(ErrorCode::Internal, "OSMesaMakeCurrent refused its own context.");
        }
        return {};
    }
    void unbind() override { osmesa_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
    [[nodiscard]] bool is_bound() const override {
        return osmesa_.get_current_context() == handle_;
    }

    static constexpr int buffer_side =
        16;  // never drawn to: everything goes to framebuffer objects

    OsmesaFunctions osmesa_;
    OsmesaHandle handle_;
    alignas(16) std::array<std::byte, std::size_t{buffer_side} * buffer_side * 4> buffer_{};
};

}  // namespace

Result<std::unique_ptr<Context>> create_osmesa_context() {
    const auto library = SharedLibrary::open("libOSMesa.so.8", "an OSMesa context");
    if (!library) return forward_error(library);

    OsmesaFunctions osmesa;
    for (const Status& loaded :
         {library->load(osmesa.create_context_attribs, "OSMesaCreateContextAttribs"),
          library->load(osmesa.destroy_context, "OSMesaDestroyContext"),
          library->load(osmesa.make_current, "OSMesaMakeCurrent"),
          library->load(osmesa.get_current_context, "OSMesaGetCurrentContext"),
          library->load(osmesa.get_proc_address, "OSMesaGetProcAddress")}) {
        if (!loaded) return forward_error(loaded);
    }

    // 4.5 has clip control in the core; 4.3 with the extension does as well.
    OsmesaHandle handle = nullptr;
    for (const int minor : {5, 3}) {
        const std::array attributes{osmesa_format,
                                    osmesa_rgba,
                                    osmesa_depth_bits,
                                    0,
                                    osmesa_stencil_bits,
                                    0,
                                    osmesa_accum_bits,
                                    0,
                                    osmesa_profile,
                                    osmesa_compat_profile,
                                    osmesa_context_major_version,
                                    4,
                                    osmesa_context_minor_version,
                                    minor,
                                    0};
        handle = osmesa.create_context_attribs(attributes.data(), nullptr);
        if (handle != nullptr) break;
    }
    if (handle == nullptr) {
        return fail(ErrorCode::Unsupported,
                    "OSMesa cannot make a compatibility context of OpenGL 4.5 nor of 4.3.");
    }
    auto context = std::make_unique<OsmesaContext>(osmesa, handle);
    if (const Status bound = context->make_current(); !bound) return forward_error(bound);
    return context;
}

}  // namespace gnomon::gl
