#ifndef ODE_PREDICTIVE_SPACE_SPACE_COUNTED_ID_SET_H
#define ODE_PREDICTIVE_SPACE_SPACE_COUNTED_ID_SET_H

#include "ode_predictive_space/broadphase/base/id_set.h"

namespace ode_predictive_space
{
/// A set that counts its objects, because every tick and every query checks whether it is empty.
class CountedIdSet
{
public:
    void resize(std::size_t count) { ids_.resize(count); }

    void insert(ProxyId id)
    {
        count_ += !ids_.contains(id);
        ids_.insert(id);
    }

    void erase(ProxyId id)
    {
        count_ -= ids_.contains(id);
        ids_.erase(id);
    }

    void clear()
    {
        ids_.clear();
        count_ = 0;
    }

    bool empty() const { return count_ == 0; }
    bool contains(ProxyId id) const { return ids_.contains(id); }
    template <typename Visit> void for_each(Visit visit) const { ids_.for_each(visit); }
    std::size_t bytes() const { return ids_.bytes(); }

private:
    IdSet ids_;
    std::size_t count_ = 0;
};
} // namespace ode_predictive_space

#endif
