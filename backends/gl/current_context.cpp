// SPDX-License-Identifier: MIT
#include "internal/current_context.hpp"

namespace gnomon::gl {
namespace {

thread_local CurrentContext* current = nullptr;

}  // namespace

Status CurrentContext::take() {
    if (current == this && is_bound()) return {};
    if (current != nullptr) current->leave();
    Status bound = bind();
    if (bound) current = this;
    return bound;
}

void CurrentContext::leave() {
    if (current != this) return;
    if (is_bound()) unbind();
    current = nullptr;
}

}  // namespace gnomon::gl
