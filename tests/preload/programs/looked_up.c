/* A program that looks up ODE's functions itself, as games do that can run without ODE. After a successful look-up,
 * dlerror() returns nothing.
 * Usage: looked_up LIBRARY */

#include <dlfcn.h>
#include <stdio.h>

#include <ode/ode.h>

static void *library;

static dSpaceID (*simple_create)(dSpaceID);
static dSpaceID (*hash_create)(dSpaceID);
static dSpaceID (*quadtree_create)(dSpaceID, const dReal *, const dReal *, int);
static dSpaceID (*sap_create)(dSpaceID, int);
static void (*collide)(dSpaceID, void *, dNearCallback *);
static void (*collide2)(dGeomID, dGeomID, void *, dNearCallback *);
static dGeomID (*create_sphere)(dSpaceID, dReal);
static void (*destroy)(dSpaceID);
static void (*destroy_geom)(dGeomID);
static int (*class_of)(dSpaceID);

static void *look_up(const char *name)
{
    void *function = dlsym(library, name);
    if (function && dlerror())
        printf("an error was left by %s\n", name);
    return function;
}

static void look_up_all(void)
{
    *(void **)&simple_create = look_up("dSimpleSpaceCreate");
    *(void **)&hash_create = look_up("dHashSpaceCreate");
    *(void **)&quadtree_create = look_up("dQuadTreeSpaceCreate");
    *(void **)&sap_create = look_up("dSweepAndPruneSpaceCreate");
    *(void **)&collide = look_up("dSpaceCollide");
    *(void **)&collide2 = look_up("dSpaceCollide2");
    *(void **)&create_sphere = look_up("dCreateSphere");
    *(void **)&destroy = look_up("dSpaceDestroy");
    *(void **)&destroy_geom = look_up("dGeomDestroy");
    *(void **)&class_of = look_up("dSpaceGetClass");
}

static void count_pair(void *count, dGeomID first, dGeomID second)
{
    (void)first;
    (void)second;
    ++*(int *)count;
}

static void run_in(dSpaceID space)
{
    dGeomID first = create_sphere(space, 1), second = create_sphere(space, 1), apart = create_sphere(0, 1);
    int pairs = 0;
    printf("class %d, ", class_of(space));
    collide(space, &pairs, count_pair);
    collide(space, &pairs, count_pair);
    collide2(first, second, &pairs, count_pair);
    collide2((dGeomID)space, apart, &pairs, count_pair);
    printf("pairs: %d\n", pairs);
    destroy_geom(apart);
    destroy(space);
}

int main(int argc, char **argv)
{
    const dVector3 center = {0, 0, 0}, extents = {32, 32, 32};
    int pairs = 0;
    library = argc > 1 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : 0;
    if (!library)
        return 1;
    look_up_all();
    if (!create_sphere)
    {
        collide(hash_create(0), &pairs, count_pair);
        return 0;
    }
    run_in(simple_create(0));
    run_in(hash_create(0));
    run_in(quadtree_create(0, center, extents, 3));
    run_in(sap_create(0, dSAP_AXES_XYZ));
    return 0;
}
