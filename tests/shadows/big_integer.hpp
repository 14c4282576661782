// SPDX-License-Identifier: MIT
//
// Integers without limit, for an oracle that shares nothing with the expansions it judges: every
// finite float is an integer multiple of 2^-149. Slow and plain.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>

namespace gnomon::test {

class BigInteger {
public:
    BigInteger() = default;

    /// value * 2^149, exactly, of a multiple of 2^-149.
    static BigInteger of(double value) {
        int exponent = 0;
        // 53 bits of mantissa: value = mantissa * 2^(exponent - 53); zero shifts nothing.
        const auto mantissa =
            static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
        int shift = exponent - 53 + 149;
        BigInteger result;
        if (mantissa == 0) return result;
        result.negative_ = mantissa < 0;
        auto magnitude = static_cast<std::uint64_t>(mantissa < 0 ? -mantissa : mantissa);
        for (; shift < 0; ++shift) magnitude >>= 1U;  // the low bits of such a number are zero
        const auto bits = static_cast<unsigned>(shift % 32);
        const std::uint64_t low = (magnitude & 0xFFFFFFFFU) << bits;
        const std::uint64_t high = ((magnitude >> 32U) << bits) + (low >> 32U);
        result.digits_.assign(static_cast<std::size_t>(shift / 32), 0U);
        for (const std::uint64_t digit : {low, high, high >> 32U}) {
            result.digits_.push_back(static_cast<std::uint32_t>(digit));
        }
        result.trim();
        return result;
    }
    static BigInteger of_float(float value) { return of(static_cast<double>(value)); }

    [[nodiscard]] int sign() const { return digits_.empty() ? 0 : (negative_ ? -1 : 1); }

    friend BigInteger operator-(const BigInteger& a, BigInteger b) {
        b.negative_ = !b.negative_;
        return a + b;
    }
    friend BigInteger operator+(const BigInteger& a, const BigInteger& b) {
        const int order = compare_magnitude(a, b);
        if (a.negative_ != b.negative_ && order == 0) return {};
        const BigInteger& larger = order < 0 ? b : a;
        const BigInteger& smaller = order < 0 ? a : b;
        const bool add = a.negative_ == b.negative_;
        BigInteger result;
        result.negative_ = larger.negative_;
        std::int64_t carry = 0;
        for (std::size_t i = 0; i < larger.digits_.size(); ++i) {
            const std::int64_t other = i < smaller.digits_.size() ? smaller.digits_[i] : 0;
            carry += static_cast<std::int64_t>(larger.digits_[i]) + (add ? other : -other);
            result.digits_.push_back(static_cast<std::uint32_t>(carry));
            carry >>= 32;  // arithmetic: -1 is a borrow
        }
        if (carry > 0) result.digits_.push_back(static_cast<std::uint32_t>(carry));
        result.trim();
        return result;
    }
    friend BigInteger operator*(const BigInteger& a, const BigInteger& b) {
        BigInteger result;
        result.negative_ = a.negative_ != b.negative_;
        result.digits_.assign(a.digits_.size() + b.digits_.size(), 0U);
        for (std::size_t i = 0; i < a.digits_.size(); ++i) {
            std::uint64_t carry = 0;
            for (std::size_t j = 0; j < b.digits_.size(); ++j) {
                carry += std::uint64_t{a.digits_[i]} * b.digits_[j] + result.digits_[i + j];
                result.digits_[i + j] = static_cast<std::uint32_t>(carry);
                carry >>= 32U;
            }
            result.digits_[i + b.digits_.size()] = static_cast<std::uint32_t>(carry);
        }
        result.trim();
        return result;
    }

private:
    void trim() {
        while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
        if (digits_.empty()) negative_ = false;
    }
    static int compare_magnitude(const BigInteger& a, const BigInteger& b) {
        if (a.digits_.size() != b.digits_.size()) {
            return a.digits_.size() < b.digits_.size() ? -1 : 1;
        }
        for (std::size_t i = a.digits_.size(); i-- > 0;) {
            if (a.digits_[i] != b.digits_[i]) return a.digits_[i] < b.digits_[i] ? -1 : 1;
        }
        return 0;
    }

    bool negative_ = false;
    std::vector<std::uint32_t> digits_;  // least significant first, no leading zero
};

using BigVector = std::array<BigInteger, 3>;

inline BigVector big(const glm::vec3& p) {
    return {BigInteger::of_float(p.x), BigInteger::of_float(p.y), BigInteger::of_float(p.z)};
}

inline BigVector operator-(const BigVector& a, const BigVector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline BigVector cross(const BigVector& u, const BigVector& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// The sign of normal(a, b, c) . (light - a), or of normal . direction.
inline int integer_facing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                          shadows::LightLocal light) {
    const BigVector n = cross(big(b) - big(a), big(c) - big(a));
    BigVector t = big(glm::vec3(light.position));
    if (!light.is_directional()) t = t - big(a);
    return (n[0] * t[0] + n[1] * t[1] + n[2] * t[2]).sign();
}

}  // namespace gnomon::test
