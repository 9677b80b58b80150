// The last positions of an object whose motion is not known.

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_HISTORY_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_HISTORY_H

#include <array>
#include <cstdint>

#include "ode_predictive_space/prediction/least_squares.h"

namespace ode_predictive_space
{
class History
{
public:
    static constexpr int capacity = 8;

    /// A second position for the same tick replaces the first. Ticks may wrap around.
    void add(std::uint32_t tick, const Vector3 &position)
    {
        if (count_ > 0 && ticks_[last()] == tick)
            count_ -= 1;
        else
            newest_ = (newest_ + 1) % capacity;
        if (count_ < capacity)
            count_ += 1;
        ticks_[newest_] = tick;
        positions_[newest_] = position;
    }

    /// @pre count() > 0.
    void keep_newest() { count_ = 1; }

    int count() const { return count_; }

    /// The nth position before the newest one, which is number 0; n < count().
    const Vector3 &before_newest(int n) const { return positions_[nth_newest(n)]; }
    std::uint32_t newest_tick() const { return ticks_[last()]; }

    /// The least-squares path, with time 0 at the newest sample. @pre count() > 0.
    FittedPath fit() const
    {
        std::array<Sample, capacity> samples;
        const std::uint32_t now = ticks_[last()];
        for (int i = 0; i < count_; ++i)
        {
            const int slot = nth_newest(count_ - 1 - i);
            samples[i] = {static_cast<double>(static_cast<std::int32_t>(ticks_[slot] - now)), positions_[slot]};
        }
        return fit_path(samples.data(), count_);
    }

private:
    int last() const { return newest_; }
    int nth_newest(int n) const { return (newest_ + capacity - n) % capacity; }

    std::array<Vector3, capacity> positions_;
    std::array<std::uint32_t, capacity> ticks_;
    int newest_ = 0;
    int count_ = 0;
};
static_assert(History::capacity <= max_samples, "fit_path() takes them all");
} // namespace ode_predictive_space

#endif
