/* A program in which threads load and unload a library while another one uses ODE for the first time.
 * Usage: loading LIBRARY */

#include <dlfcn.h>
#include <pthread.h>
#include <stdatomic.h>

#include <ode/ode.h>

enum
{
    loader_count = 3
};

static atomic_int stop, loads;

static void *load_again_and_again(void *file)
{
    while (!stop)
    {
        void *library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
        if (library)
            dlclose(library);
        ++loads;
    }
    return 0;
}

int main(int argc, char **argv)
{
    pthread_t loaders[loader_count];
    int i;
    if (argc < 2)
        return 1;
    dInitODE2(0);
    for (i = 0; i < loader_count; ++i)
        pthread_create(&loaders[i], 0, &load_again_and_again, argv[1]);
    while (loads < 20)
        continue;
    dSpaceDestroy(dHashSpaceCreate(0));
    stop = 1;
    for (i = 0; i < loader_count; ++i)
        pthread_join(loaders[i], 0);
    dCloseODE();
    return 0;
}
