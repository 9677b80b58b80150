// The same small program run in two spaces: what it reports in a simple space is what it must report in a predictive one.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_SCENARIO_H
#define ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_SCENARIO_H

#include <functional>
#include <utility>
#include <vector>

#include "tests/contract/support/ode_test.h"

namespace ode_predictive_space
{
/// One near callback: the numbers of its two geoms, in the order in which it got them.
using Pair = std::pair<int, int>;
using Pairs = std::vector<Pair>;

/// The number that a geom got from number_geom(); it is kept as the geom's data.
int geom_number(dGeomID geom);
dGeomID number_geom(dGeomID geom, int number);

/// The callbacks of one dSpaceCollide() or dSpaceCollide2(), as they came.
Pairs collide(dSpaceID space);
Pairs collide2(dGeomID first, dGeomID second);

/// Each pair with the lower number first, all in order. Pairs that came twice stay twice.
Pairs unordered(Pairs pairs);

dGeomID as_geom(dSpaceID space);
dSpaceID as_space(dGeomID geom);

/// What a predictive space is asked at each tick. A small one predicts only once it has been asked.
enum class Asked
{
    nothing,
    validity,  ///< after the tick
    encounters ///< before it, so that even what is new is predicted at once, and then its validity
};

enum class SpaceKind
{
    simple,
    predictive
};

/// A world and a space of one kind, and the log of all that the space reported.
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

    /// A space of this scenario's kind.
    dSpaceID make_space(dSpaceID parent) const;

    /// Gives the geom the next number: 0, 1, 2, ...
    dGeomID numbered(dGeomID geom) { return number_geom(geom, next_number_++); }
    dGeomID sphere(dReal radius, dReal x, dReal y, dReal z);
    dGeomID box(dReal side, dReal x, dReal y, dReal z);
    dBodyID body(dGeomID geom, dReal vx, dReal vy, dReal vz);

    /// Adds a geom to a space of this scenario's kind.
    ///
    /// A simple space aborts when a clean geom is added while others are dirty; there the others are cleaned first.
    void add(dSpaceID space, dGeomID geom) const;

    /// dSpaceCollide(), logged without order; checks that no pair comes twice.
    void tick();
    /// dSpaceCollide2(), logged in order of the pairs but with each pair as it came.
    void query(dGeomID first, dGeomID second);
    /// A step of the world, the same in every run.
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

/// Runs the program in both kinds of space, in the predictive one with and without questions, and expects the same log, and that it is not all empty.
void expect_as_simple(const std::function<void(Scenario &)> &program);
} // namespace ode_predictive_space

#endif
