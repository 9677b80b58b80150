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
 * dPredictiveSpaceCreate() makes a dSpace that is used like any other: dSpaceAdd(), dSpaceCollide(), dSpaceCollide2(),
 * dSpaceDestroy(). By default it calls the near callback for exactly the pairs of a simple space. The functions below tune or
 * query it; no program needs them. The method is that of Vogiannou, Moustakas, Tzovaras, Strintzis, "Enhancing Haptic Rendering
 * through Predictive Collision Detection"; docs/how_it_works.md has the differences.
 *
 * **Class.** dSpaceGetClass() of the plugin's space is dHashSpaceClass; inside ODE it is dPredictiveSpaceClass.
 * dSpaceIsPredictive() distinguishes it from other spaces. dHashSpaceSetLevels() and dHashSpaceGetLevels() work as on a hash
 * space, without an effect on the pairs, so that a program whose hash space is replaced may still call them.
 *
 * **Disabled geoms.** A geom that a near callback disables has no further pair in that dSpaceCollide(), nor in later ones until
 * it is enabled. ODE's own spaces differ from one another here: if it is the first geom of the callback, all of them report its
 * other pairs; if it is the second, a hash and a sweep-and-prune space do, a simple and a quadtree space do not.
 *
 * **Prediction.** Each geom has an envelope, a box that holds the geom and its predicted path. The space tests the pairs whose
 * envelopes overlap. An envelope never expires; a geom gets a new one after it has left it. Steps may have any length, and may
 * vary. A space of up to 16 geoms works as a simple space, because that costs less. It begins to predict, and then never stops,
 * with its seventeenth geom; with dPredictiveProximitySphere; with dPredictiveProximityShape as soon as it contains a convex,
 * mesh or heightfield; when a role is set; and with the first forecast query (a time of proximity, encounters) or validation.
 * Before, its statistics count only ticks and callbacks.
 *
 * **Units.** Lengths are in the program's unit (for instance metres), times in ticks, speeds in that unit per tick. A tick is
 * one dSpaceCollide() on the space after something has moved: while nothing moves, no time passes. In a program that only
 * queries, the first query after a move counts as a tick, from the ninth such query in a row on.
 *
 * **Threads.** dSpaceCollide() on a space, also as dSpaceCollide2() of the space with itself, is for one thread at a time; a
 * call beside that of another thread is refused with a message, and calls no callback. Several threads may call
 * dSpaceCollide2() on one space at once while nothing is moved, added, removed or set: the first query updates the space, later
 * ones only read. Several threads may also make forecast queries at once, which wait for one another. Each thread needs a separate
 * probe, and ODE's data (dAllocateODEDataForThread()). A query by the aabb function of a user class to the space that
 * needs the box is refused with a message. No other function may be called on the space meanwhile.
 *
 * **Errors.** Each function reports an invalid argument through ODE's message handler (dSetMessageHandler()), with the name of
 * the call and of the argument, changes nothing, and returns 0 unless said otherwise; the program continues. Handles must be
 * null or valid. If memory runs out, a call throws std::bad_alloc, and the next tick is exact.
 *
 * **Ownership.** The space is destroyed by dSpaceDestroy() or with its parent. It owns its geoms as other spaces do
 * (dSpaceSetCleanup()). No function here keeps a pointer that it gets, other than the space's own geoms.
 *
 * @{
 */

/** Tests of proximity: when the callback is called for a pair whose bounding boxes overlap. */
enum
{
    dPredictiveProximityBox = 0, /**< always: the pairs of a simple space (default) */
    dPredictiveProximitySphere =
        1, /**< when the bounding spheres overlap, too, and for a ray when it passes through the box. No contact is lost,
                and there are fewer useless calls. */
    dPredictiveProximityShape =
        2 /**< when the shapes may touch; convexes count as their convex hulls. This holds for pairs with a convex, mesh
               or heightfield, and for pairs with a geom whose role was set to dPredictiveRoleInteractive. Other pairs,
               some pairs of classes (docs/tuning.md lists them), and pairs for which the shape test would cost more than
               it saves, are reported when the boxes overlap. No contact is lost that dCollide() finds with ODE's own
               colliders, and hardly a call is useless. Programs that replace colliders with dSetColliderOverride()
               must not use it.

               In dSpaceCollide2(), a ray is tested as by dPredictiveProximitySphere. Other probes are tested by shape
               beside convexes, meshes and heightfields; probes of these classes only in the space that contains them.
               Times of dPredictiveSpaceGetTimeOfProximity() and dPredictiveSpaceGetEncounters() are those of the
               shapes. @see dPredictiveSpaceGeomChanged */
};

/** Roles: how the motion of a geom is predicted. */
enum
{
    dPredictiveRoleEnvironment = 0, /**< part of the scene: from its body's velocity, or still (default) */
    dPredictiveRoleInteractive = 1  /**< driven by a person: from its last positions alone */
};

/** A geom that another one can meet, and the time at which it can. @see dPredictiveSpaceGetEncounters */
typedef struct dPredictiveEncounter
{
    dGeomID geom; /**< the geom that can be met; not owned by the receiver */
    dReal ticks;  /**< earliest time at which it can be near, in ticks from now; 0 when it is near now */
} dPredictiveEncounter;

/** Counters since a space was created, and its present contents. dPredictiveSpaceGetStats() fills it; after a message about an
    invalid argument it writes nothing. */
typedef struct dPredictiveSpaceStats
{
    unsigned long ticks;         /**< dSpaceCollide() calls, also those before which nothing moved, without nested
                                      ones from callbacks */
    unsigned long moved;         /**< geoms reported as moved that had changed, summed over ticks and queries */
    unsigned long violations;    /**< geoms that were found outside their envelopes */
    unsigned long repredictions; /**< new paths and envelopes */
    unsigned long scheduled;     /**< pairs now in the near set that are not tested: resting until one of their geoms
                                      moves, or postponed (see dPredictiveSpaceCounters) */
    unsigned long woken;         /**< resting pairs that were tested again */
    unsigned long near_pairs;    /**< pairs now in the near set: their envelopes overlap */
    unsigned long reported;      /**< callbacks made by dSpaceCollide() */
    unsigned long scans;         /**< ticks in which all envelopes were swept: more than a third of them were new */
    unsigned long bytes;         /**< memory that the space now holds, in bytes, without the geoms */
} dPredictiveSpaceStats;

/** Counters beside dPredictiveSpaceStats, since the space was created. New ones are added at the end.
    @see dPredictiveSpaceGetCounters */
typedef struct dPredictiveSpaceCounters
{
    unsigned long unchanged; /**< notices of a move without a change of size and bounding box in single precision; for a
                                  geom with nothing near, of size and centre. They count as no move, and no time passes
                                  for them. Only spheres, boxes and capsules are counted, and cylinders with nothing
                                  near: other classes may have changed without a sign. */
    unsigned long postponed; /**< pairs now in the near set whose boxes may overlap and that are not tested, because
                                  their shapes cannot touch yet; see dPredictiveProximityShape */
    unsigned long gap_checks; /**< searches for the gap between two shapes */
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
 * @param space any space, or 0.
 * @return 1 for a space made by dPredictiveSpaceCreate(), 0 for every other one and for 0. There is no message.
 */
ODE_PREDICTIVE_API int dSpaceIsPredictive(dSpaceID space);

/**
 * Set the test of proximity. It holds from the next dSpaceCollide() or query on.
 *
 * @param space a predictive space.
 * @param proximity dPredictiveProximityBox (default), dPredictiveProximitySphere or dPredictiveProximityShape.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceSetProximity(dSpaceID space, int proximity);

/** @return the test of proximity; after a message about an invalid space, dPredictiveProximityBox. */
ODE_PREDICTIVE_API int dPredictiveSpaceGetProximity(dSpaceID space);

/**
 * Set the distance up to which two shapes count as touching, for programs that act before there are contacts. It has an effect
 * with dPredictiveProximityShape only. ODE's colliders are not exact, so a thousandth of the smaller of the two sizes is always
 * added. Pairs whose bounding boxes are apart are not reported, whatever the margin.
 *
 * @param space a predictive space.
 * @param margin a length; finite and >= 0. The default is 0.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceSetShapeMargin(dSpaceID space, dReal margin);

/** @return the margin of dPredictiveSpaceSetShapeMargin(), a length. */
ODE_PREDICTIVE_API dReal dPredictiveSpaceGetShapeMargin(dSpaceID space);

/**
 * Report that a geom's data were changed in place: the points of a convex, the vertices or triangles of a mesh, the samples of
 * a heightfield, or the results of its callback. With dPredictiveProximityShape, contacts may be missed without this call; for
 * instance, heights are read once.
 *
 * One call serves all geoms of this space with the same data, but computes the bounding box of this geom alone. No call is
 * needed when a geom gets other arrays by dGeomSetConvex(), dGeomTriMeshSetData() or dGeomTriMeshDataBuild...(), unless a geom
 * of the space had these arrays before and they were changed since.
 *
 * The bounding box is the one that ODE computes. For a mesh it depends on a box that is stored in the mesh's data: after
 * vertices were changed in place, build the data again (dGeomTriMeshDataBuildSingle() and the like) before this call.
 * dGeomTriMeshDataUpdate() alone does not change that box, so that every space, also ODE's own, misses pairs of a mesh that has
 * grown.
 *
 * @param space a predictive space.
 * @param geom a geom in this space itself (not in a nested one).
 */
ODE_PREDICTIVE_API void dPredictiveSpaceGeomChanged(dSpaceID space, dGeomID geom);

/**
 * Build what dPredictiveProximityShape needs of the convexes, meshes and heightfields in a space and in the predictive spaces
 * inside it. Call it when the scene is complete, in programs in which a person would feel a long tick. Spaces with another test
 * of proximity need no preparation and remain as they are.
 *
 * Without this call, the tree of a mesh's triangles is built when a pair first needs it, at once; this takes no longer than ODE
 * takes to build the mesh's data. If the role of a geom in the space was set to dPredictiveRoleInteractive, it is built in
 * slices of some 0.25 ms per tick, and the pairs of the mesh are reported by box meanwhile. Geoms added after this call are
 * treated likewise.
 *
 * @param space a predictive space.
 */
ODE_PREDICTIVE_API void dPredictiveSpacePrepare(dSpaceID space);

/**
 * Set how the motion of a geom is predicted, until the geom leaves the space. By default, a geom whose position changes
 * although it has no body, or a kinematic one, is recognised as interactive.
 *
 * @param space a predictive space.
 * @param geom a geom in this space itself (not in a nested one).
 * @param role dPredictiveRoleEnvironment or dPredictiveRoleInteractive.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceSetGeomRole(dSpaceID space, dGeomID geom, int role);

/**
 * @param space a predictive space.
 * @param geom a geom in this space itself (not in a nested one).
 * @return the present role of the geom, as set or as recognised; after a message, dPredictiveRoleEnvironment.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceGetGeomRole(dSpaceID space, dGeomID geom);

/**
 * Fix the deviation R(t) = a + b t + c t^2 of the paper: how far a geom of this role may be from its predicted path, t ticks
 * after the prediction. The envelope covers the path and, on all sides, the deviation at the end of the horizon. Larger values
 * give fewer predictions, more pairs in the near set, and earlier times of proximity.
 *
 * By default the deviation adapts to each geom: it is a small part of the geom's size and of the distance that the envelope
 * covers.
 *
 * @param space a predictive space; all its geoms get new envelopes.
 * @param role dPredictiveRoleEnvironment or dPredictiveRoleInteractive.
 * @param a length; finite and >= 0.
 * @param b length per tick; finite and >= 0.
 * @param c length per tick^2; finite and >= 0. With a, b and c all 0, the deviation adapts again.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceSetDeviation(dSpaceID space, int role, dReal a, dReal b, dReal c);

/**
 * @param space a predictive space.
 * @param role dPredictiveRoleEnvironment or dPredictiveRoleInteractive.
 * @param a,b,c receive the coefficients, or 0 while the deviation adapts; each pointer may be 0.
 * @return 1 when the deviation of this role is fixed, 0 when it adapts and, without a write, after a message.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceGetDeviation(dSpaceID space, int role, dReal *a, dReal *b, dReal *c);

/**
 * Set the bounds of the horizon, the number of ticks for which a path is followed. Between them, it adapts to each geom: an
 * envelope covers 0.01 to 4 sizes of the geom along its path, a time of proximity looks nine sizes ahead. No envelope expires
 * at its horizon.
 *
 * @param space a predictive space; all its geoms get new envelopes.
 * @param min_ticks >= 1. The default is 1.
 * @param max_ticks >= min_ticks, <= 1000000. The default is 2048.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceSetHorizon(dSpaceID space, int min_ticks, int max_ticks);

/**
 * @param space a predictive space.
 * @param min_ticks,max_ticks receive the bounds; each pointer may be 0. After a message, nothing is written.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceGetHorizon(dSpaceID space, int *min_ticks, int *max_ticks);

/**
 * Get the earliest time at which two geoms of the space can come near each other, if both continue their present motions.
 * Without dPredictiveProximityShape, two geoms are near when their bounding boxes overlap, and with dPredictiveProximitySphere
 * their spheres, too. With dPredictiveProximityShape they are near when their shapes may touch; if now only the boxes overlap,
 * they meet at the next tick at the earliest, and mostly later. (Equations 1 to 6 of the paper, with two corrections:
 * docs/how_it_works.md.)
 *
 * In a motion, the position is a polynomial of second degree in time, and the geom turns by the same rotation about the same
 * axis in each tick, with a constant step size. The position is that of the geom's body, about which the geom's offset turns,
 * or that of a geom without a body, whether ODE or the program moves it. From the third tick of the motion on, the time is
 * never later than the meeting. Nothing is promised for other motions.
 *
 * The space learns motions from poses, one per tick, which it samples for a geom from the first query about it on. The tick
 * before that query is the first of the three if the space already predicted. A motion begins again, with its first tick, after
 * a visible change, such as a bounce: a change of its acceleration by over a tenth of the longest of its last three steps.
 * Before the third tick the motion is unknown, so the result is 0 and the time is 0. Planes and nested spaces have no position;
 * while they move, their motion is unknown, too. A geom counts as still when it has not moved during three ticks, and each geom
 * does when nothing has moved during eight dSpaceCollide(). If the role of a geom was set to dPredictiveRoleInteractive, its
 * path is the least-squares fit of its last eight positions, so that the promise begins with the eighth tick.
 *
 * @param space a predictive space. It begins to predict, and is brought up to date.
 * @param first,second geoms in this space itself (not in a nested one).
 * @param ticks receives a time in ticks from now; may be 0. After a message, nothing is written.
 * @return 1 when they can come near each other; the time is the earliest at which they can (0 when they are near now). 0 when
 *         they stay apart as long as both keep to their motions; the time is the one up to which that is known: the end of the
 *         shorter horizon (dInfinity when both are still, 0 when the motion of one is unknown). 0 also after a message: an
 *         argument is invalid, or the space is being updated, in another thread or by the caller of an aabb function.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceGetTimeOfProximity(dSpaceID space, dGeomID first, dGeomID second, dReal *ticks);

/**
 * List the geoms that a geom can meet within its horizon and theirs, soonest first, in O(n). The times are those of
 * dPredictiveSpaceGetTimeOfProximity(), and this is a query about each geom of the space. Geoms whose motion is unknown are
 * listed when they are near now. If there are more than max of them, the later ones are left out.
 *
 * @param space a predictive space. It begins to predict, and is brought up to date.
 * @param geom a geom in this space itself (not in a nested one).
 * @param out an array of max encounters; may be 0 if max is 0.
 * @param max >= 0.
 * @return the number of encounters written; 0 also after a message, as for dPredictiveSpaceGetTimeOfProximity().
 */
ODE_PREDICTIVE_API int dPredictiveSpaceGetEncounters(dSpaceID space, dGeomID geom, dPredictiveEncounter *out, int max);

/** Read the statistics. */
ODE_PREDICTIVE_API void dPredictiveSpaceGetStats(dSpaceID space, dPredictiveSpaceStats *stats);

/**
 * Read the counters beside the statistics.
 *
 * @param space a predictive space.
 * @param counters receives them; must not be 0. After a message, nothing is written.
 * @param size sizeof(dPredictiveSpaceCounters) of the calling program. No more is written; counters that the library does not
 *        know are set to 0.
 */
ODE_PREDICTIVE_API void dPredictiveSpaceGetCounters(dSpaceID space, dPredictiveSpaceCounters *counters,
                                                    unsigned long size);

/**
 * Check the invariant of the space by brute force, in O(n^2): every geom lies inside its envelope, and every pair whose
 * bounding boxes overlap is in the near set. With dPredictiveProximityShape, no pair that is left out because of its shapes has
 * a contact by dCollide(). For tests.
 *
 * @param space a predictive space. It begins to predict, and is brought up to date.
 * @return 1 when the invariant holds; otherwise 0, after an ODE message that names the geoms. 0 also after a message that the
 *         space is invalid or being updated.
 */
ODE_PREDICTIVE_API int dPredictiveSpaceValidate(dSpaceID space);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
