/*
 * ode_predictive_space: a collision space for the Open Dynamics Engine that predicts when geoms can come near each
 * other and tests a pair only then.
 *
 * Copyright (c) the ode_predictive_space developers. BSD-3-Clause, see LICENSE.
 */

#ifndef ODE_PREDICTIVE_SPACE_PREDICTIVE_SPACE_H
#define ODE_PREDICTIVE_SPACE_PREDICTIVE_SPACE_H

#include <ode/collision_space.h>
#include <ode/common.h>

/** The version of this header, 0.1.0: 10000 times the major version, 100 times the minor one, and the patch.
    @see dPredictiveSpaceGetVersion */
#define ODE_PREDICTIVE_SPACE_VERSION 100

#if defined(__GNUC__) && !defined(_WIN32)
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
 * it. The functions below tune or query it; no program needs them.
 *
 * dHashSpaceSetLevels() and dHashSpaceGetLevels() do what they do on a hash space, without an effect on the pairs: a program whose
 * hash space is replaced may go on to call them. For this, dSpaceGetClass() of the plugin's space is dHashSpaceClass; inside ODE
 * it is dPredictiveSpaceClass. dSpaceIsPredictive() tells such a space from others.
 *
 * A geom that a near callback disables has no further pair in that dSpaceCollide(), nor in later ones until it is enabled. ODE's
 * own spaces differ here from one another: if it is the callback's first geom, all of them report its other pairs; if it is the
 * second, a hash and a sweep-and-prune space do, a simple and a quadtree space do not.
 *
 * The space keeps an envelope for each geom, a box that holds the geom and the path that is predicted for it, and tests the pairs
 * whose envelopes overlap. An envelope does not expire: a new one is made when the geom has left it. The steps of a program may be of
 * any length and may vary.
 *
 * A space of up to 16 geoms compares their boxes with one another, as a simple space does: that costs less than to predict. It begins
 * to predict with its seventeenth geom, with dPredictiveProximitySphere, with dPredictiveProximityShape as soon as there is a convex, mesh
 * or heightfield among them, when a role is set, and when it is asked for a time, for encounters or to be validated, and then never
 * ends. Until then its statistics count ticks and callbacks alone.
 *
 * Time is counted in ticks. A tick is one dSpaceCollide() on the space after something has moved: while nothing moves, no
 * time passes. In a program that only asks, the first question after a move counts as one, from the seventeenth in a row on. Lengths are in the
 * program's own unit (for instance metres), speeds in that unit per tick.
 *
 * Several threads may ask one space by dSpaceCollide2() at once as long as nothing is moved, added, removed or set: the first
 * question brings the space up to date, later ones only read. Each thread needs a probe of its own, and ODE's data
 * (dAllocateODEDataForThread()). dSpaceCollide(), also as dSpaceCollide2() of a space with itself, is for one thread at a time;
 * beside that of another thread it is refused with a message, and calls no callback. So is what the aabb function of a user class
 * asks the space that needs the box.
 *
 * All functions report invalid arguments through ODE's message handler (dSetMessageHandler()), with the name of the call
 * and of the argument, and then change nothing.
 *
 * @{
 */

/** When the callback is called for a pair whose bounding boxes overlap. */
enum
{
    dPredictiveProximityBox = 0, /**< always: the same pairs as dSimpleSpace (default) */
    dPredictiveProximitySphere =
        1, /**< when the bounding spheres overlap too, and for a ray in dSpaceCollide2() when it passes through the box:
                never a contact less, fewer useless calls */
    dPredictiveProximityShape =
        2 /**< when the shapes may touch, of convexes their convex hulls: of pairs with a convex, mesh or heightfield, or with a geom
               whose role is dPredictiveRoleInteractive. Other pairs, a few pairs of classes (docs/tuning.md lists them), and pairs for
               which the shape test would cost more than it saves, are reported when the boxes overlap. Never a contact less than dCollide()
               finds with ODE's own colliders, hardly a useless call. In dSpaceCollide2(), a ray is followed as by
               dPredictiveProximitySphere, and other probes are judged by shape beside convexes, meshes and heightfields; those
               that are one themselves only in the space that they are in. Also for the times of
               dPredictiveSpaceGetTimeOfProximity() and dPredictiveSpaceGetEncounters(). Not for programs that replace colliders
               with dSetColliderOverride(). @see dPredictiveSpaceGeomChanged */
};

/** How the motion of a geom is estimated. */
enum
{
    dPredictiveRoleEnvironment = 0, /**< part of the scene: from its body's velocity, or still (default) */
    dPredictiveRoleInteractive = 1  /**< driven by a person: from its recent positions alone */
};

/** A geom that another one can meet, and the time at which it can. @see dPredictiveSpaceGetEncounters */
typedef struct dPredictiveEncounter
{
    dGeomID geom; /**< the geom that can be met; owned by the space */
    dReal ticks;  /**< earliest time at which it can be near, from now, in ticks; 0 when it is near now */
} dPredictiveEncounter;

/** Counters since a space was created, and its present contents. @see dPredictiveSpaceGetStats */
typedef struct dPredictiveSpaceStats
{
    unsigned long ticks;         /**< dSpaceCollide() calls */
    unsigned long moved;         /**< geoms that ODE reported as moved and that had changed, summed over the ticks */
    unsigned long violations;    /**< geoms that were found outside of their envelopes */
    unsigned long repredictions; /**< new paths and envelopes */
    unsigned long scheduled;     /**< pairs now in the near set that are not tested: at rest until one of their geoms
                                      moves, or postponed (see dPredictiveSpaceCounters) */
    unsigned long woken;         /**< pairs that were at rest and are tested again */
    unsigned long near_pairs;    /**< pairs now in the near set: their envelopes overlap */
    unsigned long reported;      /**< callbacks made by dSpaceCollide() */
    unsigned long scans;         /**< ticks in which all envelopes were swept: more than a third of them were new */
    unsigned long bytes;         /**< memory that the space now holds, in bytes, without the geoms */
} dPredictiveSpaceStats;

/** Counters beside dPredictiveSpaceStats, since the space was made. New ones are added at the end.
    @see dPredictiveSpaceGetCounters */
typedef struct dPredictiveSpaceCounters
{
    unsigned long unchanged; /**< notices that left the size and the bounding box of a geom as they were, in single
                                  precision; of a geom that nothing is near to, the size and the centre. They count as no
                                  move, and time does not pass for them. Spheres, boxes and capsules, and cylinders that
                                  nothing is near to: other classes may have changed without a sign. */
    unsigned long postponed; /**< pairs whose boxes may overlap and that are now not tested, because their shapes cannot
                                  touch yet; see dPredictiveProximityShape */
    unsigned long looks;     /**< how often the gap between two shapes was looked for */
} dPredictiveSpaceCounters;

/**
 * Create a predictive space.
 *
 * @param parent the space that will contain it, or 0.
 * @return the space, to be destroyed with dSpaceDestroy() or by its parent; 0, after an ODE message, on failure. The plugin
 *         fails when it was not built for the ODE library in this process (another precision, another layout, or two
 *         copies of the library). An ODE with the space inside fails when it was built without it.
 */
ODE_PREDICTIVE_API dSpaceID dPredictiveSpaceCreate(dSpaceID parent);

/**
 * Get the version of the library in this process, in the form of ODE_PREDICTIVE_SPACE_VERSION, which is that of the header with
 * which a program was compiled.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceGetVersion(void);

/**
 * Test whether a space is predictive.
 *
 * @return 1 for a space made by dPredictiveSpaceCreate(), 0 for every other one.
 */
ODE_PREDICTIVE_API int dSpaceIsPredictive(dSpaceID space);

/** Set the test of proximity: dPredictiveProximityBox, dPredictiveProximitySphere or dPredictiveProximityShape. */
ODE_PREDICTIVE_API void dPredictiveSpaceSetProximity(dSpaceID space, int proximity);

/** @return the test of proximity. */
ODE_PREDICTIVE_API int dPredictiveSpaceGetProximity(dSpaceID space);

/**
 * Set up to which distance two shapes may touch, for dPredictiveProximityShape: for programs that act before there are contacts.
 * A thousandth of the smaller of the two sizes is added in any case, because ODE's colliders are not exact. Pairs whose
 * bounding boxes are apart are not reported whatever the margin.
 *
 * @param margin a length; finite and >= 0. The default is 0.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceSetShapeMargin(dSpaceID space, dReal margin);

/** @return that distance. */
ODE_PREDICTIVE_API dReal dPredictiveSpaceGetShapeMargin(dSpaceID space);

/**
 * Tell that the data which a geom is made of have been changed in place: the points of a convex, the vertices or triangles of a
 * mesh, the samples of a heightfield, or what its callback returns. With dPredictiveProximityShape, contacts may be missed without this
 * call: heights, for one, are read once. One call serves for all geoms of this space
 * with the same data, except that the bounding box is computed anew for this geom alone. Not needed when a geom is given other
 * arrays, by dGeomSetConvex(), dGeomTriMeshSetData() or dGeomTriMeshDataBuild...(), unless these had been given to a geom of the space
 * before and were changed since.
 *
 * The bounding box is the one that ODE computes. That of a mesh depends on a box which its data keep: after vertices were changed
 * in place, build the data again (dGeomTriMeshDataBuildSingle() and the like) before this call. dGeomTriMeshDataUpdate() alone
 * leaves that box as it was, so that every space, ODE's own also, misses pairs of a mesh that has grown.
 *
 * @param geom a geom in this space itself (not in a nested one).
 */
ODE_PREDICTIVE_API void dPredictiveSpaceGeomChanged(dSpaceID space, dGeomID geom);

/**
 * Build what dPredictiveProximityShape needs of the convexes, meshes and heightfields in a space and in the predictive spaces within it.
 * For programs with a person in the loop, who feels a tick that takes long: to be called when the scene stands.
 *
 * Without this call, the tree of a mesh's triangles is built when a pair first needs it: as a whole, which takes no longer than ODE
 * takes to build the data of the mesh. When the role of a geom in the space has been set as dPredictiveRoleInteractive, it is built in
 * slices of some 0.25 ms per tick, and meanwhile the pairs of the mesh are reported by box; so it is for what is added after this
 * call. Spaces by box and by sphere need nothing, and are left as they are.
 */
ODE_PREDICTIVE_API void dPredictiveSpacePrepare(dSpaceID space);

/**
 * Set how the motion of a geom is estimated. By default, a geom whose position changes although it has no body, or a
 * kinematic one, is treated as interactive.
 *
 * @param geom a geom in this space itself (not in a nested one).
 */
ODE_PREDICTIVE_API void dPredictiveSpaceSetGeomRole(dSpaceID space, dGeomID geom, int role);

/** @return the present role of the geom, as set or as recognised. */
ODE_PREDICTIVE_API int dPredictiveSpaceGetGeomRole(dSpaceID space, dGeomID geom);

/**
 * Fix the deviation R(t) = a + b t + c t^2: how far a geom of this role may be from its predicted path, t ticks after the
 * prediction. The envelope covers the path and, on all sides, the deviation at the end of the horizon. Larger values mean fewer
 * predictions, more pairs in the near set, and earlier times of proximity.
 *
 * By default the deviation adapts to each geom: it is a small part of the geom's size and of the way that the envelope covers.
 *
 * @param a length, b length per tick, c length per tick^2; each finite and >= 0. With all three 0, the deviation adapts again.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceSetDeviation(dSpaceID space, int role, dReal a, dReal b, dReal c);

/**
 * @param a,b,c receive the coefficients; each may be 0. The coefficients are 0 while the deviation adapts.
 * @return 1 when the deviation of this role is fixed, 0 when it adapts.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceGetDeviation(dSpaceID space, int role, dReal *a, dReal *b, dReal *c);

/**
 * Set the bounds of the horizon: for how many ticks of its path a geom's envelope is made, and for how many a time of proximity is
 * known. It adapts to each geom between the two bounds: an envelope covers a part of the geom's size up to four sizes of its
 * path, a time of proximity nine sizes. No envelope expires at its horizon.
 *
 * @param min_ticks >= 1. The default is 1.
 * @param max_ticks >= min_ticks, <= 1000000. The default is 2048.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceSetHorizon(dSpaceID space, int min_ticks, int max_ticks);

/** @param min_ticks,max_ticks receive the bounds; each may be 0. */
ODE_PREDICTIVE_API void dPredictiveSpaceGetHorizon(dSpaceID space, int *min_ticks, int *max_ticks);

/**
 * Get the earliest time at which two geoms of the space can come near each other, if both go on as they move now.
 *
 * A motion is this: per tick, the position is a polynomial of second degree, the geom turns by the same rotation about the same axis,
 * and the step is constant. The position is that of the geom's body, which the geom's offset turns about, or that of a geom without
 * a body, whether ODE or the program moves it; how velocities and forces bring the motion about does not matter. From the
 * third tick of the motion on, the time is never later than the meeting. Nothing is promised of other motions.
 *
 * The space learns motions from poses, one per tick, which it keeps of a geom from the first question about it on. The tick before
 * that question is the first of the three, if the space predicted by then. A motion that is seen to change, as by a bounce, begins again with its first tick: seen is
 * a change by a tenth of the longest of the last three steps. Until the third tick, nothing is known: the answer is 0, and the
 * time is 0. Planes and nested spaces have no position; while they move, nothing is known of them either. A geom that
 * has not moved during three ticks counts as still, and so does each geom when nothing has moved during eight dSpaceCollide(). Of
 * a geom whose role was set as interactive, the path is the one that fits the last eight positions best, so that the
 * promise begins with the eighth tick.
 *
 * Near are two geoms whose bounding boxes overlap; with dPredictiveProximityShape, two geoms whose shapes may touch. Those whose
 * boxes alone overlap then meet at the next tick at the earliest, and mostly later.
 *
 * @param ticks receives a time from now, in ticks; may be 0.
 * @return 1 when they can come near each other; the time is the earliest at which they can (0 when they are near now).
 *         0 when they stay apart as long as both keep to their motions; the time is the one up to which that is known: the end of
 *         the shorter horizon (dInfinity when both are still, 0 when the motion of one is not known yet).
 */
ODE_PREDICTIVE_API int dPredictiveSpaceGetTimeOfProximity(dSpaceID space, dGeomID first, dGeomID second, dReal *ticks);

/**
 * List the geoms that a geom can meet within its horizon and theirs, soonest first, in O(n). See
 * dPredictiveSpaceGetTimeOfProximity() for the times. Geoms whose motion is not known yet are listed when they are near now.
 * This is a question about each geom of the space.
 *
 * @param out an array of max encounters.
 * @return the number of encounters written.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceGetEncounters(dSpaceID space, dGeomID geom, dPredictiveEncounter *out, int max);

/** Read the statistics. */
ODE_PREDICTIVE_API void dPredictiveSpaceGetStats(dSpaceID space, dPredictiveSpaceStats *stats);

/**
 * Read the counters beside the statistics.
 *
 * @param counters gets them; must not be 0.
 * @param size sizeof(dPredictiveSpaceCounters) of the calling program. No more is written; counters that the library does not
 *        know are set to 0.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceGetCounters(dSpaceID space, dPredictiveSpaceCounters *counters,
                                                    unsigned long size);

/**
 * Check the invariant of the space by brute force, in O(n^2): every geom lies inside its envelope, and every pair whose
 * bounding boxes overlap is in the near set. With dPredictiveProximityShape, no pair that is left out because of its shapes has
 * a contact by dCollide().
 *
 * @return 1 when it holds; otherwise 0, after an ODE message that names the geoms.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceValidate(dSpaceID space);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
