/* What the programs of these tests do with ODE, as someone else would write it. */

#ifndef SCENE_H
#define SCENE_H

/* Makes each kind of space, moves spheres through it, and prints what the space says of itself and which pairs it reports in
 * each tick, in an order of its own. Coordinates are such that every kind of space reports the same pairs. */
__attribute__((visibility("default"))) void run_scene(void);

#endif
