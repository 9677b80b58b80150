// Four boxes side by side, and a probe that compares one box with all four at once.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_FOUR_BOXES_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_FOUR_BOXES_H

#include <algorithm>
#include <cstddef>

#include "ode_predictive_space/broadphase/base/float_box.h"

namespace ode_predictive_space
{
/// The sides of up to four boxes, by axis and box. Empty places hold an inverted box beyond all that are bounded().
struct alignas(16) FourBoxes
{
    static constexpr std::size_t most = 4;

    float low[3][most], high[3][most];

    FourBoxes()
    {
        for (std::size_t place = 0; place < most; ++place)
            clear(place);
    }

    static FourBoxes all(const FloatBox &box)
    {
        FourBoxes boxes;
        for (std::size_t place = 0; place < most; ++place)
            boxes.set(place, box);
        return boxes;
    }

    FloatBox operator[](std::size_t place) const
    {
        return {{low[0][place], low[1][place], low[2][place]}, {high[0][place], high[1][place], high[2][place]}};
    }

    void set(std::size_t place, const FloatBox &box)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            low[axis][place] = box.low[axis];
            high[axis][place] = box.high[axis];
        }
    }

    void enlarge(std::size_t place, const FloatBox &box)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            low[axis][place] = std::min(low[axis][place], box.low[axis]);
            high[axis][place] = std::max(high[axis][place], box.high[axis]);
        }
    }

    void clear(std::size_t place)
    {
        constexpr float beyond = 1e16f;
        set(place, {{beyond, beyond, beyond}, {-beyond, -beyond, -beyond}});
    }

    /// The box around all. @pre all are bounded(), and the first place is not empty.
    FloatBox merged() const
    {
        FloatBox box = (*this)[0];
        for (int axis = 0; axis < 3; ++axis)
            for (std::size_t place = 1; place < most; ++place)
            {
                box.low[axis] = std::min(box.low[axis], low[axis][place]);
                box.high[axis] = std::max(box.high[axis], high[axis][place]);
            }
        return box;
    }

    Float4 lows(int axis) const { return Float4::load_aligned(low[axis]); }
    Float4 highs(int axis) const { return Float4::load_aligned(high[axis]); }
};

class BoxProbe
{
public:
    explicit BoxProbe(const FloatBox &box)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            low_[axis] = Float4::all(box.low[axis]);
            high_[axis] = Float4::all(box.high[axis]);
        }
    }

    /// One bit per place, set if its box overlaps this one.
    unsigned overlaps(const FourBoxes &boxes) const
    {
        return (along(boxes, 0) & along(boxes, 1) & along(boxes, 2)).bits();
    }

private:
    Mask4 along(const FourBoxes &boxes, int axis) const
    {
        return (low_[axis] <= boxes.highs(axis)) & (high_[axis] >= boxes.lows(axis));
    }

    Float4 low_[3], high_[3];
};
} // namespace ode_predictive_space

#endif
