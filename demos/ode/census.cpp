#include "demos/ode/census.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ode_predictive_space::ode_demos
{
namespace
{
bool all_finite(const dReal *values, int count)
{
    return std::all_of(values, values + count, [](dReal value) { return std::isfinite(value); });
}

bool is_finite(dBodyID body)
{
    return all_finite(dBodyGetPosition(body), 3) && all_finite(dBodyGetQuaternion(body), 4) &&
           all_finite(dBodyGetLinearVel(body), 3) && all_finite(dBodyGetAngularVel(body), 3);
}

/// A contact between two bodies has two ends; both are counted.
int contact_ends(dBodyID body)
{
    int ends = 0;
    for (int i = 0; i < dBodyGetNumJoints(body); ++i)
    {
        const dJointID joint = dBodyGetJoint(body, i);
        if (dJointGetType(joint) == dJointTypeContact)
        {
            const bool of_two = dJointGetBody(joint, 0) != nullptr && dJointGetBody(joint, 1) != nullptr;
            ends += of_two ? 1 : 2;
        }
    }
    return ends;
}

class Counter
{
public:
    void count_space(dSpaceID space)
    {
        if (dGeomGetClass(reinterpret_cast<dGeomID>(space)) == dQuadTreeSpaceClass)
        {
            count_quadtree(space);
            return;
        }
        for (int i = 0; i < dSpaceGetNumGeoms(space); ++i)
            count(dSpaceGetGeom(space, i));
    }

    Census result()
    {
        census_.contacts = contact_ends_ / 2;
        if (census_.bodies > 0)
            census_.mean_height /= census_.bodies;
        return census_;
    }

private:
    /// ODE's quadtrees cannot enumerate their geoms; a box around everything finds them.
    void count_quadtree(dSpaceID space)
    {
        constexpr dReal huge = 1e9;
        everywhere_ = dCreateBox(nullptr, huge, huge, huge);
        found_.clear();
        const auto near = [](void *data, dGeomID first, dGeomID second) {
            auto &self = *static_cast<Counter *>(data);
            self.found_.push_back(first == self.everywhere_ ? second : first);
        };
        dSpaceCollide2(reinterpret_cast<dGeomID>(space), everywhere_, this, near);
        dGeomDestroy(everywhere_);
        const std::vector<dGeomID> found = found_;
        std::for_each(found.begin(), found.end(), [this](dGeomID geom) { count(geom); });
        census_.finite = census_.finite && static_cast<int>(found.size()) == dSpaceGetNumGeoms(space);
    }

    void count(dGeomID geom)
    {
        if (dGeomIsSpace(geom) != 0)
            count_space(reinterpret_cast<dSpaceID>(geom));
        else
            count_geom(geom);
    }

    void count_geom(dGeomID geom)
    {
        ++census_.geoms;
        const dBodyID body = dGeomGetBody(geom);
        if (body == nullptr)
            return;
        census_.finite = census_.finite && all_finite(dGeomGetPosition(geom), 3);
        if (dBodyGetFirstGeom(body) == geom)
            count_body(body);
    }

    void count_body(dBodyID body)
    {
        ++census_.bodies;
        census_.resting += dBodyIsEnabled(body) == 0 ? 1 : 0;
        census_.finite = census_.finite && is_finite(body);
        contact_ends_ += contact_ends(body);
        const dReal *position = dBodyGetPosition(body);
        census_.centres.extend(Eigen::Vector3d(position[0], position[1], position[2]));
        census_.mean_height += position[2];
    }

    Census census_;
    dGeomID everywhere_ = nullptr; ///< a box around everything
    std::vector<dGeomID> found_;   ///< in a quadtree
    int contact_ends_ = 0;
};
} // namespace

Census take_census(dSpaceID space)
{
    Counter counter;
    counter.count_space(space);
    return counter.result();
}
} // namespace ode_predictive_space::ode_demos
