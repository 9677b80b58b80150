// What is compared: ways to find the pairs of geoms that are near each other.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_CONTENDER_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_CONTENDER_H

#include "demos/scenes/pair_list.h"

#include <memory>
#include <string>

namespace ode_predictive_space::scenes
{
struct SpaceDestroyer
{
    void operator()(dSpaceID space) const { dSpaceDestroy(space); }
};

using OwnedSpace = std::unique_ptr<dxSpace, SpaceDestroyer>;

enum class Family
{
    predictive, ///< what this project offers
    ode,        ///< ODE's own spaces: what it is to replace
    reference   ///< other ways to do the same work
};

/// One way to find pairs, in the shape of an ODE space: a scene puts its geoms into space(), and then each turn of some
/// ticks is prepare(), and each tick of it motion, dSpaceCollide() (which alone is timed), finish(), end_tick().
class Contender
{
public:
    /// @param name as on command lines and in result files.
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

    /// Called, outside the time that is measured, before so many ticks are made.
    virtual void prepare(int) {}

    /// Called, outside the time that is measured, after the dSpaceCollide() that filled this list; what the contender found
    /// but did not report in time it adds here.
    ///
    /// @return how many pairs it took out of the list because their boxes are apart.
    virtual std::size_t finish(PairList &) { return 0; }

    /// Called when all is done in a tick, before the next motion: outside the time that is measured, unless several ticks are
    /// timed at once.
    virtual void end_tick() {}

private:
    std::string name_;
    Family family_;
    OwnedSpace space_;
};
} // namespace ode_predictive_space::scenes

#endif
