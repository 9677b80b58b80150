#include "demos/ode/census.h"

#include "ode_predictive_space/haptics/contact/scene_geoms.h"

namespace ode_predictive_space::ode_demos
{
namespace
{
bool is_finite(dBodyID body)
{
    using Values = Eigen::Map<const Eigen::Matrix<dReal, Eigen::Dynamic, 1>>;
    return Values(dBodyGetPosition(body), 3).allFinite() && Values(dBodyGetQuaternion(body), 4).allFinite() &&
           Values(dBodyGetLinearVel(body), 3).allFinite() && Values(dBodyGetAngularVel(body), 3).allFinite();
}

/// A contact between two bodies counts at the first of them.
int contacts_of(dBodyID body)
{
    int contacts = 0;
    for (int i = 0; i < dBodyGetNumJoints(body); ++i)
    {
        const dJointID joint = dBodyGetJoint(body, i);
        const dBodyID first = dJointGetBody(joint, 0);
        if (dJointGetType(joint) == dJointTypeContact && (first == body || first == nullptr))
            ++contacts;
    }
    return contacts;
}

void count_body(dBodyID body, Census &census)
{
    const dReal *position = dBodyGetPosition(body);
    ++census.bodies;
    census.resting += dBodyIsEnabled(body) == 0 ? 1 : 0;
    census.contacts += contacts_of(body);
    census.finite = census.finite && is_finite(body);
    census.mean_height += (position[2] - census.mean_height) / census.bodies;
    census.centres.extend(Eigen::Vector3d(position[0], position[1], position[2]));
}
} // namespace

Census take_census(dSpaceID space)
{
    Census census;
    haptics::for_each_geom(space, [&](dGeomID geom) {
        ++census.geoms;
        const dBodyID body = dGeomGetBody(geom);
        if (body != nullptr && dBodyGetFirstGeom(body) == geom)
            count_body(body, census);
    });
    return census;
}
} // namespace ode_predictive_space::ode_demos
