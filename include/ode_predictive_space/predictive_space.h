/*
 * ode_predictive_space: a collision space for the Open Dynamics Engine that predicts when geoms can come near each
 * other and looks at a pair only then.
 *
 * Copyright (c) the ode_predictive_space developers. BSD-3-Clause, see LICENSE.
 */

#ifndef ODE_PREDICTIVE_SPACE_PREDICTIVE_SPACE_H
#define ODE_PREDICTIVE_SPACE_PREDICTIVE_SPACE_H

#include <ode/collision_space.h>
#include <ode/common.h>

#if defined(__GNUC__)
#define ODE_PREDICTIVE_API __attribute__((visibility("default")))
#else
#define ODE_PREDICTIVE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup predictive_space The predictive space
 * @ingroup collide
 *
 * A dSpace that is created by dPredictiveSpaceCreate() and used like any other: dSpaceAdd(), dSpaceCollide(),
 * dSpaceCollide2(), dSpaceDestroy(). It calls the near callback for exactly the pairs for which a simple space would call
 * it. The functions below tune it or ask it what it knows; no program needs them.
 *
 * Time is counted in ticks. A tick is one dSpaceCollide() on the space before which something has moved: while nothing
 * moves, no time passes. Lengths are in the program's own unit (metres, say), speeds in that unit per tick.
 *
 * All functions report bad arguments through ODE's message handler (dSetMessageHandler()), naming the call and the
 * argument, and then change nothing.
 */

/** When the callback is called for a pair whose bounding boxes overlap. */
enum
{
    dPredictiveProximityBox = 0, /**< always: the same pairs as dSimpleSpace (default) */
    dPredictiveProximitySphere =
        1 /**< when the bounding spheres overlap too, and for a ray in dSpaceCollide2() when it passes through the box:
               never a contact less, fewer useless calls */
};

/** How the motion of a geom is known. */
enum
{
    dPredictiveRoleEnvironment = 0, /**< part of the scene: its body's velocity, or stillness, tells (default) */
    dPredictiveRoleInteractive = 1  /**< driven by a person: its path is fitted to its recent positions */
};

/** A geom that another one can meet, and when. @see dPredictiveSpaceGetEncounters */
typedef struct dPredictiveEncounter
{
    dGeomID geom; /**< the geom that can be met; owned by the space */
    dReal ticks;  /**< earliest time at which it can be near, from now, in ticks; 0 when it is near now */
} dPredictiveEncounter;

/** What a space has done since it was made, and what it holds. @see dPredictiveSpaceGetStats */
typedef struct dPredictiveSpaceStats
{
    unsigned long ticks;         /**< dSpaceCollide() calls */
    unsigned long moved;         /**< geoms that ODE reported as moved, summed over the ticks */
    unsigned long verified;      /**< checks of a geom against its envelope */
    unsigned long violations;    /**< checks that found the geom outside */
    unsigned long repredictions; /**< new paths and envelopes */
    unsigned long scheduled;     /**< pairs that now sleep until their time of proximity */
    unsigned long woken;         /**< pairs whose time of proximity came */
    unsigned long near;          /**< pairs now in the near set */
    unsigned long reported;      /**< callbacks made by dSpaceCollide() */
    unsigned long
        scans; /**< sweeps over the whole scene: most geoms were new, prediction did not pay, or many predictions were due */
    unsigned long bytes; /**< memory that the space now holds, in bytes, geoms not counted */
} dPredictiveSpaceStats;

/**
 * Make a predictive space.
 *
 * @param parent the space to put it into, or 0.
 * @return the space, to be destroyed with dSpaceDestroy() or by its parent; 0, after an ODE message, when there is none to
 *         be had: from the plugin, when the ODE library in this process is not one that it was built for (another
 *         precision, another layout, or two copies); from an ODE with the space inside, when that was not built.
 */
ODE_PREDICTIVE_API dSpaceID dPredictiveSpaceCreate(dSpaceID parent);

/**
 * Tell whether a space is predictive.
 *
 * @return 1 for a space made by dPredictiveSpaceCreate(), 0 for every other one.
 */
ODE_PREDICTIVE_API int dSpaceIsPredictive(dSpaceID space);

/** Choose the measure of proximity: dPredictiveProximityBox or dPredictiveProximitySphere. */
ODE_PREDICTIVE_API void dPredictiveSpaceSetProximity(dSpaceID space, int proximity);

/** @return the measure of proximity. */
ODE_PREDICTIVE_API int dPredictiveSpaceGetProximity(dSpaceID space);

/**
 * Say how the motion of a geom is known. Left alone, a geom whose position changes although it has no body, or has a
 * kinematic one, is treated as interactive.
 *
 * @param geom a geom in this very space (not in a nested one).
 */
ODE_PREDICTIVE_API void dPredictiveSpaceSetGeomRole(dSpaceID space, dGeomID geom, int role);

/** @return the role that is in force for the geom, as set or as recognised. */
ODE_PREDICTIVE_API int dPredictiveSpaceGetGeomRole(dSpaceID space, dGeomID geom);

/**
 * Fix the deviation R(t) = a + b t + c t^2: how far a geom of this role may be from its predicted path, t ticks after the
 * prediction, before a new one is made. Larger values mean fewer predictions and more pairs in the near set.
 *
 * By default the deviation adapts to each geom: small where predictions came true, larger where they failed.
 *
 * @param a length, b length per tick, c length per tick^2; each finite and >= 0. All three 0: adapt again.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceSetDeviation(dSpaceID space, int role, dReal a, dReal b, dReal c);

/**
 * @param a,b,c where to put the coefficients; each may be 0. They get 0 while the deviation adapts.
 * @return 1 when the deviation of this role is fixed, 0 when it adapts.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceGetDeviation(dSpaceID space, int role, dReal *a, dReal *b, dReal *c);

/**
 * Bound the horizon: for how long a prediction is made. It adapts to each geom between the two bounds.
 *
 * @param min_ticks >= 1.
 * @param max_ticks >= min_ticks, <= 1000000.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceSetHorizon(dSpaceID space, int min_ticks, int max_ticks);

/** @param min_ticks,max_ticks where to put the bounds; each may be 0. */
ODE_PREDICTIVE_API void dPredictiveSpaceGetHorizon(dSpaceID space, int *min_ticks, int *max_ticks);

/**
 * Ask when two geoms of the space can come near each other, judging by the predictions that are now in force. From the first
 * question on the space predicts new geoms at once, which it otherwise watches for some ticks first.
 *
 * @param ticks gets a time from now, in ticks; may be 0.
 * @return 1 when they can, and the earliest time (0 when they are near now); or 0, and the time up to which they are known
 *         to stay apart as long as both keep to their predictions (dInfinity when both are still).
 */
ODE_PREDICTIVE_API int dPredictiveSpaceGetTimeOfProximity(dSpaceID space, dGeomID first, dGeomID second, dReal *ticks);

/**
 * List what a geom can meet within its horizon, soonest first.
 *
 * @param out room for max encounters.
 * @return how many were written.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceGetEncounters(dSpaceID space, dGeomID geom, dPredictiveEncounter *out, int max);

/** Read the counters. */
ODE_PREDICTIVE_API void dPredictiveSpaceGetStats(dSpaceID space, dPredictiveSpaceStats *stats);

/**
 * Check by brute force, in O(n^2), what everything rests on: every geom lies inside its envelope, and every pair whose
 * bounding boxes overlap is in the near set.
 *
 * @return 1 when this holds; 0, after an ODE message that names the geoms, when it does not.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceValidate(dSpaceID space);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
