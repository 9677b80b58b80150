/* A program whose geom answers otherwise each time that it is asked whether it can touch a box: what a space reports and what
 * looking at all pairs finds then differ. */

#include <stdio.h>

#include <ode/ode.h>

static int no_contacts(dGeomID first, dGeomID second, int flags, dContactGeom *contacts, int skip)
{
    (void)first;
    (void)second;
    (void)flags;
    (void)contacts;
    (void)skip;
    return 0;
}

static dColliderFn *collider_for(int other_class)
{
    (void)other_class;
    return &no_contacts;
}

static void bounds(dGeomID geom, dReal box[6])
{
    int i;
    (void)geom;
    for (i = 0; i < 6; ++i)
        box[i] = i % 2 ? 1 : -1;
}

static int change_mind(dGeomID geom, dGeomID other, dReal box[6])
{
    static int answer = 0;
    (void)geom;
    (void)other;
    (void)box;
    answer = !answer;
    return answer;
}

static void count(void *data, dGeomID first, dGeomID second)
{
    (void)first;
    (void)second;
    ++*(int *)data;
}

int main(void)
{
    dGeomClass fickle = {0, &collider_for, &bounds, &change_mind, 0};
    dSpaceID space;
    int pairs = 0, i;
    dInitODE2(0);
    space = dHashSpaceCreate(0);
    dSpaceAdd(space, dCreateGeom(dCreateGeomClass(&fickle)));
    dCreateSphere(space, 0.5);
    for (i = 0; i < 20; ++i)
        dSpaceCollide(space, &pairs, &count);
    dSpaceDestroy(space);
    dCloseODE();
    printf("%s pairs\n", pairs > 0 ? "some" : "no");
    return 0;
}
