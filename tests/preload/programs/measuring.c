/* A program that uses the predictive space under another name: it changes the proximity test of its hash space. Two spheres
 * are apart, but their boxes overlap. With an argument, it makes a predictive space by its own name. */

#include <ode/ode.h>

#include <ode_predictive_space/predictive_space.h>

static void ignore(void *data, dGeomID first, dGeomID second)
{
    (void)data;
    (void)first;
    (void)second;
}

int main(int argc, char **argv)
{
    dSpaceID space;
    int i;
    (void)argv;
    dInitODE2(0);
    space = argc > 1 ? dPredictiveSpaceCreate(0) : dHashSpaceCreate(0);
    dCreateSphere(space, 1);
    dGeomSetPosition(dCreateSphere(space, 1), 1.9, 1.9, 0);
    if (dSpaceIsPredictive(space))
        dPredictiveSpaceSetProximity(space, dPredictiveProximitySphere);
    for (i = 0; i < 20; ++i)
        dSpaceCollide(space, 0, &ignore);
    dSpaceDestroy(space);
    dCloseODE();
    return 0;
}
