// How arrays grow that have an element for each object.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_GROWTH_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_GROWTH_H

#include <cstddef>
#include <vector>

namespace ode_predictive_space
{
/// Makes room for `count` elements; what is new is a T(). Where that takes new memory it is for a quarter more: doubling, as
/// vectors do by themselves, would leave a third of the memory of a large scene unused.
template <typename T> void grow(std::vector<T> &elements, std::size_t count)
{
    if (count > elements.capacity())
        elements.reserve(count + count / 4);
    elements.resize(count);
}
} // namespace ode_predictive_space

#endif
