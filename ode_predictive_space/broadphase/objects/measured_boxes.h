// The bounding boxes of objects as they were last looked at, and which of them are up to date.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_MEASURED_BOXES_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_MEASURED_BOXES_H

#include <vector>

#include "ode_predictive_space/broadphase/base/id_list.h"
#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/objects/scene.h"

namespace ode_predictive_space
{
/// Each box is measured at most once between two moves of its object, for whichever stage needs it first.
class MeasuredBoxes
{
public:
    void resize(std::size_t count)
    {
        resize_array(boxes_, count);
        valid_.resize(count);
        stale_.resize(count);
    }

    /// The boxes of objects that have moved have to be measured again.
    void invalidate(const IdSet &moved) { valid_ -= moved; }

    /// Measures the boxes of those wanted objects that are there and not up to date.
    ///
    /// @return these objects; valid until the next call.
    const IdList &update(Scene &scene, const IdSet &wanted, const IdSet &members)
    {
        stale_.clear();
        for (std::size_t i = 0; i < wanted.words(); ++i)
            IdSet::visit_word(i, wanted.word(i) & members.word(i) & ~valid_.word(i),
                              [this](ProxyId id) { stale_.add(id); });
        if (!stale_.empty())
            scene.measure(stale_.data(), stale_.size(), boxes_.data());
        valid_ |= wanted;
        return stale_;
    }

    /// Measures the boxes of the listed objects.
    void measure(Scene &scene, const IdList &ids)
    {
        if (ids.empty())
            return;
        scene.measure(ids.data(), ids.size(), boxes_.data());
        for (ProxyId id : ids)
            valid_.insert(id);
    }

    /// Is the object's box up to date?
    bool valid(ProxyId id) const { return valid_.contains(id); }

    const MeasuredBox &operator[](ProxyId id) const { return boxes_[id]; }
    const MeasuredBox *data() const { return boxes_.data(); }

    std::size_t bytes() const { return bytes_of(boxes_) + valid_.bytes() + stale_.bytes(); }

private:
    std::vector<MeasuredBox> boxes_;
    IdSet valid_;  // and some that are not there
    IdList stale_; // scratch
};
} // namespace ode_predictive_space

#endif
