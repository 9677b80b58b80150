// The scalar implementation of simd.h; included by it alone. What each function means is said in simd_sse2.h.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_SIMD_SCALAR_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_SIMD_SCALAR_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ode_predictive_space/broadphase/base/rounding.h"

namespace ode_predictive_space
{
class Mask4
{
public:
    explicit Mask4(unsigned bits) : bits_(bits) {}
    unsigned bits() const { return bits_; }
    friend Mask4 operator&(Mask4 a, Mask4 b) { return Mask4(a.bits_ & b.bits_); }
    friend Mask4 operator|(Mask4 a, Mask4 b) { return Mask4(a.bits_ | b.bits_); }

private:
    unsigned bits_;
};

class Float4
{
public:
    Float4() = default;
    Float4(float x, float y, float z, float w) : lanes_{x, y, z, w} {}

    static Float4 all(float value) { return {value, value, value, value}; }
    static Float4 load(const float *four) { return {four[0], four[1], four[2], four[3]}; }
    static Float4 load_aligned(const float *four) { return load(four); }
    static Float4 nearest(const double *three) { return nearest_of_stored(three, 1); }
    static Float4 nearest_of_stored(const double *first, std::ptrdiff_t stride)
    {
        return {static_cast<float>(first[0]), static_cast<float>(first[stride]), static_cast<float>(first[2 * stride]),
                0};
    }
    static Float4 difference_of_stored(const double *first, const double *others)
    {
        return {static_cast<float>(first[0] - others[0]), static_cast<float>(first[1] - others[1]),
                static_cast<float>(first[2] - others[2]), 0};
    }
    static Float4 nearest_of_stored(const float *first, std::ptrdiff_t stride)
    {
        return {first[0], first[stride], first[2 * stride], 0};
    }
    template <typename Real> static Float4 rounded_down(const Real *first, std::ptrdiff_t stride, double sign)
    {
        return {round_down(sign * first[0]), round_down(sign * first[stride]), round_down(sign * first[2 * stride]), 0};
    }

    void store(float *four) const { std::copy_n(lanes_, 4, four); }
    void store_three(float *three) const { std::copy_n(lanes_, 3, three); }
    void store_whole(std::int32_t *four) const
    {
        for (int lane = 0; lane < 4; ++lane)
            four[lane] = static_cast<std::int32_t>(lanes_[lane]);
    }

    Float4 rotated() const { return {lanes_[1], lanes_[2], lanes_[0], lanes_[0]}; }
    Float4 last_three() const { return {lanes_[1], lanes_[2], lanes_[3], lanes_[3]}; }
    template <int lane> Float4 broadcast() const { return all(lanes_[lane]); }

    float sum_of_three() const { return (lanes_[0] + lanes_[1]) + lanes_[2]; }
    float largest_of_three() const { return larger(lanes_[2], larger(lanes_[1], lanes_[0])); }

    friend Float4 operator+(Float4 a, Float4 b)
    {
        return each(a, b, [](float x, float y) { return x + y; });
    }
    friend Float4 operator-(Float4 a, Float4 b)
    {
        return each(a, b, [](float x, float y) { return x - y; });
    }
    friend Float4 operator*(Float4 a, Float4 b)
    {
        return each(a, b, [](float x, float y) { return x * y; });
    }
    friend Float4 operator-(Float4 a) { return all(0) - a; }
    friend Float4 max(Float4 a, Float4 b) { return each(a, b, larger); }
    friend Float4 min(Float4 a, Float4 b) { return each(a, b, smaller); }
    friend Float4 abs(Float4 a)
    {
        return each(a, a, [](float x, float) { return std::abs(x); });
    }

    friend Float4 sqrt(Float4 a)
    {
        return each(a, a, [](float x, float) { return std::sqrt(x); });
    }

    friend Float4 finite_or_zero(Float4 a)
    {
        return each(a, a, [](float x, float) { return std::abs(x) < std::numeric_limits<float>::infinity() ? x : 0; });
    }
    friend Float4 quotient_or_zero(Float4 a, Float4 b)
    {
        return each(a, b, [](float x, float y) { return y != 0 ? x / y : 0; });
    }
    friend Mask4 operator==(Float4 a, Float4 b)
    {
        return compared(a, b, [](float x, float y) { return x == y; });
    }
    friend Mask4 operator<(Float4 a, Float4 b)
    {
        return compared(a, b, [](float x, float y) { return x < y; });
    }
    friend Mask4 operator<=(Float4 a, Float4 b)
    {
        return compared(a, b, [](float x, float y) { return x <= y; });
    }
    friend Mask4 operator>(Float4 a, Float4 b)
    {
        return compared(a, b, [](float x, float y) { return x > y; });
    }
    friend Mask4 operator>=(Float4 a, Float4 b)
    {
        return compared(a, b, [](float x, float y) { return x >= y; });
    }

private:
    // As the processor does it: the second where one is NaN.
    static float larger(float x, float y) { return x > y ? x : y; }
    static float smaller(float x, float y) { return x < y ? x : y; }

    template <typename Operation> static Float4 each(Float4 a, Float4 b, Operation operation)
    {
        return {operation(a.lanes_[0], b.lanes_[0]), operation(a.lanes_[1], b.lanes_[1]),
                operation(a.lanes_[2], b.lanes_[2]), operation(a.lanes_[3], b.lanes_[3])};
    }

    template <typename Comparison> static Mask4 compared(Float4 a, Float4 b, Comparison comparison)
    {
        unsigned bits = 0;
        for (unsigned lane = 0; lane < 4; ++lane)
            bits |= static_cast<unsigned>(comparison(a.lanes_[lane], b.lanes_[lane])) << lane;
        return Mask4(bits);
    }

    alignas(16) float lanes_[4];
};

class Short8
{
public:
    static Short8 all(std::int16_t value)
    {
        Short8 result;
        std::fill_n(result.lanes_, 8, value);
        return result;
    }
    static Short8 load(const std::int16_t *eight)
    {
        Short8 result;
        std::copy_n(eight, 8, result.lanes_);
        return result;
    }

    friend Short8 operator>(Short8 a, Short8 b)
    {
        for (int lane = 0; lane < 8; ++lane)
            a.lanes_[lane] = a.lanes_[lane] > b.lanes_[lane] ? std::int16_t{-1} : std::int16_t{0};
        return a;
    }
    friend Short8 operator|(Short8 a, Short8 b)
    {
        for (int lane = 0; lane < 8; ++lane)
            a.lanes_[lane] = static_cast<std::int16_t>(a.lanes_[lane] | b.lanes_[lane]);
        return a;
    }

    friend unsigned bits_of(Short8 first, Short8 second)
    {
        unsigned bits = 0;
        for (unsigned lane = 0; lane < 8; ++lane)
            bits |= static_cast<unsigned>(first.lanes_[lane] < 0) << lane |
                    static_cast<unsigned>(second.lanes_[lane] < 0) << (8 + lane);
        return bits;
    }

private:
    std::int16_t lanes_[8];
};

} // namespace ode_predictive_space

#endif
