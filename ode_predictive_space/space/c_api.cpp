// The public C functions. Their arguments are checked here and nowhere else.

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ode_predictive_space/ode/check.h"
#include "ode_predictive_space/space/predictive_space.h"

using namespace ode_predictive_space;

namespace
{
constexpr int longest_horizon = 1000000;

static_assert(dPredictiveProximityBox == static_cast<int>(ProximityTest::box) &&
                  dPredictiveProximitySphere == static_cast<int>(ProximityTest::sphere) &&
                  dPredictiveProximityShape == static_cast<int>(ProximityTest::shape),
              "they are cast");

bool refuse(const char *function, const char *argument, const char *reason)
{
    dMessage(d_ERR_UASSERT, "%s(): bad argument %s: %s", function, argument, reason);
    return false;
}

bool checked_pointer(const char *function, const char *name, const void *pointer)
{
    return pointer || refuse(function, name, "it is null");
}

// The predictive space behind a handle, or null after a message.
dxPredictiveSpace *checked_space(const char *function, dSpaceID space)
{
    if (!checked_pointer(function, "space", space))
        return nullptr;
    if (dSpaceIsPredictive(space))
        return static_cast<dxPredictiveSpace *>(space);
    refuse(function, "space", "it is not a predictive space");
    return nullptr;
}

bool checked_geom(const char *function, const char *name, dxPredictiveSpace *space, dGeomID geom)
{
    return checked_pointer(function, name, geom) &&
           (geom->parent_space == space || refuse(function, name, "the geom is not in this space"));
}

bool checked_role(const char *function, int role)
{
    return role == dPredictiveRoleEnvironment || role == dPredictiveRoleInteractive ||
           refuse(function, "role", "it is not a dPredictiveRole constant");
}

bool checked_coefficient(const char *function, const char *name, dReal value)
{
    return (std::isfinite(value) && value >= 0) || refuse(function, name, "it must be finite and not negative");
}
} // namespace

dSpaceID dPredictiveSpaceCreate(dSpaceID parent)
{
    if (const char *mismatch = ode_mismatch())
    {
        dMessage(d_ERR_UASSERT, "dPredictiveSpaceCreate(): no space is made, as this ODE library cannot be used: %s",
                 mismatch);
        return nullptr;
    }
    if (parent && !dGeomIsSpace(reinterpret_cast<dGeomID>(parent)))
    {
        refuse("dPredictiveSpaceCreate", "parent", "it is not a space");
        return nullptr;
    }
    return new dxPredictiveSpace(parent);
}

int dPredictiveSpaceGetVersion(void)
{
    return ODE_PREDICTIVE_SPACE_VERSION;
}

int dSpaceIsPredictive(dSpaceID space)
{
    return space && dGeomIsSpace(space) && dynamic_cast<dxPredictiveSpace *>(space) != nullptr;
}

void dPredictiveSpaceSetProximity(dSpaceID space, int proximity)
{
    dxPredictiveSpace *self = checked_space(__func__, space);
    if (!self)
        return;
    if (proximity < dPredictiveProximityBox || proximity > dPredictiveProximityShape)
        refuse(__func__, "proximity", "it is not a dPredictiveProximity constant");
    else
        self->set_proximity_test(static_cast<ProximityTest>(proximity));
}

int dPredictiveSpaceGetProximity(dSpaceID space)
{
    const dxPredictiveSpace *self = checked_space(__func__, space);
    return static_cast<int>(self ? self->broadphase().proximity_test() : ProximityTest::box);
}

void dPredictiveSpaceSetShapeMargin(dSpaceID space, dReal margin)
{
    dxPredictiveSpace *self = checked_space(__func__, space);
    if (self && checked_coefficient(__func__, "margin", margin))
        self->set_shape_margin(margin);
}

dReal dPredictiveSpaceGetShapeMargin(dSpaceID space)
{
    const dxPredictiveSpace *self = checked_space(__func__, space);
    return self ? static_cast<dReal>(self->broadphase().shape_margin()) : 0;
}

void dPredictiveSpaceGeomChanged(dSpaceID space, dGeomID geom)
{
    dxPredictiveSpace *self = checked_space(__func__, space);
    if (self && checked_geom(__func__, "geom", self, geom))
        self->geom_changed(geom);
}

void dPredictiveSpacePrepare(dSpaceID space)
{
    if (dxPredictiveSpace *self = checked_space(__func__, space))
        self->make_hulls(__func__);
}

void dPredictiveSpaceSetGeomRole(dSpaceID space, dGeomID geom, int role)
{
    dxPredictiveSpace *self = checked_space(__func__, space);
    if (self && checked_geom(__func__, "geom", self, geom) && checked_role(__func__, role))
        self->set_role(geom, role == dPredictiveRoleInteractive ? Role::fixed_interactive : Role::fixed_environment);
}

int dPredictiveSpaceGetGeomRole(dSpaceID space, dGeomID geom)
{
    dxPredictiveSpace *self = checked_space(__func__, space);
    if (!self || !checked_geom(__func__, "geom", self, geom))
        return dPredictiveRoleEnvironment;
    return is_interactive(self->role(geom)) ? dPredictiveRoleInteractive : dPredictiveRoleEnvironment;
}

void dPredictiveSpaceSetDeviation(dSpaceID space, int role, dReal a, dReal b, dReal c)
{
    dxPredictiveSpace *self = checked_space(__func__, space);
    if (!self || !checked_role(__func__, role) || !checked_coefficient(__func__, "a", a) ||
        !checked_coefficient(__func__, "b", b) || !checked_coefficient(__func__, "c", c))
        return;
    PredictionSettings settings = self->broadphase().settings();
    settings.deviation[static_cast<std::size_t>(role)] =
        a == 0 && b == 0 && c == 0 ? std::nullopt : std::optional(Deviation{a, b, c});
    self->set_settings(settings);
}

int dPredictiveSpaceGetDeviation(dSpaceID space, int role, dReal *a, dReal *b, dReal *c)
{
    const dxPredictiveSpace *self = checked_space(__func__, space);
    if (!self || !checked_role(__func__, role))
        return 0;
    const auto &fixed = self->broadphase().settings().deviation[static_cast<std::size_t>(role)];
    const Deviation deviation = fixed.value_or(Deviation{});
    if (a)
        *a = static_cast<dReal>(deviation.a);
    if (b)
        *b = static_cast<dReal>(deviation.b);
    if (c)
        *c = static_cast<dReal>(deviation.c);
    return fixed.has_value();
}

void dPredictiveSpaceSetHorizon(dSpaceID space, int min_ticks, int max_ticks)
{
    dxPredictiveSpace *self = checked_space(__func__, space);
    if (!self)
        return;
    PredictionSettings settings = self->broadphase().settings();
    settings.horizon = {static_cast<std::uint32_t>(min_ticks), static_cast<std::uint32_t>(max_ticks)};
    if (min_ticks < 1)
        refuse(__func__, "min_ticks", "it must be at least 1");
    else if (max_ticks < min_ticks)
        refuse(__func__, "max_ticks", "it must not be less than min_ticks");
    else if (max_ticks > longest_horizon)
        refuse(__func__, "max_ticks", "it must not be more than 1000000");
    else
        self->set_settings(settings);
}

void dPredictiveSpaceGetHorizon(dSpaceID space, int *min_ticks, int *max_ticks)
{
    const dxPredictiveSpace *self = checked_space(__func__, space);
    if (!self)
        return;
    const HorizonBounds &horizon = self->broadphase().settings().horizon;
    if (min_ticks)
        *min_ticks = static_cast<int>(horizon.min_ticks);
    if (max_ticks)
        *max_ticks = static_cast<int>(horizon.max_ticks);
}

int dPredictiveSpaceGetTimeOfProximity(dSpaceID space, dGeomID first, dGeomID second, dReal *ticks)
{
    dxPredictiveSpace *self = checked_space(__func__, space);
    if (!self || !checked_geom(__func__, "first", self, first) || !checked_geom(__func__, "second", self, second))
        return 0;
    const auto lock = self->begin_query(__func__);
    if (!lock)
        return 0;
    double apart_until;
    const std::optional<double> time = self->time_of_proximity(first, second, &apart_until);
    if (ticks)
        *ticks = static_cast<dReal>(time.value_or(apart_until));
    return time.has_value();
}

int dPredictiveSpaceGetEncounters(dSpaceID space, dGeomID geom, dPredictiveEncounter *out, int max)
{
    dxPredictiveSpace *self = checked_space(__func__, space);
    if (!self || !checked_geom(__func__, "geom", self, geom))
        return 0;
    if (max < 0)
        return refuse(__func__, "max", "it is negative");
    if (max > 0 && !checked_pointer(__func__, "out", out))
        return 0;
    const auto lock = self->begin_query(__func__);
    if (!lock)
        return 0;
    int count = 0;
    for (const dxPredictiveSpace::Encounter &met : self->encounters(geom))
        if (count < max)
            out[count++] = {met.geom, static_cast<dReal>(met.ticks)};
    return count;
}

void dPredictiveSpaceGetStats(dSpaceID space, dPredictiveSpaceStats *stats)
{
    const dxPredictiveSpace *self = checked_space(__func__, space);
    if (!self || !checked_pointer(__func__, "stats", stats))
        return;
    const Counters &counters = self->broadphase().counters();
    stats->ticks = self->ticks();
    stats->moved = counters.moved;
    stats->violations = counters.violations;
    stats->repredictions = counters.repredictions;
    stats->scheduled = self->broadphase().waiting_pairs();
    stats->woken = self->broadphase().woken_pairs();
    stats->near_pairs = self->broadphase().near_pairs();
    stats->reported = self->reported();
    stats->scans = counters.sweeps;
    stats->bytes = self->bytes();
}

void dPredictiveSpaceGetCounters(dSpaceID space, dPredictiveSpaceCounters *counters, unsigned long size)
{
    const dxPredictiveSpace *self = checked_space(__func__, space);
    if (!self || !checked_pointer(__func__, "counters", counters))
        return;
    const Broadphase &broadphase = self->broadphase();
    dPredictiveSpaceCounters known; // on Windows, their type is narrower than ours
    known.unchanged = static_cast<unsigned long>(self->unchanged());
    known.postponed = static_cast<unsigned long>(broadphase.postponed_pairs());
    known.gap_checks = static_cast<unsigned long>(broadphase.counters().gap_checks);
    std::memset(counters, 0, size);
    std::memcpy(counters, &known, std::min<std::size_t>(size, sizeof known));
}

int dPredictiveSpaceValidate(dSpaceID space)
{
    dxPredictiveSpace *self = checked_space(__func__, space);
    if (!self)
        return 0;
    const dxPredictiveSpace::Violation violation = self->find_violation();
    if (violation.second)
        dMessage(d_ERR_IASSERT, "%s(): %s: %p and %p", __func__, violation.what,
                 static_cast<const void *>(violation.first), static_cast<const void *>(violation.second));
    else if (violation.first)
        dMessage(d_ERR_IASSERT, "%s(): %s: %p", __func__, violation.what, static_cast<const void *>(violation.first));
    else if (violation.what)
        dMessage(d_ERR_IASSERT, "%s(): %s", __func__, violation.what);
    return violation.what == nullptr;
}
