#include "ode_predictive_space/broadphase/objects/scene.h"

#include <algorithm>
#include <limits>

#include "ode_predictive_space/broadphase/shape/convex_shape.h"

namespace ode_predictive_space
{
void Scene::follow(const ProxyId *, std::size_t count, ConvexShape *const *, double *moves)
{
    std::fill_n(moves, count, std::numeric_limits<double>::infinity());
}

bool Scene::hull_is_outdated(ProxyId, const ConvexShape &)
{
    return false;
}

bool Scene::is_excluded(ProxyId, ProxyId)
{
    return false;
}
} // namespace ode_predictive_space
