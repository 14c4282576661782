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

Expansion difference(double a, double b) {
    const TwoTerms d = two_sum(a, -b);
    Expansion e;
    e.push(d.low);
    e.push(d.high);
    return e;
}

Expansion single(double a) {
    Expansion e;
    e.push(a);
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

Vector difference(const glm::dvec3& a, const glm::dvec3& b) {
    return {difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z)};
}

Vector cross(const Vector& u, const Vector& v) {
    return {minor(u[1], u[2], v[1], v[2]), minor(u[2], u[0], v[2], v[0]),
            minor(u[0], u[1], v[0], v[1])};
}

// From a point to the light, or the way to it.
Vector towards(const glm::dvec4& light, const glm::dvec3& from) {
    if (light.w != 0.0) return difference(glm::dvec3(light), from);
    return {single(light.x), single(light.y), single(light.z)};
}

}  // namespace

int exact_orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                      const glm::dvec4& light) {
    const Vector normal = cross(difference(b, a), difference(c, a));
    const Vector to_light = towards(light, a);
    Expansion total;
    for (std::size_t i = 0; i < 3; ++i) total = sum(total, product(normal[i], to_light[i]));
    return sign(total);
}

int exact_facing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, LightLocal light) {
    return exact_orientation(glm::dvec3(a), glm::dvec3(b), glm::dvec3(c),
                             glm::dvec4(light.position));
}

int exact_side(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec4& light,
               const glm::dvec3& x) {
    if (const int side = exact_orientation(x, p, q, light); side != 0) return side;
    // The determinant is (p - x) . n: moved by (t, t^2, t^3), x changes it by -t n.x, and so on.
    for (const Expansion& component : cross(difference(q, p), towards(light, p))) {
        if (const int side = -sign(component); side != 0) return side;
    }
    return 0;
}

bool exactly_collinear(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const Vector normal =
        cross(difference(glm::dvec3(b), glm::dvec3(a)), difference(glm::dvec3(c), glm::dvec3(a)));
    return sign(normal[0]) == 0 && sign(normal[1]) == 0 && sign(normal[2]) == 0;
}

}  // namespace gnomon::shadows
