/* Common uses of spaces beside colliding them, with every kind of space and with nested spaces of mixed kinds, twice: ODE is
 * closed and initialised again. The output must be the same for every replacement of a space. */

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "scene.h"

enum
{
    kind_count = 4,
    quadtree = 2,
    geom_count = 45,
    tick_count = 12,
    most_numbers = 10000
};

static int numbers[most_numbers];
static int number_count;

static dSpaceID make(int kind, dSpaceID parent)
{
    static const int classes[kind_count] = {dSimpleSpaceClass, dHashSpaceClass, dQuadTreeSpaceClass,
                                            dSweepAndPruneSpaceClass};
    return make_space(classes[kind], parent);
}

static void note(int number)
{
    if (number_count < most_numbers)
        numbers[number_count++] = number;
}

/* Each number is printed once: a quadtree has an infinite box and is met more often. */
static void print_noted(const char *what)
{
    int i;
    qsort(numbers, (size_t)number_count, sizeof numbers[0], &by_number);
    printf("%s:", what);
    for (i = 0; i < number_count; ++i)
        if (i == 0 || numbers[i] != numbers[i - 1])
            printf(" %d", numbers[i]);
    printf("\n");
    number_count = 0;
}

static void on_pair(void *data, dGeomID first, dGeomID second)
{
    const int a = number_of(first), b = number_of(second);
    if (dGeomIsSpace(first) || dGeomIsSpace(second))
        dSpaceCollide2(first, second, data, &on_pair);
    else
        note(a < b ? 1000 * a + b : 1000 * b + a);
}

/* Quarters are exact in every number format that a space may use. */
static void place(dGeomID geom, int number, int tick)
{
    const int x = (number * 7 + tick * (number % 5 - 2)) % 25 - 12;
    const int y = (number * 11 + tick * (number % 3 - 1)) % 25 - 12;
    dGeomSetPosition(geom, 0.25 * x, 0.25 * y, 0.25 * (number % 4));
}

static dGeomID numbered_sphere(dSpaceID space, int number)
{
    dGeomID sphere = dCreateSphere(space, 0.5);
    dGeomSetData(sphere, (void *)(intptr_t)number);
    place(sphere, number, 0);
    return sphere;
}

static void show_members(dSpaceID space)
{
    const dGeomID itself = (dGeomID)space;
    int mark;
    printf("class %d %d, space %d, cleanup %d %d, sublevel %d\n", dSpaceGetClass(space), dGeomGetClass(itself),
           dGeomIsSpace(itself), dSpaceGetCleanup(space), dSpaceGetManualCleanup(space), dSpaceGetSublevel(space));
    dSpaceSetSublevel(space, 3);
    dSpaceSetManualCleanup(space, 1);
    dGeomSetData(itself, &mark);
    printf("manual cleanup %d, sublevel %d, data %d\n", dSpaceGetManualCleanup(space), dSpaceGetSublevel(space),
           dGeomGetData(itself) == &mark);
    dSpaceSetManualCleanup(space, 0);
}

static void change(dSpaceID space, dGeomID *spheres, int tick)
{
    int i;
    for (i = 0; i < geom_count; ++i)
        if ((i + tick) % 3 != 0)
            place(spheres[i], i, tick);
    for (i = 0; i < 10; ++i)
    {
        if (tick == 2)
            dGeomDisable(spheres[i]);
        else if (tick == 4)
            dGeomEnable(spheres[i]);
        else if (tick == 6)
            dSpaceRemove(space, spheres[i]);
        else if (tick == 8)
            dSpaceAdd(space, spheres[i]);
    }
    if (tick == 9)
        dGeomSetCollideBits(spheres[3], 0);
    if (tick == 10)
        dSpaceClean(space);
}

/* A quadtree does not return its geoms. */
static void print_geoms(dSpaceID space, int kind)
{
    int i;
    for (i = 0; kind != quadtree && i < dSpaceGetNumGeoms(space); ++i)
        note(number_of(dSpaceGetGeom(space, i)));
    print_noted("geoms");
}

static void destroy_one_by_one(int kind)
{
    dSpaceID space = make(kind, 0);
    int i;
    for (i = 0; i < 5; ++i)
        numbered_sphere(space, i);
    while (kind != quadtree && dSpaceGetNumGeoms(space) > 0)
        dGeomDestroy(dSpaceGetGeom(space, 0));
    dSpaceDestroy(space);
}

static void use_one_space(int kind)
{
    dSpaceID space = make(kind, 0);
    dGeomID spheres[geom_count], probe = numbered_sphere(0, geom_count);
    int i, tick;
    show_members(space);
    for (i = 0; i < geom_count; ++i)
        spheres[i] = numbered_sphere(space, i);
    for (tick = 0; tick < tick_count; ++tick)
    {
        change(space, spheres, tick);
        dSpaceCollide(space, 0, &on_pair);
        print_noted("pairs");
        dSpaceCollide2(tick % 2 ? probe : (dGeomID)space, tick % 2 ? (dGeomID)space : probe, 0, &on_pair);
        print_noted("probe");
        printf("%d geoms, the first in it %d\n", dSpaceGetNumGeoms(space), dSpaceQuery(space, spheres[0]));
        print_geoms(space, kind);
    }
    dSpaceSetCleanup(space, 0);
    if (kind % 2)
        dSpaceDestroy(space);
    else
        dGeomDestroy((dGeomID)space);
    for (i = 0; i < geom_count; ++i)
        dGeomDestroy(spheres[i]);
    dGeomDestroy(probe);
    destroy_one_by_one(kind);
}

static void collide_each(dSpaceID top, dSpaceID middle, dSpaceID inner, dSpaceID other)
{
    dSpaceCollide(top, 0, &on_pair);
    dSpaceCollide(middle, 0, &on_pair);
    dSpaceCollide(inner, 0, &on_pair);
    print_noted("within");
    dSpaceCollide2((dGeomID)top, (dGeomID)other, 0, &on_pair);
    dSpaceCollide2((dGeomID)other, (dGeomID)middle, 0, &on_pair);
    print_noted("between");
    dSpaceCollide2((dGeomID)middle, (dGeomID)middle, 0, &on_pair);
    print_noted("with itself");
}

static void use_nested_spaces(int outer_kind, int middle_kind, int inner_kind, int sublevels)
{
    dSpaceID top = make(outer_kind, 0), middle = make(middle_kind, top), inner = make(inner_kind, middle);
    dSpaceID other = make(inner_kind, 0);
    dSpaceID spaces[4];
    dGeomID spheres[geom_count];
    int i, tick;
    spaces[0] = top;
    spaces[1] = middle;
    spaces[2] = inner;
    spaces[3] = other;
    if (sublevels)
    {
        dSpaceSetSublevel(middle, 1);
        dSpaceSetSublevel(inner, 2);
    }
    for (i = 0; i < geom_count; ++i)
        spheres[i] = numbered_sphere(spaces[i % 4], i);
    for (tick = 0; tick < 4; ++tick)
    {
        for (i = tick % 2; i < geom_count; i += 2)
            place(spheres[i], i, tick);
        collide_each(top, middle, inner, other);
        if (tick == 2)
        {
            dSpaceRemove(middle, (dGeomID)inner);
            /* ODE's own spaces overlook dirty geoms if a clean one is added in front of them. */
            dSpaceClean(top);
            dSpaceAdd(top, (dGeomID)inner);
        }
    }
    dSpaceDestroy(top);
    dSpaceDestroy(other);
}

static void use_ode(void)
{
    int i;
    dInitODE2(0);
    for (i = 0; i < kind_count; ++i)
        use_one_space(i);
    for (i = 0; i < 2 * kind_count * kind_count * kind_count; ++i)
        use_nested_spaces(i / 2 % kind_count, i / 8 % kind_count, i / 32, i % 2);
    dCloseODE();
}

int main(void)
{
    use_ode();
    use_ode();
    return 0;
}
