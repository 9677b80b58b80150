#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_CONTENDER_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_CONTENDER_H

#include "demos/runs/pair_hash.h"

#include <memory>
#include <string>

namespace ode_predictive_space::worlds
{
enum class Family
{
    predictive, ///< this project's space
    ode,        ///< ODE's own spaces, which it replaces
    reference   ///< other ways to do the same work
};

/// One way to find pairs, as an ODE space: a scene puts its geoms into space(). A turn of some ticks begins with prepare();
/// each of its ticks is motion, dSpaceCollide() (which alone is timed), finish(), end_tick().
class Contender
{
public:
    /// @param name the name on command lines and in result files.
    Contender(std::string name, Family family, OwnedSpace space)
        : name_(std::move(name)), family_(family), space_(std::move(space))
    {}
    virtual ~Contender() = default;
    Contender(const Contender &) = delete;
    Contender &operator=(const Contender &) = delete;

    const std::string &name() const { return name_; }
    Family family() const { return family_; }
    dSpaceID space() const { return space_.get(); }

    /// Whether it reports every pair whose bounding boxes overlap, and no other.
    virtual bool exact() const { return true; }

    /// Called before the given number of ticks is made, outside of the measured time.
    virtual void prepare(int) {}

    /// Called after the dSpaceCollide() that filled this list, outside of the measured time. Adds the pairs that the contender
    /// found but did not report in time. @return the number of pairs removed from the list because their boxes are apart.
    virtual std::size_t finish(PairList &) { return 0; }

    /// Called before the next motion; outside of the measured time, unless several ticks are timed together.
    virtual void end_tick() {}

private:
    std::string name_;
    Family family_;
    OwnedSpace space_;
};
} // namespace ode_predictive_space::worlds

#endif
