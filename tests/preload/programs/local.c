/* A program without ODE that loads libraries with ODE one after the other, with RTLD_LOCAL, as Python loads its extensions;
 * each is unloaded before the next is loaded.
 * Usage: local LIBRARY... */

#include <dlfcn.h>
#include <stdio.h>

static int run_from(const char *file)
{
    void *library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    void (*run)(void) = 0;
    if (library)
        *(void **)&run = dlsym(library, "run_scene");
    if (!run)
    {
        fprintf(stderr, "%s\n", dlerror());
        return 0;
    }
    run();
    dlclose(library);
    return 1;
}

int main(int argc, char **argv)
{
    int i;
    for (i = 1; i < argc; ++i)
        if (!run_from(argv[i]))
            return 1;
    return 0;
}
