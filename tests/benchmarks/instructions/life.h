// A scene that is replayed in a space, made and destroyed together.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_LIFE_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_LIFE_H

#include "tests/benchmarks/contenders/contenders.h"
#include "tests/benchmarks/replay.h"

#include <memory>
#include <string>

namespace ode_predictive_space::benchmarks
{
class Life
{
public:
    /// @param contender its name; empty: the geoms are in no space.
    /// @param factory must outlive this object.
    Life(std::string contender, const worlds::WorldFactory &factory) : name_(std::move(contender)), factory_(factory) {}
    ~Life() { end(); }
    Life(const Life &) = delete;
    Life &operator=(const Life &) = delete;

    void begin()
    {
        contender_ = name_.empty() ? nullptr : benchmarks::make_contender(name_, factory_);
        replay_ = std::make_unique<Replay>(factory_, contender_ == nullptr ? nullptr : contender_->space());
    }

    /// The space is destroyed first and leaves its geoms to the scene.
    void end()
    {
        if (contender_ != nullptr)
        {
            dSpaceSetCleanup(contender_->space(), 0);
            contender_.reset();
        }
        replay_.reset();
    }

    // Between begin() and end().
    Replay &replay() { return *replay_; }
    worlds::Contender &contender() { return *contender_; }

private:
    std::string name_;
    const worlds::WorldFactory &factory_;
    std::unique_ptr<worlds::Contender> contender_;
    std::unique_ptr<Replay> replay_;
};
} // namespace ode_predictive_space::benchmarks

#endif
