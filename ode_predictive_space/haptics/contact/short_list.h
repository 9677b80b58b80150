// Linear search in the short lists of a tick.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SHORT_LIST_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SHORT_LIST_H

#include "ode_predictive_space/haptics/touch.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace ode_predictive_space::haptics
{
template <typename List, typename Predicate> auto find_in(List &list, const Predicate &is_it)
{
    const auto found = std::find_if(std::begin(list), std::end(list), is_it);
    return found != std::end(list) ? &*found : nullptr;
}

template <typename List, typename Predicate> void remove_from(List &list, const Predicate &is_it)
{
    list.erase(std::remove_if(std::begin(list), std::end(list), is_it), std::end(list));
}

/// The entries of this tick and of the tick before. Allocates nothing for a number that it has seen before.
template <typename Entry> struct TwoTicks
{
    TwoTicks()
    {
        now.reserve(touch_capacity);
        before.reserve(touch_capacity);
    }

    void begin()
    {
        now.swap(before);
        now.clear();
    }

    void forget()
    {
        now.clear();
        before.clear();
    }

    std::vector<Entry> now;
    std::vector<Entry> before;
};
} // namespace ode_predictive_space::haptics

#endif
