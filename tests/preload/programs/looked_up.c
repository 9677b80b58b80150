/* A program that looks up ODE's functions itself: nothing can come in between.
 * Usage: looked_up LIBRARY */

#include <dlfcn.h>
#include <stdio.h>

#include <ode/ode.h>

int main(int argc, char **argv)
{
    void *ode = argc > 1 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : 0;
    dSpaceID (*create)(dSpaceID) = 0;
    int (*space_class)(dSpaceID) = 0;
    void (*destroy)(dSpaceID) = 0;
    dSpaceID space;
    if (!ode)
        return 1;
    *(void **)&create = dlsym(ode, "dHashSpaceCreate");
    *(void **)&space_class = dlsym(ode, "dSpaceGetClass");
    *(void **)&destroy = dlsym(ode, "dSpaceDestroy");
    space = create(0);
    printf("class %d\n", space_class(space));
    destroy(space);
    return 0;
}
