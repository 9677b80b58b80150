// A set of objects for a stage of an update.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_WORKLIST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_WORKLIST_H

#include "ode_predictive_space/broadphase/base/id_set.h"

namespace ode_predictive_space
{
/// A set with a flag that is false only if the set is empty, so that an empty set need not be read.
class Worklist
{
public:
    void resize(std::size_t count) { ids_.resize(count); }

    void insert(ProxyId id)
    {
        ids_.insert(id);
        has_work_ = true;
    }
    void erase(ProxyId id) { ids_.erase(id); }
    void clear()
    {
        ids_.clear();
        has_work_ = false;
    }

    void demand() { has_work_ = true; }
    bool has_work() const { return has_work_; }

    template <typename Visit> void for_each(Visit visit) const { ids_.for_each(visit); }
    std::size_t bytes() const { return ids_.bytes(); }

private:
    IdSet ids_;
    bool has_work_ = false;
};
} // namespace ode_predictive_space

#endif
