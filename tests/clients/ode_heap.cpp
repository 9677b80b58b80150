// ODE alone: boxes and spheres fall on a floor, in a hash space as in ODE's manual.
// Usage: ode_heap [objects] [steps] [near|far|nan]. With "far", the last object is 1e10 m away; with "nan", it has no body and
// a height that is not a number. Prints the final positions of the others.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <ode/ode.h>

namespace
{
struct Scene
{
    dWorldID world;
    dSpaceID space;
    dJointGroupID contacts;
};

// ODE's colliders end the program at such a geom.
bool is_nowhere(dGeomID geom)
{
    dReal box[6];
    dGeomGetAABB(geom, box);
    return std::isnan(box[5]);
}

void near_callback(void *data, dGeomID first, dGeomID second)
{
    if (is_nowhere(first) || is_nowhere(second))
        return;
    const Scene &scene = *static_cast<Scene *>(data);
    dContact contacts[4] = {};
    const int count = dCollide(first, second, 4, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i)
    {
        contacts[i].surface.mu = 1;
        dJointAttach(dJointCreateContact(scene.world, scene.contacts, &contacts[i]), dGeomGetBody(first),
                     dGeomGetBody(second));
    }
}

dGeomID add_object(const Scene &scene, int number)
{
    dBodyID body = dBodyCreate(scene.world);
    dMass mass;
    dMassSetSphereTotal(&mass, 1, 0.2);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, 0.45 * (number % 10), 0.45 * (number / 10 % 10), 0.5 + 0.45 * (number / 100));
    dGeomID geom = number % 2 == 0 ? dCreateBox(scene.space, 0.4, 0.3, 0.3) : dCreateSphere(scene.space, 0.2);
    dGeomSetBody(geom, body);
    return geom;
}

void put(dGeomID object, const std::string &place)
{
    if (place == "far")
        dGeomSetPosition(object, 1e10, 0, 1);
    if (place == "nan")
    {
        dGeomSetBody(object, nullptr);
        dGeomSetPosition(object, 0, 0, std::numeric_limits<dReal>::quiet_NaN());
    }
}

void run(Scene &scene, int steps)
{
    for (int step = 0; step < steps; ++step)
    {
        dSpaceCollide(scene.space, &scene, &near_callback);
        dWorldStep(scene.world, 0.005);
        dJointGroupEmpty(scene.contacts);
    }
}
} // namespace

int main(int argc, char **argv)
{
    const int objects = argc > 1 ? std::atoi(argv[1]) : 300;
    const int steps = argc > 2 ? std::atoi(argv[2]) : 200;
    const std::string last = argc > 3 ? argv[3] : "near";
    dInitODE2(0);
    Scene scene{dWorldCreate(), dHashSpaceCreate(nullptr), dJointGroupCreate(0)};
    dWorldSetCFM(scene.world, 1e-7);
    dWorldSetGravity(scene.world, 0, 0, -9.81);
    dGeomSetPosition(dCreateBox(scene.space, 20, 20, 0.2), 0, 0, -0.1);
    std::vector<dGeomID> all;
    for (int number = 0; number < objects; ++number)
        all.push_back(add_object(scene, number));
    put(all.back(), last);
    run(scene, steps);
    const int counted = objects - (last == "near" ? 0 : 1);
    double sum[3] = {};
    for (int i = 0; i < counted; ++i)
        for (int axis = 0; axis < 3; ++axis)
            sum[axis] += dGeomGetPosition(all[static_cast<std::size_t>(i)])[axis];
    std::printf("%d objects, mean position %.17g %.17g %.17g\n", counted, sum[0] / counted, sum[1] / counted,
                sum[2] / counted);
    return 0;
}
