#include "ode_predictive_space/broadphase/objects/measured_shapes.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "ode_predictive_space/broadphase/base/memory.h"

namespace ode_predictive_space
{
constexpr double rounds_up = 1 + 32 * std::numeric_limits<double>::epsilon();

void MeasuredShapes::start(std::size_t count)
{
    MeasuredShapes started;
    started.in_use_ = true;
    started.resize(count);
    *this = std::move(started);
}

void MeasuredShapes::resize(std::size_t count)
{
    if (!in_use_)
        return;
    resize_array(shapes_, count);
    resize_array(travels_, count);
    resize_array(seen_, count);
    for (IdSet *set : {&renewed_, &awaited_})
        set->resize(count);
    free_memory(followed_);
    free_memory(moves_);
}

void MeasuredShapes::forget(ProxyId id)
{
    if (id >= shapes_.size())
        return;
    shapes_[id].reset();
    awaited_.erase(id);
}

void MeasuredShapes::keep_only(const IdSet &wanted)
{
    for (std::size_t id = 0; id < shapes_.size(); ++id)
        if (shapes_[id] && !wanted.contains(static_cast<ProxyId>(id)))
            forget(static_cast<ProxyId>(id));
}

void MeasuredShapes::update(Scene &scene, const IdSet &wanted, const ProxyStore &proxies)
{
    clear_scratch(stale_);
    for (std::size_t i = 0; i < wanted.words(); ++i)
        IdSet::visit_word(i, (wanted.word(i) | awaited_.word(i)) & proxies.members().word(i), [&](ProxyId id) {
            const UpdateNumber moved = proxies.places[id].moved();
            if (is_current(scene, id, moved))
                return;
            seen_[id] = moved;
            stale_.push_back(id);
        });
    follow_stale(scene);
}

bool MeasuredShapes::is_current(Scene &scene, ProxyId id, UpdateNumber moved) const
{
    if (!has_shape(id) || seen_[id] != moved)
        return false;
    const ConvexShape &shape = (*this)[id];
    return !(shape.hull || shape.awaits_hull) || !scene.hull_is_outdated(id, shape);
}

void MeasuredShapes::follow_stale(Scene &scene)
{
    if (stale_.empty())
        return;
    followed_.clear();
    for (ProxyId id : stale_)
    {
        if (!has_shape(id))
            shapes_[id] = std::make_unique<ConvexShape>();
        followed_.push_back(shapes_[id].get());
    }
    if (moves_.size() < stale_.size())
        moves_.resize(stale_.size());
    scene.follow(stale_.data(), stale_.size(), followed_.data(), moves_.data());
    for (std::size_t i = 0; i < stale_.size(); ++i)
        note(stale_.data()[i], moves_[i]);
}

void MeasuredShapes::note(ProxyId id, double move)
{
    if ((*this)[id].awaits_hull)
        awaited_.insert(id);
    else
        awaited_.erase(id);
    if (move < std::numeric_limits<double>::infinity())
        travels_[id] = rounds_up * (travels_[id] + move);
    else
        renewed_.insert(id);
}

std::size_t MeasuredShapes::bytes() const
{
    const auto measured =
        shapes_.size() - static_cast<std::size_t>(std::count(shapes_.begin(), shapes_.end(), nullptr));
    return bytes_of(shapes_) + measured * sizeof(ConvexShape) + bytes_of(travels_) + bytes_of(followed_) +
           bytes_of(moves_) + bytes_of(seen_) + renewed_.bytes() + awaited_.bytes() + bytes_of(stale_);
}
} // namespace ode_predictive_space
