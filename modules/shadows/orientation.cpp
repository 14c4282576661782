// SPDX-License-Identifier: MIT
#include <gnomon/shadows/orientation.hpp>

#include <array>
#include <cfloat>
#include <cmath>
#include <cstddef>

#include "internal/rounded_product.hpp"

#ifdef __FAST_MATH__
#error "Expansions are exact by IEEE 754 arithmetic alone: compile without -ffast-math."
#endif

namespace gnomon::shadows {

static_assert(FLT_EVAL_METHOD == 0, "doubles must round to double, not to a wider register");

namespace {

// A sum of doubles that do not overlap, smallest first: an exact number. 192 terms are what three
// 2x2 minors of two-term differences, each times a two-term difference, can need at most (2*2*2 =
// 8, two of them 16, *2*2 = 64, three of them 192).
struct Expansion {
    std::array<double, 192> terms;
    std::size_t count = 0;

    void push(double term) {
        if (term != 0.0) terms[count++] = term;
    }
};

struct TwoTerms {
    double high;
    double low;
};

// Shewchuk, Theorem 7 (Knuth): a + b = high + low, exactly.
TwoTerms two_sum(double a, double b) {
    const double high = a + b;
    const double b_virtual = high - a;
    const double a_virtual = high - b_virtual;
    return {high, (a - a_virtual) + (b - b_virtual)};
}

// a * b = high + low, exactly: the fused operation rounds once. The product itself must not be
// fused with what it is added to: two_sum would return the error of another sum. It is the only one
// here.
TwoTerms two_product(double a, double b) {
    const double high = internal::rounded_product(a, b);
    return {high, std::fma(a, b, -high)};
}

Expansion difference(float a, float b) {
    const TwoTerms d = two_sum(static_cast<double>(a), -static_cast<double>(b));
    Expansion e;
    e.push(d.low);
    e.push(d.high);
    return e;
}

Expansion single(float a) {
    Expansion e;
    e.push(static_cast<double>(a));
    return e;
}

// Shewchuk, Figure 6 (grow-expansion), once per term.
Expansion sum(Expansion e, const Expansion& f) {
    for (std::size_t j = 0; j < f.count; ++j) {
        Expansion grown;
        double carry = f.terms[j];
        for (std::size_t i = 0; i < e.count; ++i) {
            const TwoTerms s = two_sum(carry, e.terms[i]);
            grown.push(s.low);
            carry = s.high;
        }
        grown.push(carry);
        e = grown;
    }
    return e;
}

// Shewchuk, Figure 13 (scale-expansion).
Expansion scale(const Expansion& e, double factor) {
    Expansion result;
    if (e.count == 0) return result;
    TwoTerms q = two_product(e.terms[0], factor);
    result.push(q.low);
    double carry = q.high;
    for (std::size_t i = 1; i < e.count; ++i) {
        const TwoTerms product = two_product(e.terms[i], factor);
        const TwoTerms s = two_sum(carry, product.low);
        result.push(s.low);
        const TwoTerms t = two_sum(product.high, s.high);
        result.push(t.low);
        carry = t.high;
    }
    result.push(carry);
    return result;
}

Expansion product(const Expansion& e, const Expansion& f) {
    Expansion result;
    for (std::size_t i = 0; i < f.count; ++i) result = sum(result, scale(e, f.terms[i]));
    return result;
}

Expansion negate(Expansion e) {
    for (std::size_t i = 0; i < e.count; ++i) e.terms[i] = -e.terms[i];
    return e;
}

Expansion minor(const Expansion& a, const Expansion& b, const Expansion& c, const Expansion& d) {
    return sum(product(a, d), negate(product(b, c)));
}

int sign(const Expansion& e) {
    if (e.count == 0) return 0;
    const double largest = e.terms[e.count - 1];
    return largest > 0.0 ? 1 : (largest < 0.0 ? -1 : 0);
}

using Vector = std::array<Expansion, 3>;

Vector difference(const glm::vec3& a, const glm::vec3& b) {
    return {difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z)};
}

Vector cross(const Vector& u, const Vector& v) {
    return {minor(u[1], u[2], v[1], v[2]), minor(u[2], u[0], v[2], v[0]),
            minor(u[0], u[1], v[0], v[1])};
}

}  // namespace

int exact_facing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, LightLocal light) {
    const Vector normal = cross(difference(b, a), difference(c, a));
    const glm::vec3 l(light.position);
    const Vector towards =
        light.is_directional() ? Vector{single(l.x), single(l.y), single(l.z)} : difference(l, a);
    Expansion total;
    for (std::size_t i = 0; i < 3; ++i) total = sum(total, product(normal[i], towards[i]));
    return sign(total);
}

bool exactly_collinear(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const Vector normal = cross(difference(b, a), difference(c, a));
    return sign(normal[0]) == 0 && sign(normal[1]) == 0 && sign(normal[2]) == 0;
}

}  // namespace gnomon::shadows
