// A list of objects for one stage of one tick, each of them at most once.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_ID_LIST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_ID_LIST_H

#include <algorithm>
#include <vector>

#include "ode_predictive_space/broadphase/base/ids.h"
#include "ode_predictive_space/broadphase/base/memory.h"

namespace ode_predictive_space
{
/// There is always room for all objects, so that adding one is a store and nothing else.
class IdList
{
public:
    /// Makes room for objects 0 to count - 1. The list stays, as far as there is room for it.
    void resize(std::size_t count)
    {
        resize_array(ids_, count);
        count_ = std::min(count_, count);
    }

    void clear() { count_ = 0; }
    void add(ProxyId id) { ids_[count_++] = id; }

    bool empty() const { return count_ == 0; }
    std::size_t size() const { return count_; }
    const ProxyId *data() const { return ids_.data(); }
    const ProxyId *begin() const { return ids_.data(); }
    const ProxyId *end() const { return ids_.data() + count_; }

    std::size_t bytes() const { return bytes_of(ids_); }

private:
    std::vector<ProxyId> ids_;
    std::size_t count_ = 0;
};
} // namespace ode_predictive_space

#endif
