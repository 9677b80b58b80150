// The geoms that a ray can touch without meeting their box, for the sphere and shape tests, which follow a ray along its line.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_OFF_LINE_GEOMS_H
#define ODE_PREDICTIVE_SPACE_SPACE_OFF_LINE_GEOMS_H

#include <atomic>

#include "ode_predictive_space/broadphase/base/id_set.h"

namespace ode_predictive_space
{
/// The set is updated by queries with rays, not at each change: geoms change at every tick, and few programs use rays.
class OffLineGeoms
{
public:
    void resize(std::size_t count)
    {
        geoms_.resize(count);
        unknown_.resize(count);
    }

    void note_change(ProxyId id)
    {
        if (unknown_.contains(id))
            return;
        unknown_.insert(id);
        known_.store(false, std::memory_order_release);
    }

    void erase(ProxyId id)
    {
        geoms_.erase(id);
        unknown_.erase(id);
    }

    bool known() const { return known_.load(std::memory_order_acquire); }

    /// Calls is_off_line(id) for each changed geom. @pre no other thread updates.
    template <typename IsOffLine> void update(IsOffLine is_off_line)
    {
        unknown_.for_each([&](ProxyId id) { is_off_line(id) ? geoms_.insert(id) : geoms_.erase(id); });
        unknown_.clear();
        known_.store(true, std::memory_order_release);
    }

    bool contains(ProxyId id) const { return geoms_.contains(id); }
    bool empty() const { return geoms_.empty(); }
    std::size_t bytes() const { return geoms_.bytes() + unknown_.bytes(); }

private:
    IdSet geoms_, unknown_;
    std::atomic<bool> known_{true}; // unknown_ is empty
};
} // namespace ode_predictive_space

#endif
