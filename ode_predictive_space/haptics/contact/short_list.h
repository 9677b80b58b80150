// Linear search in the short lists of a tick.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SHORT_LIST_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SHORT_LIST_H

#include <algorithm>
#include <iterator>

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
} // namespace ode_predictive_space::haptics

#endif
