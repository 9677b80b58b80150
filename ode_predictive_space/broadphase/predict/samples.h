// The last poses of the objects that a program has asked about: how they move is known from these alone.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICT_SAMPLES_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICT_SAMPLES_H

#include <cstdint>
#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/objects/proxy_store.h"
#include "ode_predictive_space/broadphase/objects/scene.h"
#include "ode_predictive_space/prediction/track.h"

namespace ode_predictive_space
{
/// When a question is asked.
struct QueryTime
{
    Tick tick; ///< at which the objects are where they are now: the next one when something has moved since the last
    std::uint64_t collisions; ///< calls that were ticks if something had moved
};

/// Poses by object. An object is followed from the first question about it until it rests; then nothing of it is kept but the
/// number of its last move.
class Samples
{
public:
    /// An object is asked about: its track up to now; none when it rests.
    const Track *ask(Scene &scene, const ProxyStore &proxies, ProxyId id, const QueryTime &now);

    /// A tick: samples the objects that are sampled.
    void sample(Scene &scene, const ProxyStore &proxies, Tick now);

    void forget(ProxyId id);
    std::size_t bytes() const { return bytes_of(sampled_) + bytes_of(states_); }

private:
    struct Sampled
    {
        ProxyId id;
        UpdateNumber moved;                   // the last move that was sampled
        std::optional<std::uint64_t> unmoved; // since so many calls; none when it has moved since the last question
        Track track;
    };
    struct State
    {
        std::uint32_t index = unasked; // in sampled_, or one of the two
        UpdateNumber moved = 0;        // of an object that rests
    };
    static constexpr std::uint32_t unasked = ~std::uint32_t{0}, resting = unasked - 1;

    Sampled *follow(const ProxyStore &proxies, ProxyId id);
    static bool renew(Scene &scene, const ProxyStore &proxies, Sampled &sampled, Tick tick);
    void leave(ProxyId id, std::uint32_t as);

    std::vector<Sampled> sampled_;
    std::vector<State> states_; // by object
};
} // namespace ode_predictive_space

#endif
