/* A program whose threads use ODE for the first time all at once, each in its own space. (The spaces are destroyed at the
 * end: ODE's destructors pass memory to its constructors in other threads, which ThreadSanitizer takes for a race.) */

#include <pthread.h>
#include <stdio.h>

#include <ode/ode.h>

enum
{
    thread_count = 4,
    collide_count = 50
};

static pthread_barrier_t start;

static void count(void *data, dGeomID first, dGeomID second)
{
    (void)first;
    (void)second;
    ++*(int *)data;
}

struct use
{
    dSpaceID space;
    int pairs;
};

static void *use_ode(void *data)
{
    struct use *use = data;
    dGeomID sphere;
    int i;
    dAllocateODEDataForThread(dAllocateMaskAll);
    pthread_barrier_wait(&start);
    use->space = dHashSpaceCreate(0);
    dCreateSphere(use->space, 1);
    sphere = dCreateSphere(use->space, 1);
    for (i = 0; i < collide_count; ++i)
    {
        dGeomSetPosition(sphere, 0.5 * (i % 7), 0, 0);
        dSpaceCollide(use->space, &use->pairs, &count);
    }
    dCleanupODEAllDataForThread();
    return 0;
}

int main(void)
{
    pthread_t threads[thread_count];
    struct use uses[thread_count] = {{0}};
    int i;
    dInitODE2(0);
    pthread_barrier_init(&start, 0, thread_count);
    for (i = 0; i < thread_count; ++i)
        pthread_create(&threads[i], 0, &use_ode, &uses[i]);
    for (i = 0; i < thread_count; ++i)
        pthread_join(threads[i], 0);
    for (i = 0; i < thread_count; ++i)
    {
        printf("pairs: %d\n", uses[i].pairs);
        dSpaceDestroy(uses[i].space);
    }
    dCloseODE();
    return 0;
}
