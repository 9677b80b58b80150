/* An ODE that is none: so little of one that a program which is served by it can tell. Built into a program, it stands for a
 * static ODE; as a library, for a fork. */

#include <stdio.h>

#define VISIBLE __attribute__((visibility("default"), noinline))

VISIBLE void *dHashSpaceCreate(void *parent)
{
    /* As one that has virtual functions, it begins with an address of its library. */
    static void *space = &space;
    (void)parent;
    return &space;
}

VISIBLE void dSpaceCollide(void *space, void *data, void *callback)
{
    (void)space;
    (void)data;
    (void)callback;
    printf("collided by its own ODE\n");
}

VISIBLE int dSpaceGetNumGeoms(void *space)
{
    (void)space;
    return 7;
}
