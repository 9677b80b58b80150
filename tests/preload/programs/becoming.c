/* A program that collides, and then executes itself again as the same process. */

#include <unistd.h>

#include <ode/ode.h>

static void ignore(void *data, dGeomID first, dGeomID second)
{
    (void)data;
    (void)first;
    (void)second;
}

int main(int count, char **arguments)
{
    dSpaceID space;
    dInitODE2(0);
    space = dHashSpaceCreate(0);
    dCreateSphere(space, 1);
    dSpaceCollide(space, 0, &ignore);
    if (count == 1)
        execl("/proc/self/exe", arguments[0], "again", (char *)0);
    return count == 1;
}
