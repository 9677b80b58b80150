/* What a demo of ODE needs to have a haptic probe in it. The demos are in C and in C++; see demo_options.h, which a patch adds
   to them. */

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_ODE_DEMO_PROBE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_ODE_DEMO_PROBE_H

#include <drawstuff/drawstuff.h>
#include <ode/common.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Reads the options: -probe DEVICE, -keys KEYS, -headless STEPS. Ends the program when one makes no sense. */
void demoProbeOptions(int argc, char **argv);

/**
 * The space that the demo uses from now on, and where things happen in it (minx, maxx, miny, maxy, minz, maxz): the probe
 * reaches all of that.
 */
void demoProbeSpace(dSpaceID space, const dReal bounds[6]);

/** For the near callback. @return nonzero when the pair has been dealt with: the demo makes no contacts for it. */
int demoProbeTouch(dGeomID o1, dGeomID o2);

/**
 * Between dSpaceCollide() and the step of the world: force on the hand, the opposite on what it touches; then the probe
 * moves on. Not while the demo is paused.
 */
void demoProbeStep(void);

/** The probe's geom goes: before its space does. The next demoProbeStep() makes another one. */
void demoProbeDestroy(void);

/**
 * In place of dsSimulationLoop(): with the probe drawn, and keys pressed as -keys says. Without a window it tells at the end
 * what became of the demo, and ends the program with status 1 if something is not as it should be.
 */
void demoSimulationLoop(int argc, char **argv, int window_width, int window_height, dsFunctions *fn);

#ifdef __cplusplus
}
#endif

#endif
