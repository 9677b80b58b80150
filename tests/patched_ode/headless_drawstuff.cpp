// drawstuff without a window, for ODE's demos that check something and draw it: they run for some steps, each with a new scene,
// as if the space bar were pressed. With COUNT_BOXES in the environment, the number of boxes drawn in each step is printed:
// demo_collision draws one for each contact.

#include <cstdio>
#include <cstdlib>

#include <drawstuff/drawstuff.h>

static int boxes_drawn;

extern "C" {
void dsSimulationLoop(int, char **, int, int, dsFunctions *functions)
{
    constexpr int steps = 200;
    functions->start();
    for (int i = 0; i < steps; ++i)
    {
        boxes_drawn = 0;
        functions->command(' ');
        functions->step(0);
        if (std::getenv("COUNT_BOXES"))
            std::printf("step %d: %d boxes\n", i, boxes_drawn);
    }
}

void dsSetViewpoint(float *, float *) {}
void dsSetColor(float, float, float) {}
void dsSetColorAlpha(float, float, float, float) {}
void dsSetSphereQuality(int) {}
void dsSetCapsuleQuality(int) {}
void dsDrawBox(const float *, const float *, const float *)
{
    ++boxes_drawn;
}
void dsDrawBoxD(const double *, const double *, const double *)
{
    ++boxes_drawn;
}
void dsDrawSphere(const float *, const float *, float) {}
void dsDrawSphereD(const double *, const double *, float) {}
void dsDrawLine(const float *, const float *) {}
void dsDrawLineD(const double *, const double *) {}
void dsDrawCapsule(const float *, const float *, float, float) {}
void dsDrawCapsuleD(const double *, const double *, float, float) {}
void dsDrawCylinder(const float *, const float *, float, float) {}
void dsDrawCylinderD(const double *, const double *, float, float) {}
}
