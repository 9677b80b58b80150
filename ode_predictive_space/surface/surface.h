// What is touched in its hollows, too: not only where its hull is. In: steps of work. Out: can it be asked now?

#ifndef ODE_PREDICTIVE_SPACE_SURFACE_SURFACE_H
#define ODE_PREDICTIVE_SPACE_SURFACE_SURFACE_H

#include <cstddef>

namespace ode_predictive_space
{
/// Made ready in slices, as large as the caller likes, so that no tick waits for a large one.
class Surface
{
public:
    Surface() = default;
    virtual ~Surface() = default;
    Surface(const Surface &) = delete;
    Surface &operator=(const Surface &) = delete;

    /// Of triangles.
    virtual std::size_t count() const = 0;

    /// Goes on, for so many steps; each takes some 20 ns.
    ///
    /// @return the steps that are left.
    virtual std::size_t build(std::size_t steps) = 0;
    virtual bool is_ready() const = 0;

    virtual std::size_t bytes() const = 0;
};
} // namespace ode_predictive_space

#endif
