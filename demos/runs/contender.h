#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_CONTENDER_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_CONTENDER_H

#include "demos/runs/pair_hash.h"

#include <memory>
#include <ode_predictive_space/predictive_space.h>
#include <string>

namespace ode_predictive_space::worlds
{
/// One way to find pairs, as an ODE space: a scene puts its geoms into space(). A tick is motion, dSpaceCollide(), finish().
class Contender
{
public:
    /// @param name the name on command lines and in result files.
    Contender(std::string name, OwnedSpace space) : name_(std::move(name)), space_(std::move(space)) {}
    virtual ~Contender() = default;
    Contender(const Contender &) = delete;
    Contender &operator=(const Contender &) = delete;

    const std::string &name() const { return name_; }
    dSpaceID space() const { return space_.get(); }

    bool is_predictive() const { return dSpaceIsPredictive(space()) != 0; }

    /// Whether it reports every pair whose bounding boxes overlap, and no other.
    bool exact() const { return !is_predictive() || dPredictiveSpaceGetProximity(space()) == dPredictiveProximityBox; }

    /// Called after the dSpaceCollide() that filled this list, outside of the measured time. Adds the pairs that the contender
    /// found but did not report in time. @return the number of pairs removed from the list because their boxes are apart.
    virtual std::size_t finish(PairList &list)
    {
        // ODE's sweep-and-prune space rounds its first axis to single precision: it reports pairs with a gap in the eighth digit.
        const bool rounds = dGeomGetClass(reinterpret_cast<dGeomID>(space())) == dSweepAndPruneSpaceClass;
        return rounds ? list.drop_pairs_apart() : 0;
    }

private:
    std::string name_;
    OwnedSpace space_;
};
} // namespace ode_predictive_space::worlds

#endif
