/* A program that is linked with ODE, and loads another one if it is told to.
 * Usage: linked [LIBRARY] */

#include <dlfcn.h>

#include "scene.h"

int main(int argc, char **argv)
{
    if (argc > 1 && !dlopen(argv[1], RTLD_NOW | RTLD_LOCAL))
        return 1;
    run_scene();
    return 0;
}
