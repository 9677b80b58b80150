// The tight box and the envelope of an object, in one cache line. An envelope is valid until the object leaves it.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_PLACE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_PLACE_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "ode_predictive_space/broadphase/base/float_box.h"
#include "ode_predictive_space/broadphase/base/origin.h"

namespace ode_predictive_space
{
/// Number of an update of the broad phase. It has 26 bits and wraps around.
using UpdateNumber = std::uint32_t;

/// Negative when `to` is earlier than `from`.
inline std::int32_t updates_between(UpdateNumber from, UpdateNumber to)
{
    return static_cast<std::int32_t>((to - from) << 6) / 64;
}

enum class Watch : std::uint8_t
{
    nothing = 0, ///< none: the next update measures the object
    carried = 1, ///< as `centre`, for a centre that is computed from the pose of a body and an offset
    centre = 2,  ///< the centre with the box of allowed centres
    sphere = 4,  ///< the tight box of a sphere with the envelope
    capsule = 5, ///< the tight box of a capsule along the z axis
    box = 6,     ///< the tight box of a box
    cylinder = 7 ///< the tight box of a cylinder along the z axis
};

/// An object whose bounding box is a function of its pose.
struct Solid
{
    Watch formula = Watch::nothing; ///< Watch::nothing without a formula
    /// Half sizes. A sphere has its radius in x; a capsule and a cylinder have the radius in x and half the length in z.
    float x = 0, y = 0, z = 0;

    bool operator==(const Solid &other) const
    {
        return formula == other.formula && x == other.x && y == other.y && z == other.z;
    }
};

enum class Followed
{
    moved,            ///< inside the envelope
    same,             ///< inside the envelope, with an unchanged pose in single precision; the size may have changed
    left_as_measured, ///< outside the envelope; the tight box is measured
    left              ///< outside the envelope, or not compared
};

struct TightBox
{
    Float4 low, high;

    /// A box of these half sizes, enlarged by more than the round-off of it and of the program's box. It is not finite if the
    /// centre is beyond single precision. @param doubt Origin::doubt().
    static TightBox around(Float4 centre, Float4 half, Float4 doubt)
    {
        constexpr float unit = 6 * std::numeric_limits<float>::epsilon();
        const Float4 outer = half + ((abs(centre) + half) * Float4::all(unit) + doubt);
        const Float4 finite =
            min(outer, Float4::all(std::numeric_limits<float>::max())); // infinity - infinity would be NaN
        return {centre - finite, centre + finite};
    }
};

/// False for NaN, too.
inline bool is_finite(const TightBox &box)
{
    const Float4 most = Float4::all(std::numeric_limits<float>::max());
    return ((abs(box.low) + abs(box.high) <= most).bits() & three_lanes) == three_lanes;
}

class alignas(64) Place
{
public:
    // --- The envelope ---

    Place()
    {
        forget_envelope();
        hide();
    }

    /// Sets an inverted envelope, which holds nothing.
    void forget_envelope() { set_envelope({Float4::all(infinity), Float4::all(-infinity)}); }
    bool has_envelope() const { return low_[0] != infinity || high_[0] != -infinity; }
    FloatBox envelope() const { return {{low_[0], low_[1], low_[2]}, {high_[0], high_[1], high_[2]}}; }
    TightBox envelope_lanes() const { return {low(), high()}; }
    void set_envelope(const TightBox &box)
    {
        box.low.store_three(low_);
        box.high.store_three(high_);
    }

    /// False for NaN.
    friend bool envelopes_apart(const Place &one, const Place &other)
    {
        return apart(one.low(), one.high(), other.low(), other.high());
    }

    /// Shrinks an envelope that was made around a sphere of this radius to one around the tight box.
    void tighten(float radius);

    // --- The tight box ---

    Watch watch() const { return static_cast<Watch>(state_ >> watch_shift); }
    bool watches_centre() const { return watch() == Watch::carried || watch() == Watch::centre; }
    bool watches_solid() const { return watch() > Watch::centre; }
    /// Notices compare nothing from now on; the update after a notice measures the object.
    void stop_watching() { set_watch(Watch::nothing); }
    static constexpr UpdateNumber last_update = ~UpdateNumber{0} >> 6;
    UpdateNumber moved() const { return state_ & last_update; }

    /// @return false if the move was already noted.
    bool note_move(UpdateNumber update)
    {
        const std::uint32_t state = update | counted_bit | (state_ & kept_bits);
        const bool is_new = state != state_;
        state_ = state;
        return is_new;
    }
    /// Notes a possible move below single precision, which does not count as a move.
    void note_doubtful_move(UpdateNumber update)
    {
        if (moved() != update)
            state_ = update | (state_ & kept_bits);
    }

    /// Measures the tight box by the formula of the solid, which notices use from now on.
    /// @return false if there is no formula or the box is not finite; then nothing is watched, and the box is not set.
    template <typename Real>
    bool measure(const Solid &solid, const Real *position, const Real *rotation, const Origin &origin)
    {
        state_ &= ~doubt_bit;
        set_watch(solid.formula);
        half_x_ = solid.x;
        half_y_ = solid.y;
        half_z_ = solid.z;
        if (!watches_solid())
            return false;
        const TightBox box = measured(position, rotation, origin);
        if (!is_finite(box))
        {
            stop_watching();
            return false;
        }
        set_tight(box);
        return true;
    }
    Solid solid() const { return {watch(), half_x_, half_y_, half_z_}; }

    /// Notices compare the centre from now on. @param doubt Origin::doubt().
    /// @param radius of a sphere around the centre that holds the object in any orientation.
    void watch_centre(const float *centre, float radius, Float4 doubt);
    float watched_radius() const { return half_y_; }
    /// As above, for a centre that is computed from the pose of a body and an offset.
    /// @param offset largest coordinate of an offset for whose rounding the radius allows.
    void watch_carried(const float *centre, float radius, Float4 doubt, float offset)
    {
        watch_centre(centre, radius, doubt);
        set_watch(Watch::carried);
        half_z_ = offset;
    }
    float allowed_offset() const { return half_z_; }

    void set_tight(const TightBox &box)
    {
        box.low.store_three(tight_low_);
        box.high.store_three(tight_high_);
    }
    /// Sets the tight box to hold the program's box. @param box relative to the origin.
    void set_tight(const Box &box)
    {
        state_ &= ~doubt_bit;
        const FloatBox outer = FloatBox::around(box);
        const TightBox tight{Float4::load(outer.low), Float4::load(outer.low + 2).last_three()};
        set_tight(tight);
        if (!is_finite(tight))
            note_overflow(box, outer);
    }
    void hide() { set_tight(TightBox{Float4::all(-infinity), Float4::all(infinity)}); }

    FloatBox tight() const
    {
        return {{tight_low_[0], tight_low_[1], tight_low_[2]}, {tight_high_[0], tight_high_[1], tight_high_[2]}};
    }
    TightBox tight_lanes() const { return {tight_low(), tight_high()}; }

    /// Whether the envelope holds the tight box. False for NaN.
    bool holds() const { return has_envelope() && holds(tight_low(), tight_high()); }
    /// Whether the envelope is infinite on a side on which the tight box is finite, so that it would never be left there.
    bool is_boundless() const
    {
        if (has_end())
            return false;
        const Float4 most = Float4::all(std::numeric_limits<float>::max());
        const auto needless = [&](Float4 side, Float4 inner) { return (abs(side) > most) & (abs(inner) <= most); };
        return ((needless(low(), tight_low()) | needless(high(), tight_high())).bits() & three_lanes) != 0;
    }
    bool has_end() const { return is_finite({low(), high()}); }

    /// Compares a new pose. @pre watch() is Watch::centre, or watches_solid().
    template <typename Real> Followed follow(const Real *position, const Real *rotation, const Origin &origin)
    {
        if (watch() == Watch::centre)
            return follow_centre(origin.nearest_of_stored(position));
        const TightBox box = measured(position, rotation, origin);
        const Mask4 same = (box.low == tight_low()) & (box.high == tight_high());
        const bool changed = (same.bits() & three_lanes) != three_lanes;
        set_tight(box);
        const bool is_inside = holds(box.low, box.high);
        if (!is_inside & changed && is_finite(box))
            return Followed::left_as_measured;
        return outcome(is_inside, changed);
    }

    /// follow() for an object that is watched by its centre.
    Followed follow_centre(Float4 centre)
    {
        const float digest = digest_of(centre);
        const bool changed = digest != half_x_;
        half_x_ = digest;
        const Mask4 allowed = (centre >= tight_low()) & (centre <= tight_high());
        return outcome((allowed.bits() & three_lanes) == three_lanes, changed);
    }

    // --- Pairs ---

    friend Float4 overlap_depths(const Place &one, const Place &other)
    {
        return min(one.tight_high(), other.tight_high()) - max(one.tight_low(), other.tight_low());
    }

    friend bool surely_apart(const Place &one, const Place &other)
    {
        return apart(one.tight_low(), one.tight_high(), other.tight_low(), other.tight_high());
    }
    /// Whether the tight boxes overlap by more than their enlargement, so the program's boxes do. @param doubt Origin::doubt().
    friend bool surely_overlap(const Place &one, const Place &other, Float4 doubt);
    /// Bounds of the enlargement of two tight boxes: a part of the farthest coordinate, and multiples of Origin::doubt().
    static constexpr float rounding = 32 * std::numeric_limits<float>::epsilon(), most_doubts = 4;

private:
    static constexpr float infinity = std::numeric_limits<float>::infinity();
    static constexpr int watch_shift = 29;
    static constexpr std::uint32_t doubt_bit = 1u << 27, counted_bit = 1u << 28, watch_bits = 7u << watch_shift,
                                   kept_bits = watch_bits | doubt_bit;

    void set_watch(Watch watch) { state_ = (state_ & ~watch_bits) | static_cast<std::uint32_t>(watch) << watch_shift; }

    Float4 low() const { return Float4::load_aligned(low_); }
    Float4 high() const { return Float4::load_aligned(high_); }
    Float4 tight_low() const { return Float4::load_aligned(tight_low_); }
    Float4 tight_high() const { return Float4::load_aligned(tight_high_); }

    static bool apart(Float4 low, Float4 high, Float4 other_low, Float4 other_high)
    {
        return (((low > other_high) | (other_low > high)).bits() & three_lanes) != 0;
    }

    bool holds(Float4 inner_low, Float4 inner_high) const
    {
        return (((inner_low >= low()) & (inner_high <= high())).bits() & three_lanes) == three_lanes;
    }

    template <typename Real> TightBox measured(const Real *position, const Real *rotation, const Origin &origin) const
    {
        return TightBox::around(origin.nearest_of_stored(position), half_extents(rotation), origin.doubt());
    }

    template <typename Real> Float4 half_extents(const Real *rotation) const
    {
        if (watch() == Watch::sphere)
            return Float4::all(half_x_);
        const Float4 along_z = abs(Float4::nearest_of_stored(rotation + 2, 4)) * Float4::all(half_z_);
        if (watch() == Watch::capsule)
            return along_z + Float4::all(half_x_);
        if (watch() == Watch::cylinder)
            return along_z + Float4::all(half_x_) * reach_of_disc(rotation);
        return (abs(Float4::nearest_of_stored(rotation, 4)) * Float4::all(half_x_) +
                abs(Float4::nearest_of_stored(rotation + 1, 4)) * Float4::all(half_y_)) +
               along_z;
    }

    // The reach of a disc of radius 1, perpendicular to the z axis, along each axis of space. The difference is computed in
    // double precision, because the square root of a small difference enlarges its error.
    template <typename Real> static Float4 reach_of_disc(const Real *rotation)
    {
        const auto squared = [rotation](int axis) {
            const double along = rotation[4 * axis + 2];
            return static_cast<float>(std::max(0.0, 1 - along * along));
        };
        return sqrt(Float4(squared(0), squared(1), squared(2), 0));
    }

    void note_overflow(const Box &box, const FloatBox &outer)
    {
        const auto overflows = [](double exact, float rounded) {
            return std::isfinite(exact) && !(std::abs(rounded) < std::numeric_limits<float>::max());
        };
        bool doubtful = false;
        for (int axis = 0; axis < 3; ++axis)
            doubtful |= overflows(box.min()[axis], outer.low[axis]) || overflows(box.max()[axis], outer.high[axis]);
        state_ |= doubtful ? doubt_bit : 0;
    }

    // A checksum by which a notice finds a changed centre. Small weights keep the sum of large coordinates finite.
    static float digest_of(Float4 centre) { return (centre * Float4(0.25f, 0.34293f, 0.43478f, 0)).sum_of_three(); }

    static Followed outcome(bool is_inside, bool changed)
    {
        return !is_inside ? Followed::left : changed ? Followed::moved : Followed::same;
    }

    // Each array is loaded as a vector; the member after it is in the ignored fourth lane. While the centre is watched,
    // tight_low_ and tight_high_ are the allowed centres, half_x_ is a digest, half_y_ the radius, half_z_ the allowed offset.
    float low_[3];
    float half_x_ = 0;
    float high_[3];
    float half_y_ = 0;
    float tight_low_[3];
    float half_z_ = 0;
    float tight_high_[3];
    // From the lowest bit on: 26 bits with the update that processes the last move; a bit that is always 0; whether a side of
    // the box overflows single precision; whether the move is counted; three bits with the watch. As the fourth lane of a
    // vector it is a finite float, because the bit that is always 0 belongs to the exponent.
    std::uint32_t state_ = 0;
};
static_assert(sizeof(Place) == 64, "one cache line per notice");

inline bool surely_overlap(const Place &one, const Place &other, Float4 doubt_of_origin)
{
    if ((one.state_ | other.state_) & Place::doubt_bit)
        return false;
    // A side is enlarged by less than this part of both sides of its box; an infinite side is not enlarged.
    constexpr float unit = 16 * std::numeric_limits<float>::epsilon();
    const auto finite_size = [](Float4 side) { return finite_or_zero(abs(side)); };
    const Float4 sizes = (finite_size(one.tight_low()) + finite_size(one.tight_high())) +
                         (finite_size(other.tight_low()) + finite_size(other.tight_high()));
    const Float4 doubt = sizes * Float4::all(unit) + Float4::all(Place::most_doubts) * doubt_of_origin;
    const Mask4 before = one.tight_high() - other.tight_low() > doubt,
                after = other.tight_high() - one.tight_low() > doubt;
    return ((before & after).bits() & three_lanes) == three_lanes;
}

// The margin exceeds the round-off here and of the measured box.
inline void Place::tighten(float radius)
{
    constexpr float unit = 16 * std::numeric_limits<float>::epsilon();
    const Float4 half = Float4::all(0.5f) * (tight_high() - tight_low());
    const Float4 margin = ((abs(low()) + abs(high())) + Float4::all(radius)) * Float4::all(unit);
    const Float4 give = max(Float4::all(radius) - half - margin, Float4::all(0));
    set_envelope({low() + give, high() - give});
}

inline void Place::watch_centre(const float *centre, float radius, Float4 doubt)
{
    constexpr float unit = 16 * std::numeric_limits<float>::epsilon();
    set_watch(Watch::centre);
    const Float4 kept =
        Float4::all(radius) + ((abs(low()) + abs(high())) + Float4::all(radius)) * Float4::all(unit) + doubt;
    half_x_ = digest_of(Float4(centre[0], centre[1], centre[2], 0));
    half_y_ = radius;
    set_tight(TightBox{low() + kept, high() - kept});
}
} // namespace ode_predictive_space

#endif
