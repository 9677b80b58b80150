// The batch: the objects that get a new envelope in an update, as an array for order and a set for membership.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_BATCH_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_BATCH_H

#include <vector>

#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/base/memory.h"

namespace ode_predictive_space
{
class Batch
{
public:
    void resize(std::size_t count) { members_.resize(count); }

    void add(ProxyId id)
    {
        if (members_.contains(id))
            return;
        ids_.push_back(id); // may throw
        members_.insert(id);
    }

    void clear()
    {
        members_.clear();
        clear_scratch(ids_);
    }

    bool empty() const { return ids_.empty(); }
    std::size_t size() const { return ids_.size(); }
    bool contains(ProxyId id) const { return members_.contains(id); }

    const std::vector<ProxyId> &ids() const { return ids_; }

    std::size_t bytes() const { return members_.bytes() + bytes_of(ids_); }

private:
    std::vector<ProxyId> ids_;
    IdSet members_;
};
} // namespace ode_predictive_space

#endif
