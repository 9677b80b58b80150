/* A program that knows nothing of ODE and loads a library that does, with RTLD_LOCAL, as Python loads its extensions.
 * Usage: local LIBRARY */

#include <dlfcn.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    void *library = argc > 1 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : 0;
    void (*run)(void) = 0;
    if (library)
        *(void **)&run = dlsym(library, "run_scene");
    if (!run)
    {
        fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    run();
    return 0;
}
