/* A substitute for ODE that does hardly anything, so that a program can recognise it. Built into a program, it stands for a
 * static ODE; as a library, for a fork. */

#include <stdio.h>

#define VISIBLE __attribute__((visibility("default"), noinline))

VISIBLE void *dHashSpaceCreate(void *parent)
{
    /* Like an object with virtual functions, it begins with an address of its library. */
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
