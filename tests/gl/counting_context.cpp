// SPDX-License-Identifier: MIT
#include "tests/gl/counting_context.hpp"

#include <GL/glcorearb.h>

#include <utility>

namespace gnomon::gl_tests {
namespace {

ObjectCounts* counts = nullptr;

void count_made(const std::string& kind, int number) {
    counts->made[kind] += number;
    counts->alive[kind] += number;
}

// The same few lines for each kind; a macro since GL's functions differ by name alone.
#define GNOMON_COUNTED_KINDS(X) \
    X(Buffers) X(Textures) X(Samplers) X(Framebuffers) X(VertexArrays) X(Queries)

#define GNOMON_COUNT_KIND(Kind)                                            \
    void(APIENTRY * real_gen_##Kind)(GLsizei, GLuint*) = nullptr;          \
    void(APIENTRY * real_delete_##Kind)(GLsizei, const GLuint*) = nullptr; \
    void APIENTRY counting_gen_##Kind(GLsizei n, GLuint* names) {          \
        real_gen_##Kind(n, names);                                         \
        count_made(#Kind, n);                                              \
    }                                                                      \
    void APIENTRY counting_delete_##Kind(GLsizei n, const GLuint* names) { \
        real_delete_##Kind(n, names);                                      \
        for (GLsizei i = 0; i < n; ++i) {                                  \
            if (names[i] != 0) counts->alive[#Kind] -= 1;                  \
        }                                                                  \
    }
GNOMON_COUNTED_KINDS(GNOMON_COUNT_KIND)
#undef GNOMON_COUNT_KIND

GLuint(APIENTRY* real_create_shader)(GLenum) = nullptr;
void(APIENTRY* real_delete_shader)(GLuint) = nullptr;
GLuint(APIENTRY* real_create_program)() = nullptr;
void(APIENTRY* real_delete_program)(GLuint) = nullptr;

GLuint APIENTRY counting_create_shader(GLenum type) {
    count_made("Shaders", 1);
    return real_create_shader(type);
}
void APIENTRY counting_delete_shader(GLuint name) {
    counts->alive["Shaders"] -= 1;
    real_delete_shader(name);
}
GLuint APIENTRY counting_create_program() {
    count_made("Programs", 1);
    return real_create_program();
}
void APIENTRY counting_delete_program(GLuint name) {
    counts->alive["Programs"] -= 1;
    real_delete_program(name);
}

template <class Function>
void* wrap(void* address, Function& real, Function counting) {
    real = reinterpret_cast<Function>(address);
    return reinterpret_cast<void*>(counting);
}

class CountingContext final : public gl::Context {
public:
    CountingContext(std::unique_ptr<gl::Context> inner, std::string missing_function)
        : inner_(std::move(inner)), missing_function_(std::move(missing_function)) {}

    Status make_current() override { return inner_->make_current(); }
    [[nodiscard]] void* get_proc_address(const char* name) const override {
        if (name == missing_function_) return nullptr;
        void* address = inner_->get_proc_address(name);
        const std::string function = name;
#define GNOMON_WRAP_KIND(Kind)                                             \
    if (function == "glGen" #Kind) {                                       \
        return wrap(address, real_gen_##Kind, &counting_gen_##Kind);       \
    }                                                                      \
    if (function == "glDelete" #Kind) {                                    \
        return wrap(address, real_delete_##Kind, &counting_delete_##Kind); \
    }
        GNOMON_COUNTED_KINDS(GNOMON_WRAP_KIND)
#undef GNOMON_WRAP_KIND
        if (function == "glCreateShader") {
            return wrap(address, real_create_shader, &counting_create_shader);
        }
        if (function == "glDeleteShader") {
            return wrap(address, real_delete_shader, &counting_delete_shader);
        }
        if (function == "glCreateProgram") {
            return wrap(address, real_create_program, &counting_create_program);
        }
        if (function == "glDeleteProgram") {
            return wrap(address, real_delete_program, &counting_delete_program);
        }
        return address;
    }
    [[nodiscard]] std::string description() const override { return inner_->description(); }

private:
    std::unique_ptr<gl::Context> inner_;
    std::string missing_function_;
};

}  // namespace

std::unique_ptr<gl::Context> make_counting_context(std::unique_ptr<gl::Context> inner,
                                                   ObjectCounts& object_counts,
                                                   std::string missing_function) {
    counts = &object_counts;
    return std::make_unique<CountingContext>(std::move(inner), std::move(missing_function));
}

}  // namespace gnomon::gl_tests
