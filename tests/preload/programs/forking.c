/* A program whose children use ODE.
 * Usage: forking CHILDREN [busy]: with busy, a second thread collides all the time. */

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <ode/ode.h>

static atomic_int stop;

/* AddressSanitizer's search for leaks waits for ever in a child if the other thread was within malloc() at the fork. */
__attribute__((visibility("default"))) const char *__asan_default_options(void);
const char *__asan_default_options(void)
{
    return "detect_leaks=0";
}

static void count(void *data, dGeomID first, dGeomID second)
{
    (void)first;
    (void)second;
    ++*(int *)data;
}

static void collide(dSpaceID space)
{
    int pairs = 0;
    dSpaceCollide(space, &pairs, &count);
}

static void *collide_all_the_time(void *space)
{
    dAllocateODEDataForThread(dAllocateMaskAll);
    while (!stop)
        collide(space);
    return 0;
}

/* An alarm ends a child that waits for a resource of its parent's other thread. */
static int run_child(dSpaceID space)
{
    int status = -1;
    const pid_t child = fork();
    if (child == 0)
    {
        alarm(120);
        collide(space);
        exit(0);
    }
    waitpid(child, &status, 0);
    return status == 0;
}

int main(int argc, char **argv)
{
    const int busy = argc > 2;
    int children = argc > 1 ? atoi(argv[1]) : 0;
    int well = 1;
    dSpaceID space, other_space;
    pthread_t thread;
    dInitODE2(0);
    space = dHashSpaceCreate(0);
    dCreateSphere(space, 1);
    dCreateSphere(space, 1);
    other_space = dHashSpaceCreate(0);
    collide(space);
    collide(space);
    if (busy)
        pthread_create(&thread, 0, &collide_all_the_time, other_space);
    while (well && children-- > 0)
        well = run_child(space);
    stop = 1;
    if (busy)
        pthread_join(thread, 0);
    collide(space);
    return !well;
}
