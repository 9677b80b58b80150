#include "ode_predictive_space/broadphase/objects/scene.h"

#include <algorithm>

#include "ode_predictive_space/broadphase/shape/convex_shape.h"

namespace ode_predictive_space
{
void Scene::get_shapes(const ProxyId *, std::size_t count, ConvexShape *shapes)
{
    std::fill_n(shapes, count, ConvexShape{});
}
} // namespace ode_predictive_space
