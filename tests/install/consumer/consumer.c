/* An independent program in C89: two spheres overlap, and one is apart. */

#include <stdio.h>

#include <ode/ode.h>
#include <ode_predictive_space/predictive_space.h>

static void count_pair(void *data, dGeomID first, dGeomID second)
{
    (void)first;
    (void)second;
    ++*(int *)data;
}

int main(void)
{
    int pairs = 0;
    int predictive;
    dSpaceID space;

    dInitODE2(0);
    space = dPredictiveSpaceCreate(0);
    if (!space)
        return 1;
    predictive = dSpaceIsPredictive(space);
    dCreateSphere(space, 1.0);
    dGeomSetPosition(dCreateSphere(space, 1.0), 1.5, 0.0, 0.0);
    dGeomSetPosition(dCreateSphere(space, 1.0), 9.0, 0.0, 0.0);
    dSpaceCollide(space, &pairs, &count_pair);
    dSpaceDestroy(space);
    dCloseODE();

    printf("predictive: %d, pairs: %d\n", predictive, pairs);
    return predictive == 1 && pairs == 1 ? 0 : 1;
}
