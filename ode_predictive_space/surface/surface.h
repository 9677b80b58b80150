// A mesh or heightfield, which can be touched inside its convex hull. In: steps of work. Out: whether it is ready for queries.

#ifndef ODE_PREDICTIVE_SPACE_SURFACE_SURFACE_H
#define ODE_PREDICTIVE_SPACE_SURFACE_SURFACE_H

#include <cstddef>

namespace ode_predictive_space
{
/// A surface is built in slices of any size, so that no tick waits for a large one.
class Surface
{
public:
    Surface() = default;
    virtual ~Surface() = default;
    Surface(const Surface &) = delete;
    Surface &operator=(const Surface &) = delete;

    virtual std::size_t count() const = 0; ///< of triangles

    /// Continues the build by up to `steps` steps of about 20 ns each. @return the unused steps.
    virtual std::size_t build(std::size_t steps) = 0;
    virtual bool is_ready() const = 0;

    virtual std::size_t bytes() const = 0;
};
} // namespace ode_predictive_space

#endif
