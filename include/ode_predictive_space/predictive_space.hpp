/*
 * The predictive space as a C++ class, in the style of <ode/odecpp_collision.h>.
 *
 * Copyright (c) the ode_predictive_space developers. BSD-3-Clause, see LICENSE.
 */

#ifndef ODE_PREDICTIVE_SPACE_PREDICTIVE_SPACE_HPP
#define ODE_PREDICTIVE_SPACE_PREDICTIVE_SPACE_HPP

#include <ode/ode.h>
#include <ode/odecpp.h>
#include <ode/odecpp_collision.h>
#include <ode_predictive_space/predictive_space.h>

/**
 * A predictive space. The object owns it: its destructor destroys the space, as those of dSimpleSpace, dHashSpace and
 * dQuadTreeSpace do.
 *
 * If the creation fails, id() is 0 (see dPredictiveSpaceCreate()), and each function below gives a message and has no effect.
 * Errors and thread safety are those of the C functions.
 */
class dPredictiveSpace : public dSpace
{
    // Never defined: a copy would destroy the space twice.
    dPredictiveSpace(const dPredictiveSpace &);
    void operator=(const dPredictiveSpace &);

public:
    /** Create a space that is in no other space. */
    dPredictiveSpace() { _id = reinterpret_cast<dGeomID>(dPredictiveSpaceCreate(0)); }

    /** Create a space inside `parent`. */
    explicit dPredictiveSpace(dSpace &parent) { _id = reinterpret_cast<dGeomID>(dPredictiveSpaceCreate(parent.id())); }

    /** Create a space inside `parent`, or in no other space if it is 0. */
    explicit dPredictiveSpace(dSpaceID parent) { _id = reinterpret_cast<dGeomID>(dPredictiveSpaceCreate(parent)); }

    /** See dPredictiveSpaceSetProximity(). */
    void setProximity(int proximity) { dPredictiveSpaceSetProximity(id(), proximity); }
    /** See dPredictiveSpaceGetProximity(). */
    int getProximity() const { return dPredictiveSpaceGetProximity(id()); }

    /** See dPredictiveSpaceSetShapeMargin(). */
    void setShapeMargin(dReal margin) { dPredictiveSpaceSetShapeMargin(id(), margin); }
    /** See dPredictiveSpaceGetShapeMargin(). */
    dReal getShapeMargin() const { return dPredictiveSpaceGetShapeMargin(id()); }

    /** See dPredictiveSpaceGeomChanged(). */
    void geomChanged(dGeomID geom) { dPredictiveSpaceGeomChanged(id(), geom); }

    /** See dPredictiveSpaceSetGeomRole(). */
    void setGeomRole(dGeomID geom, int role) { dPredictiveSpaceSetGeomRole(id(), geom, role); }
    /** See dPredictiveSpaceGetGeomRole(). */
    int getGeomRole(dGeomID geom) const { return dPredictiveSpaceGetGeomRole(id(), geom); }

    /** See dPredictiveSpaceSetDeviation(). */
    void setDeviation(int role, dReal a, dReal b, dReal c) { dPredictiveSpaceSetDeviation(id(), role, a, b, c); }
    /** See dPredictiveSpaceGetDeviation(). */
    int getDeviation(int role, dReal *a, dReal *b, dReal *c) const
    {
        return dPredictiveSpaceGetDeviation(id(), role, a, b, c);
    }

    /** See dPredictiveSpacePrepare(). */
    void prepare() { dPredictiveSpacePrepare(id()); }

    /** See dPredictiveSpaceSetHorizon(). */
    void setHorizon(int min_ticks, int max_ticks) { dPredictiveSpaceSetHorizon(id(), min_ticks, max_ticks); }
    /** See dPredictiveSpaceGetHorizon(). */
    void getHorizon(int *min_ticks, int *max_ticks) const { dPredictiveSpaceGetHorizon(id(), min_ticks, max_ticks); }

    /** See dPredictiveSpaceGetTimeOfProximity(). */
    int getTimeOfProximity(dGeomID first, dGeomID second, dReal *ticks) const
    {
        return dPredictiveSpaceGetTimeOfProximity(id(), first, second, ticks);
    }

    /** See dPredictiveSpaceGetEncounters(). */
    int getEncounters(dGeomID geom, dPredictiveEncounter *out, int max) const
    {
        return dPredictiveSpaceGetEncounters(id(), geom, out, max);
    }

    /** See dPredictiveSpaceGetStats(). @return the statistics; of indeterminate values if id() is 0. */
    dPredictiveSpaceStats getStats() const
    {
        dPredictiveSpaceStats stats;
        dPredictiveSpaceGetStats(id(), &stats);
        return stats;
    }

    /** See dPredictiveSpaceGetCounters(). @return the counters; of indeterminate values if id() is 0. */
    dPredictiveSpaceCounters getCounters() const
    {
        dPredictiveSpaceCounters counters;
        dPredictiveSpaceGetCounters(id(), &counters, sizeof counters);
        return counters;
    }

    /** See dPredictiveSpaceValidate(). */
    int validate() const { return dPredictiveSpaceValidate(id()); }
};

#endif
