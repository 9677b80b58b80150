// Balls and boxes fall on a floor, in the predictive space. The one line that makes it predictive is marked.

#include <cstdio>
#include <ode/ode.h>
#include <ode_predictive_space/predictive_space.h>

namespace
{
dWorldID world;
dJointGroupID contacts;
int near_pairs;

void near_callback(void *, dGeomID first, dGeomID second)
{
    ++near_pairs;
    dContact contact[4] = {};
    const int count = dCollide(first, second, 4, &contact[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i)
    {
        contact[i].surface.mu = 0.5;
        dJointAttach(dJointCreateContact(world, contacts, &contact[i]), dGeomGetBody(first), dGeomGetBody(second));
    }
}

dBodyID drop(dSpaceID space, int number)
{
    const dBodyID body = dBodyCreate(world);
    const int row = number / 5 % 5;
    const int layer = number / 25;
    dBodySetPosition(body, 0.3 * (number % 5), 0.3 * row, 0.5 + 0.4 * layer);
    dGeomSetBody(number % 2 == 0 ? dCreateSphere(space, 0.1) : dCreateBox(space, 0.2, 0.2, 0.2), body);
    return body;
}
} // namespace

int main()
{
    dInitODE2(0);
    world = dWorldCreate();
    dWorldSetGravity(world, 0, 0, -9.81);
    contacts = dJointGroupCreate(0);

    dSpaceID space = dPredictiveSpaceCreate(nullptr); // before: dHashSpaceCreate(nullptr)

    dCreatePlane(space, 0, 0, 1, 0);
    dBodyID bodies[100];
    for (int i = 0; i < 100; ++i)
        bodies[i] = drop(space, i);

    for (int tick = 1; tick <= 1000; ++tick) // two seconds
    {
        near_pairs = 0;
        dSpaceCollide(space, nullptr, &near_callback);
        dWorldQuickStep(world, 0.002);
        dJointGroupEmpty(contacts);
        if (tick % 200 == 0)
            std::printf("%.1f s: the last body is at a height of %.2f m, %d of 5050 pairs are near\n", 0.002 * tick,
                        dBodyGetPosition(bodies[99])[2], near_pairs);
    }

    const bool on_the_floor = dBodyGetPosition(bodies[99])[2] > 0;
    dSpaceDestroy(space);
    dWorldDestroy(world);
    dCloseODE();
    return on_the_floor ? 0 : 1;
}
