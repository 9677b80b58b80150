// The last positions of interactive objects: their motion is known from these alone.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICT_SAMPLES_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICT_SAMPLES_H

#include <algorithm>
#include <vector>

#include "ode_predictive_space/broadphase/base/ids.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/prediction/history.h"

namespace ode_predictive_space
{
/// Positions by object, of a few objects.
class Samples
{
public:
    struct Sampled
    {
        ProxyId id;
        History history;
    };

    template <typename List> static auto position(List &list, ProxyId id)
    {
        return std::find_if(list.begin(), list.end(), [id](const Sampled &one) { return one.id == id; });
    }

    std::size_t count() const { return sampled_.size(); }
    std::vector<Sampled>::iterator begin() { return sampled_.begin(); }
    std::vector<Sampled>::iterator end() { return sampled_.end(); }

    /// The object's positions, if they are sampled.
    const History *find(ProxyId id) const
    {
        const auto found = position(sampled_, id);
        return found == sampled_.end() ? nullptr : &found->history;
    }

    /// The same; from now on they are.
    History &operator[](ProxyId id)
    {
        const auto found = position(sampled_, id);
        if (found != sampled_.end())
            return found->history;
        sampled_.push_back({id, {}});
        return sampled_.back().history;
    }

    void forget(ProxyId id)
    {
        const auto found = position(sampled_, id);
        if (found == sampled_.end())
            return;
        *found = sampled_.back();
        sampled_.pop_back();
    }

    std::size_t bytes() const { return bytes_of(sampled_); }

private:
    std::vector<Sampled> sampled_;
};
} // namespace ode_predictive_space

#endif
