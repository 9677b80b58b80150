#include "ode_predictive_space/broadphase/predict/samples.h"

namespace ode_predictive_space
{
const Track *Samples::ask(Scene &scene, const ProxyStore &proxies, ProxyId id, const QueryTime &now)
{
    Sampled *sampled = follow(proxies, id);
    if (!sampled)
        return nullptr;
    const bool moved = renew(scene, proxies, *sampled, now.tick);
    if (moved || !sampled->unmoved)
        sampled->unmoved = now.collisions;
    // While nothing moves, no time passes and no pose is sampled, so collisions are counted.
    const bool has_stayed = now.collisions - *sampled->unmoved >= tuning::calls_of_a_habit;
    if (!has_stayed && !sampled->track.rests())
        return &sampled->track;
    if (has_stayed)
        leave(id, resting);
    return nullptr;
}

void Samples::sample(Scene &scene, const ProxyStore &proxies, Tick now)
{
    for (std::size_t i = sampled_.size(); i-- > 0;)
    {
        Sampled &sampled = sampled_[i];
        const bool moved = renew(scene, proxies, sampled, now);
        if (moved)
            sampled.unmoved.reset();
        else if (sampled.track.rests())
            leave(sampled.id, resting);
    }
}

Samples::Sampled *Samples::follow(const ProxyStore &proxies, ProxyId id)
{
    if (id >= states_.size())
        resize_array(states_, proxies.size());
    State &state = states_[id];
    const UpdateNumber moved = proxies.places[id].moved();
    if (state.index == resting && state.moved == moved)
        return nullptr;
    if (state.index >= resting)
    {
        if (sampled_.size() == sampled_.capacity())
            sampled_.reserve(sampled_.size() + sampled_.size() / 4 + 1);
        sampled_.push_back({id, moved, std::nullopt, {}});
        state.index = static_cast<std::uint32_t>(sampled_.size() - 1);
    }
    return &sampled_[state.index];
}

// @return whether the object has moved since its last pose, or this is the first pose.
bool Samples::renew(Scene &scene, const ProxyStore &proxies, Sampled &sampled, Tick tick)
{
    const UpdateNumber moved = proxies.places[sampled.id].moved();
    if (sampled.moved == moved && sampled.track.has_begun())
    {
        sampled.track.repeat(tick);
        return false;
    }
    sampled.track.add(tick, scene.pose(sampled.id));
    sampled.moved = moved;
    return true;
}

void Samples::leave(ProxyId id, std::uint32_t as)
{
    State &state = states_[id];
    Sampled &sampled = sampled_[state.index], &last = sampled_.back();
    states_[last.id].index = state.index;
    state = {as, sampled.moved};
    if (&sampled != &last)
        sampled = last;
    sampled_.pop_back();
    give_back_spare(sampled_);
}

void Samples::forget(ProxyId id)
{
    if (id >= states_.size())
        return;
    if (states_[id].index < resting)
        leave(id, unasked);
    states_[id] = {};
}
} // namespace ode_predictive_space
