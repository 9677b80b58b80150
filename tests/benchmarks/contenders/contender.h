#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_CONTENDER_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_CONTENDER_H

#include "demos/worlds/pair_list.h"

#include <memory>
#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space::benchmarks
{
/// One way to find pairs, as an ODE space: a world puts its geoms into space(). A tick is motion, dSpaceCollide(), finish().
class Contender
{
public:
    explicit Contender(worlds::OwnedSpace space) : space_(std::move(space)) {}
    virtual ~Contender() = default;
    Contender(const Contender &) = delete;
    Contender &operator=(const Contender &) = delete;

    dSpaceID space() const { return space_.get(); }

    /// Whether it reports every pair whose bounding boxes overlap, and no other.
    bool exact() const
    {
        return dSpaceIsPredictive(space()) == 0 || dPredictiveSpaceGetProximity(space()) == dPredictiveProximityBox;
    }

    /// Called after the dSpaceCollide() that filled this list, outside of the measured time. Adds the pairs that the contender
    /// found but did not report in time, and removes those whose boxes are apart.
    virtual void finish(worlds::PairList &list) { list.drop_false_pairs(space()); }

private:
    worlds::OwnedSpace space_;
};
} // namespace ode_predictive_space::benchmarks

#endif
