#include "scene.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum
{
    sphere_count = 40,
    group_size = 5,
    tick_count = 30,
    most_pairs = 2000
};

struct pairs
{
    int keys[most_pairs];
    int count;
};

dSpaceID make_space(int space_class, dSpaceID parent)
{
    const dVector3 center = {0, 0, 0}, extents = {32, 32, 32};
    switch (space_class)
    {
    case dSimpleSpaceClass:
        return dSimpleSpaceCreate(parent);
    case dHashSpaceClass:
        return dHashSpaceCreate(parent);
    case dQuadTreeSpaceClass:
        return dQuadTreeSpaceCreate(parent, center, extents, 4);
    default:
        return dSweepAndPruneSpaceCreate(parent, dSAP_AXES_XYZ);
    }
}

int number_of(dGeomID geom)
{
    return (int)(intptr_t)dGeomGetData(geom);
}

static void on_pair(void *data, dGeomID first, dGeomID second)
{
    struct pairs *pairs = data;
    const int a = number_of(first), b = number_of(second);
    if (dGeomIsSpace(first) || dGeomIsSpace(second))
        dSpaceCollide2(first, second, data, &on_pair);
    else if (pairs->count < most_pairs)
        pairs->keys[pairs->count++] = a < b ? 1000 * a + b : 1000 * b + a;
}

int by_number(const void *a, const void *b)
{
    return *(const int *)a - *(const int *)b;
}

static void print_pairs(struct pairs *pairs)
{
    int i;
    qsort(pairs->keys, (size_t)pairs->count, sizeof pairs->keys[0], &by_number);
    printf("%d pairs:", pairs->count);
    for (i = 0; i < pairs->count; ++i)
        printf(" %d", pairs->keys[i]);
    printf("\n");
}

/* Quarters are exact in every number format that a space may use. */
static void place(dGeomID geom, int number, int tick)
{
    const int x = (number * 7 + tick * (number % 5 - 2)) % 41 - 20;
    const int y = (number * 11 + tick * (number % 3 - 1)) % 41 - 20;
    dGeomSetPosition(geom, 0.25 * x, 0.25 * y, 0.25 * (number % 4));
}

/* The last spheres are in groups: spaces of the same class inside the space. */
static void fill(dSpaceID space, int space_class, dGeomID *spheres)
{
    dSpaceID group = space;
    int i;
    for (i = 0; i < sphere_count; ++i)
    {
        if (i >= sphere_count / 2 && i % group_size == 0)
            group = make_space(space_class, space);
        spheres[i] = dCreateSphere(group, 0.5);
        dGeomSetData(spheres[i], (void *)(intptr_t)i);
    }
}

static void show_levels(dSpaceID space)
{
    int smallest = 0, largest = 0;
    dHashSpaceGetLevels(space, &smallest, &largest);
    printf("levels %d %d", smallest, largest);
    dHashSpaceSetLevels(space, -1, 5);
    dHashSpaceGetLevels(space, &smallest, &largest);
    printf(", then %d %d\n", smallest, largest);
}

static void run_in(int space_class)
{
    dGeomID spheres[sphere_count];
    dSpaceID space = make_space(space_class, 0);
    int i, tick;
    printf("class %d\n", dSpaceGetClass(space));
    if (space_class == dHashSpaceClass)
        show_levels(space);
    fill(space, space_class, spheres);
    printf("%d geoms\n", dSpaceGetNumGeoms(space));
    for (tick = 0; tick < tick_count; ++tick)
    {
        struct pairs pairs = {{0}, 0};
        for (i = 0; i < sphere_count; ++i)
            if (i % 4 != 0 || tick == 0)
                place(spheres[i], i, tick);
        dSpaceCollide(space, &pairs, &on_pair);
        print_pairs(&pairs);
    }
    dSpaceDestroy(space);
}

void run_scene(void)
{
    dInitODE2(0);
    run_in(dSimpleSpaceClass);
    run_in(dHashSpaceClass);
    run_in(dQuadTreeSpaceClass);
    run_in(dSweepAndPruneSpaceClass);
    dCloseODE();
}
