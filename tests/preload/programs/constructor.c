/* The library that constructing.c loads. */

#include <stdatomic.h>
#include <unistd.h>

#include <ode/ode.h>

extern atomic_int constructor_runs;

__attribute__((constructor)) static void use_ode(void)
{
    constructor_runs = 1;
    /* The other thread is in its call of ODE by then. */
    usleep(200000);
    dSpaceDestroy(dHashSpaceCreate(0));
}
