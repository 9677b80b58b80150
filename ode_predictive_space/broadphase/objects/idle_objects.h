// Disabled objects. They are in no reported pair, so the near set holds no pairs of them. ODE enables and disables geoms
// without notice. A disabled object is found when it gets a new envelope, or when the report reaches one of its pairs. From
// then on it is polled, so that it takes part again from the tick at which it is enabled.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_IDLE_OBJECTS_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_IDLE_OBJECTS_H

#include <vector>

#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/objects/scene.h"

namespace ode_predictive_space
{
class IdleObjects
{
public:
    void resize(std::size_t count) { members_.resize(count); }

    void note(Scene &scene, const ProxyId *ids, std::size_t count)
    {
        note(scene, ids, count, [](ProxyId) {});
    }

    /// Adds the objects that are disabled now, and calls visit(id) for each new one.
    template <typename Visit> void note(Scene &scene, const ProxyId *ids, std::size_t count, Visit visit)
    {
        if (count == 0)
            return;
        disabled_.clear();
        scene.find_disabled(ids, count, disabled_);
        for (ProxyId id : disabled_)
        {
            if (members_.contains(id))
                continue;
            members_.insert(id);
            ++count_;
            visit(id);
        }
    }

    template <typename Visit> void drop_enabled(Scene &scene, Visit visit)
    {
        if (count_ == 0)
            return;
        clear_scratch(polled_);
        disabled_.clear();
        members_.for_each([this](ProxyId id) { polled_.push_back(id); });
        scene.find_disabled(polled_.data(), polled_.size(), disabled_);
        auto disabled = disabled_.begin();
        for (ProxyId id : polled_)
            if (disabled != disabled_.end() && *disabled == id)
                ++disabled;
            else
            {
                forget(id);
                visit(id);
            }
    }

    void forget(ProxyId id)
    {
        count_ -= members_.contains(id);
        members_.erase(id);
    }

    void release()
    {
        free_memory(polled_);
        free_memory(disabled_);
    }

    bool contains(ProxyId id) const { return members_.contains(id); }
    const IdSet &members() const { return members_; }

    std::size_t bytes() const { return members_.bytes() + bytes_of(polled_) + bytes_of(disabled_); }

private:
    IdSet members_;
    std::size_t count_ = 0;                  // number of members_
    std::vector<ProxyId> polled_, disabled_; // scratch
};
} // namespace ode_predictive_space

#endif
