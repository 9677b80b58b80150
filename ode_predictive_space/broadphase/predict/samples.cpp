#include "ode_predictive_space/broadphase/predict/samples.h"

namespace ode_predictive_space
{
const Track *Samples::ask(Scene &scene, const ProxyStore &proxies, ProxyId id, const QueryTime &now)
{
    if (id >= states_.size())
        resize_array(states_, proxies.size());
    State &state = states_[id];
    if (state.resting == proxies.places[id].moved())
        return nullptr;
    if (!state.sampled)
        state.sampled = std::make_unique<Sampled>();
    Sampled &sampled = *state.sampled;
    if (renew(scene, proxies, id, sampled, now.tick) || !sampled.unmoved)
        sampled.unmoved = now.collisions;
    // While nothing moves, no time passes and no pose is sampled, so collisions are counted.
    const bool has_stayed = now.collisions - *sampled.unmoved >= tuning::calls_of_a_habit;
    if (!has_stayed && !sampled.track.rests())
        return &sampled.track;
    if (has_stayed)
        state.rest();
    return nullptr;
}

void Samples::sample(Scene &scene, const ProxyStore &proxies, Tick now)
{
    for (std::size_t id = 0; id < states_.size(); ++id)
    {
        State &state = states_[id];
        if (!state.sampled)
            continue;
        if (renew(scene, proxies, static_cast<ProxyId>(id), *state.sampled, now))
            state.sampled->unmoved.reset();
        else if (state.sampled->track.rests())
            state.rest();
    }
}

// @return whether the object has moved since its last pose, or this is the first pose.
bool Samples::renew(Scene &scene, const ProxyStore &proxies, ProxyId id, Sampled &sampled, Tick tick)
{
    const UpdateNumber moved = proxies.places[id].moved();
    if (sampled.moved == moved && sampled.track.has_begun())
    {
        sampled.track.repeat(tick);
        return false;
    }
    sampled.track.add(tick, scene.pose(id));
    sampled.moved = moved;
    return true;
}

void Samples::forget(ProxyId id)
{
    if (id < states_.size())
        states_[id] = {};
}

std::size_t Samples::bytes() const
{
    std::size_t sampled = 0;
    for (const State &state : states_)
        sampled += state.sampled != nullptr;
    return bytes_of(states_) + sampled * sizeof(Sampled);
}
} // namespace ode_predictive_space
