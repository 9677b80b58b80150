/* The scene of the test programs, written without knowledge of the predictive space. */

#ifndef SCENE_H
#define SCENE_H

#include <ode/ode.h>

/* Makes each kind of space, moves spheres through it, and prints the properties of the space and the pairs of each tick, in
 * a fixed order. Coordinates are such that every kind of space reports the same pairs. */
__attribute__((visibility("default"))) void run_scene(void);

/* A space of one of ODE's classes. */
dSpaceID make_space(int space_class, dSpaceID parent);

/* The number that is the data of a geom. */
int number_of(dGeomID geom);

/* For qsort(). */
int by_number(const void *a, const void *b);

#endif
