// drawstuff without a window, for those of ODE's demos that check something and draw it: they are run for some steps.

#include <drawstuff/drawstuff.h>

extern "C" {
void dsSimulationLoop(int, char **, int, int, dsFunctions *functions)
{
    constexpr int steps = 200;
    functions->start();
    for (int i = 0; i < steps; ++i)
        functions->step(0);
}

void dsSetViewpoint(float *, float *) {}
void dsSetColor(float, float, float) {}
void dsSetColorAlpha(float, float, float, float) {}
void dsSetSphereQuality(int) {}
void dsSetCapsuleQuality(int) {}
void dsDrawBox(const float *, const float *, const float *) {}
void dsDrawBoxD(const double *, const double *, const double *) {}
void dsDrawSphere(const float *, const float *, float) {}
void dsDrawSphereD(const double *, const double *, float) {}
void dsDrawLine(const float *, const float *) {}
void dsDrawLineD(const double *, const double *) {}
void dsDrawCapsule(const float *, const float *, float, float) {}
void dsDrawCapsuleD(const double *, const double *, float, float) {}
void dsDrawCylinder(const float *, const float *, float, float) {}
void dsDrawCylinderD(const double *, const double *, float, float) {}
}
