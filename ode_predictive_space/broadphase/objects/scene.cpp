#include "ode_predictive_space/broadphase/objects/scene.h"

#include <algorithm>

#include "ode_predictive_space/broadphase/shape/convex_shape.h"

namespace ode_predictive_space
{
void Scene::update_shapes(const ProxyId *, std::size_t count, ConvexShape *shapes)
{
    std::fill_n(shapes, count, ConvexShape{});
}

bool Scene::hull_is_outdated(ProxyId, const ConvexShape &)
{
    return false;
}
} // namespace ode_predictive_space
