/* The functions that give ODE's demos, in C and C++, a haptic probe; see demo_options.h, which a patch adds to the demos. */

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_ODE_DEMO_PROBE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_ODE_DEMO_PROBE_H

#include <drawstuff/drawstuff.h>
#include <ode/common.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Reads the options: -probe DEVICE, -keys KEYS, -headless STEPS. Ends the program at an invalid option. */
void demoProbeOptions(int argc, char **argv);

/** From now on the demo uses this space. Its bounds (minx, maxx, miny, maxy, minz, maxz) are the reach of the probe. */
void demoProbeSpace(dSpaceID space, const dReal bounds[6]);

/** For the near callback. @return nonzero when the pair has been dealt with: the demo makes no contacts for it. */
int demoProbeTouch(dGeomID o1, dGeomID o2);

/** Between dSpaceCollide() and the step of the world: applies the force to the hand and its opposite to the touched bodies,
    then moves the probe. Not while the demo is paused. */
void demoProbeStep(void);

/** Destroys the probe's geom; call it before its space is destroyed. The next demoProbeStep() makes another one. */
void demoProbeDestroy(void);

/** In place of dsSimulationLoop(): with the probe drawn, and keys pressed as -keys says. Without a window it prints
    numbers of steps and pairs at the end, and ends the program with status 1 if a predictive space was not valid. */
void demoSimulationLoop(int argc, char **argv, int window_width, int window_height, dsFunctions *fn);

#ifdef __cplusplus
}
#endif

#endif
