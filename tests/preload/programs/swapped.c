/* A program whose first call for a space is to the library of the predictive space. */

#include <ode/ode.h>

#include <ode_predictive_space/predictive_space.h>

static void count_pair(void *count, dGeomID first, dGeomID second)
{
    (void)first;
    (void)second;
    ++*(int *)count;
}

int main(void)
{
    int pairs = 0;
    dSpaceID space;
    dInitODE2(0);
    space = dPredictiveSpaceCreate(0);
    dCreateSphere(space, 1);
    dCreateSphere(space, 1);
    dSpaceCollide(space, &pairs, &count_pair);
    dSpaceDestroy(space);
    dCloseODE();
    return pairs == 1 ? 0 : 1;
}
