// A small program in two spaces: a predictive space must report what a simple space reports.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_SCENARIO_H
#define ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_SCENARIO_H

#include <functional>
#include <utility>
#include <vector>

#include "tests/contract/support/ode_test.h"

namespace ode_predictive_space
{
/// One near callback: the numbers of its two geoms, in the order of the call.
using Pair = std::pair<int, int>;
using Pairs = std::vector<Pair>;

int geom_number(dGeomID geom);
dGeomID number_geom(dGeomID geom, int number);

Pairs collide(dSpaceID space);
Pairs collide2(dGeomID first, dGeomID second);

/// Each pair has the lower number first, and the pairs are sorted. Duplicates stay.
Pairs unordered(Pairs pairs);

dGeomID as_geom(dSpaceID space);
dSpaceID as_space(dGeomID geom);

/// Calls to a predictive space at each tick. A small space predicts only after such a call.
enum class Asked
{
    nothing,
    validity,  ///< after the tick
    encounters ///< before it, so that even new geoms are predicted at once, and validity after it
};

enum class SpaceKind
{
    simple,
    predictive
};

class Scenario
{
public:
    explicit Scenario(SpaceKind kind, Asked asked = Asked::validity);
    ~Scenario();
    Scenario(const Scenario &) = delete;
    Scenario &operator=(const Scenario &) = delete;

    dSpaceID space() const { return space_; }
    dWorldID world() const { return world_; }
    SpaceKind kind() const { return kind_; }
    const std::vector<Pairs> &log() const { return log_; }

    dSpaceID make_space(dSpaceID parent) const;

    dGeomID numbered(dGeomID geom) { return number_geom(geom, next_number_++); }
    dGeomID sphere(dReal radius, dReal x, dReal y, dReal z);
    dGeomID box(dReal side, dReal x, dReal y, dReal z);
    dBodyID body(dGeomID geom, dReal vx, dReal vy, dReal vz);

    /// A simple space aborts when a clean geom is added while others are dirty, so there the others are cleaned first.
    void add(dSpaceID space, dGeomID geom) const;

    /// dSpaceCollide(), logged without order. No pair may come twice.
    void tick();
    /// dSpaceCollide2(), logged with the pairs sorted, but each pair as it came.
    void query(dGeomID first, dGeomID second);
    void step(dReal seconds);
    void note(const Pairs &pairs) { log_.push_back(pairs); }

private:
    SpaceKind kind_;
    Asked asked_;
    dWorldID world_;
    dSpaceID space_;
    int next_number_ = 0;
    std::vector<Pairs> log_;
};

/// Logs of both kinds of space, of the predictive one with and without the calls of Asked, must be equal, and not all empty.
void expect_as_simple(const std::function<void(Scenario &)> &program);
} // namespace ode_predictive_space

#endif
