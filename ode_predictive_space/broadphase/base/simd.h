// Vectors of four floats and of eight 16-bit integers: the only vector arithmetic of the broad phase.
// It uses SSE2. On other processors the SIMDe library implements the same instructions with bit-identical results;
// ODE_PREDICTIVE_SPACE_SIMDE selects it on any processor, for tests.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_SIMD_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_SIMD_H

#include <cstddef>
#include <cstdint>
#include <limits>

#if defined(__SSE2__) && !defined(ODE_PREDICTIVE_SPACE_SIMDE)
#include <emmintrin.h>
#elif __has_include(<simde/x86/sse2.h>)
#define SIMDE_ENABLE_NATIVE_ALIASES
#include <simde/x86/sse2.h>
#else
#error "For processors without SSE2 the headers of SIMDe are needed; Debian's package is named libsimde-dev."
#endif

namespace ode_predictive_space
{
constexpr unsigned three_lanes = 7, four_lanes = 15;

class Mask4
{
public:
    explicit Mask4(__m128 lanes) : lanes_(lanes) {}

    /// One bit per lane, the first lane's lowest.
    unsigned bits() const { return static_cast<unsigned>(_mm_movemask_ps(lanes_)); }

    friend Mask4 operator&(Mask4 a, Mask4 b) { return Mask4(_mm_and_ps(a.lanes_, b.lanes_)); }
    friend Mask4 operator|(Mask4 a, Mask4 b) { return Mask4(_mm_or_ps(a.lanes_, b.lanes_)); }

private:
    __m128 lanes_;
};

/// Four floats. Comparisons with NaN are false.
class Float4
{
public:
    Float4() = default;
    Float4(float x, float y, float z, float w) : lanes_(_mm_setr_ps(x, y, z, w)) {}

    static Float4 all(float value) { return Float4(_mm_set1_ps(value)); }

    static Float4 load(const float *four) { return Float4(_mm_loadu_ps(four)); }
    static Float4 load_aligned(const float *four) { return Float4(_mm_load_ps(four)); }

    /// Rounded to the nearest floats; the fourth lane is 0.
    static Float4 nearest(const double *three) { return joined(_mm_loadu_pd(three), _mm_load_sd(three + 2)); }

    /// Three doubles that are `stride` apart, rounded as by nearest(). Each is loaded separately: a wider load of numbers that
    /// were just stored one by one would stall until the stores have finished.
    static Float4 nearest_of_stored(const double *first, std::ptrdiff_t stride)
    {
        return joined(_mm_loadh_pd(_mm_load_sd(first), first + stride), _mm_load_sd(first + 2 * stride));
    }

    /// Three doubles that were just stored less three others, rounded to the nearest floats. @param others aligned to 16 bytes.
    static Float4 difference_of_stored(const double *first, const double *others)
    {
        return joined(_mm_sub_pd(_mm_loadh_pd(_mm_load_sd(first), first + 1), _mm_load_pd(others)),
                      _mm_sub_sd(_mm_load_sd(first + 2), _mm_load_sd(others + 2)));
    }

    static Float4 nearest_of_stored(const float *first, std::ptrdiff_t stride)
    {
        return {first[0], first[stride], first[2 * stride], 0};
    }

    /// round_down() of sign, 1 or -1, times three numbers. @pre they are finite as floats.
    static Float4 rounded_down(const double *three, double sign)
    {
        const __m128d signs = _mm_set1_pd(sign);
        const __m128d xy = _mm_mul_pd(_mm_loadh_pd(_mm_load_sd(three), three + 1), signs),
                      z = _mm_mul_pd(_mm_load_sd(three + 2), signs);
        const Float4 nearest = joined(xy, z);
        const Float4 finite = min(abs(nearest), all(std::numeric_limits<float>::max()));
        const Float4 margin =
            finite * all(std::numeric_limits<float>::epsilon()) + all(std::numeric_limits<float>::min());
        const __m128d above_xy = _mm_cmpgt_pd(_mm_cvtps_pd(nearest.lanes_), xy);
        const __m128d above_z = _mm_cmpgt_pd(_mm_cvtps_pd(_mm_movehl_ps(nearest.lanes_, nearest.lanes_)), z);
        const __m128 above = _mm_shuffle_ps(_mm_castpd_ps(above_xy), _mm_castpd_ps(above_z), _MM_SHUFFLE(2, 0, 2, 0));
        return nearest - Float4(_mm_and_ps(above, margin.lanes_));
    }

    void store(float *four) const { _mm_storeu_ps(four, lanes_); }

    void store_three(float *three) const
    {
        _mm_storel_pi(reinterpret_cast<__m64 *>(three), lanes_);
        _mm_store_ss(three + 2, _mm_movehl_ps(lanes_, lanes_));
    }

    void store_whole(std::int32_t *four) const
    {
        _mm_storeu_si128(reinterpret_cast<__m128i *>(four), _mm_cvttps_epi32(lanes_));
    }

    /// The lanes y, z, x; the fourth is undefined.
    Float4 rotated() const { return Float4(_mm_shuffle_ps(lanes_, lanes_, _MM_SHUFFLE(0, 0, 2, 1))); }
    /// The lanes y, z, w; the fourth is undefined.
    Float4 last_three() const { return Float4(_mm_shuffle_ps(lanes_, lanes_, _MM_SHUFFLE(3, 3, 2, 1))); }

    template <int lane> Float4 broadcast() const
    {
        return Float4(_mm_shuffle_ps(lanes_, lanes_, _MM_SHUFFLE(lane, lane, lane, lane)));
    }

    float sum_of_three() const
    {
        const __m128 two = _mm_add_ss(lanes_, _mm_shuffle_ps(lanes_, lanes_, _MM_SHUFFLE(1, 1, 1, 1)));
        return _mm_cvtss_f32(_mm_add_ss(two, _mm_movehl_ps(lanes_, lanes_)));
    }
    float largest_of_three() const
    {
        const __m128 two = _mm_max_ss(_mm_shuffle_ps(lanes_, lanes_, _MM_SHUFFLE(1, 1, 1, 1)), lanes_);
        return _mm_cvtss_f32(_mm_max_ss(_mm_movehl_ps(lanes_, lanes_), two));
    }
    friend Float4 operator+(Float4 a, Float4 b) { return Float4(_mm_add_ps(a.lanes_, b.lanes_)); }
    friend Float4 operator-(Float4 a, Float4 b) { return Float4(_mm_sub_ps(a.lanes_, b.lanes_)); }
    friend Float4 operator*(Float4 a, Float4 b) { return Float4(_mm_mul_ps(a.lanes_, b.lanes_)); }
    friend Float4 operator-(Float4 a) { return all(0) - a; }

    /// max() and min() by lane return b if either number is NaN.
    friend Float4 max(Float4 a, Float4 b) { return Float4(_mm_max_ps(a.lanes_, b.lanes_)); }
    friend Float4 min(Float4 a, Float4 b) { return Float4(_mm_min_ps(a.lanes_, b.lanes_)); }
    /// Uses shifts, which need no constant from memory.
    friend Float4 abs(Float4 a)
    {
        return Float4(_mm_castsi128_ps(_mm_srli_epi32(_mm_slli_epi32(_mm_castps_si128(a.lanes_), 1), 1)));
    }

    friend Float4 sqrt(Float4 a) { return Float4(_mm_sqrt_ps(a.lanes_)); }

    friend Float4 finite_or_zero(Float4 a)
    {
        const __m128 finite = _mm_cmplt_ps(abs(a).lanes_, _mm_set1_ps(std::numeric_limits<float>::infinity()));
        return Float4(_mm_and_ps(finite, a.lanes_));
    }

    friend Float4 quotient_or_zero(Float4 a, Float4 b)
    {
        const __m128 divides = _mm_cmpneq_ps(b.lanes_, _mm_setzero_ps());
        const __m128 divisor = _mm_or_ps(_mm_and_ps(divides, b.lanes_), _mm_andnot_ps(divides, _mm_set1_ps(1)));
        return Float4(_mm_and_ps(divides, _mm_div_ps(a.lanes_, divisor)));
    }

    friend Mask4 operator==(Float4 a, Float4 b) { return Mask4(_mm_cmpeq_ps(a.lanes_, b.lanes_)); }
    friend Mask4 operator<(Float4 a, Float4 b) { return Mask4(_mm_cmplt_ps(a.lanes_, b.lanes_)); }
    friend Mask4 operator<=(Float4 a, Float4 b) { return Mask4(_mm_cmple_ps(a.lanes_, b.lanes_)); }
    friend Mask4 operator>(Float4 a, Float4 b) { return Mask4(_mm_cmpgt_ps(a.lanes_, b.lanes_)); }
    friend Mask4 operator>=(Float4 a, Float4 b) { return Mask4(_mm_cmpge_ps(a.lanes_, b.lanes_)); }

private:
    explicit Float4(__m128 lanes) : lanes_(lanes) {}

    static Float4 joined(__m128d xy, __m128d z) { return Float4(_mm_movelh_ps(_mm_cvtpd_ps(xy), _mm_cvtpd_ps(z))); }

    __m128 lanes_;
};

/// Eight signed integers of 16 bits, or the result of their comparison.
class Short8
{
public:
    static Short8 all(std::int16_t value) { return Short8(_mm_set1_epi16(value)); }
    static Short8 load(const std::int16_t *eight)
    {
        return Short8(_mm_loadu_si128(reinterpret_cast<const __m128i *>(eight)));
    }

    friend Short8 operator>(Short8 a, Short8 b) { return Short8(_mm_cmpgt_epi16(a.lanes_, b.lanes_)); }
    friend Short8 operator|(Short8 a, Short8 b) { return Short8(_mm_or_si128(a.lanes_, b.lanes_)); }

    /// One bit per lane of two comparisons, the first's lower.
    friend unsigned bits_of(Short8 first, Short8 second)
    {
        return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(first.lanes_, second.lanes_)));
    }

private:
    explicit Short8(__m128i lanes) : lanes_(lanes) {}

    __m128i lanes_;
};
} // namespace ode_predictive_space

#endif
