/* A program in which a thread uses ODE for the first time while another one runs the constructor of a library, which uses
 * ODE, too: meanwhile the dynamic linker blocks other threads.
 * Usage: constructing LIBRARY */

#include <dlfcn.h>
#include <pthread.h>
#include <stdatomic.h>

#include <ode/ode.h>

__attribute__((visibility("default"))) atomic_int constructor_runs;

static void *use_ode(void *unused)
{
    (void)unused;
    while (!constructor_runs)
        continue;
    dSpaceDestroy(dHashSpaceCreate(0));
    return 0;
}

int main(int argc, char **argv)
{
    pthread_t user;
    void *library;
    dInitODE2(0);
    pthread_create(&user, 0, &use_ode, 0);
    library = argc > 1 ? dlopen(argv[1], RTLD_NOW) : 0;
    if (!library)
        return 1;
    pthread_join(user, 0);
    dCloseODE();
    return 0;
}
