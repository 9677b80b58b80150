/* drawstuff without a window: the simulation loop takes 500 steps, presses a key in every tenth, and draws nothing.
 * Functions that only draw are the same for all arguments. */

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum
{
    step_count = 500,
    steps_per_key = 10
};

struct functions /* as drawstuff's header has them */
{
    int version;
    void (*start)(void);
    void (*step)(int pause);
    void (*command)(int key);
    void (*stop)(void);
    const char *texture_path;
};

static int stopped;

void dsSimulationLoop(int argc, char **argv, int width, int height, struct functions *demo)
{
    /* Keys that drop, push and tip things over. */
    static const char keys[] = "bscyvxmf12";
    int step;
    (void)argc;
    (void)argv;
    (void)width;
    (void)height;
    if (demo->start)
        demo->start();
    for (step = 0; step < step_count && !stopped; ++step)
    {
        if (demo->command && step % steps_per_key == 0)
            demo->command(keys[step / steps_per_key % (int)(sizeof keys - 1)]);
        if (demo->step)
            demo->step(0);
    }
    if (demo->stop)
        demo->stop();
    printf("\n%d steps\n", step);
}

void dsStop(void)
{
    stopped = 1;
}

double dsElapsedTime(void)
{
    return 1.0 / 60;
}

static void say(const char *message, va_list values)
{
    vfprintf(stderr, message, values);
    fputc('\n', stderr);
}

void dsError(const char *message, ...)
{
    va_list values;
    va_start(values, message);
    say(message, values);
    va_end(values);
    exit(1);
}

void dsDebug(const char *message, ...)
{
    va_list values;
    va_start(values, message);
    say(message, values);
    va_end(values);
    abort();
}

#define DOES_NOTHING(function)                                                                                         \
    void function(void) {}
DOES_NOTHING(dsPrint)
DOES_NOTHING(dsSetViewpoint)
DOES_NOTHING(dsGetViewpoint)
DOES_NOTHING(dsSetTexture)
DOES_NOTHING(dsSetColor)
DOES_NOTHING(dsSetColorAlpha)
DOES_NOTHING(dsDrawBox)
DOES_NOTHING(dsDrawSphere)
DOES_NOTHING(dsDrawTriangle)
DOES_NOTHING(dsDrawTriangles)
DOES_NOTHING(dsDrawCylinder)
DOES_NOTHING(dsDrawCapsule)
DOES_NOTHING(dsDrawLine)
DOES_NOTHING(dsDrawConvex)
DOES_NOTHING(dsDrawBoxD)
DOES_NOTHING(dsDrawSphereD)
DOES_NOTHING(dsDrawTriangleD)
DOES_NOTHING(dsDrawTrianglesD)
DOES_NOTHING(dsDrawCylinderD)
DOES_NOTHING(dsDrawCapsuleD)
DOES_NOTHING(dsDrawLineD)
DOES_NOTHING(dsDrawConvexD)
DOES_NOTHING(dsSetSphereQuality)
DOES_NOTHING(dsSetCapsuleQuality)
DOES_NOTHING(dsSetDrawMode)
