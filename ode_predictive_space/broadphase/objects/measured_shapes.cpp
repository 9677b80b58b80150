#include "ode_predictive_space/broadphase/objects/measured_shapes.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "ode_predictive_space/broadphase/base/memory.h"

namespace ode_predictive_space
{
namespace
{
constexpr double rounds_up = 1 + 32 * std::numeric_limits<double>::epsilon();
} // namespace

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
    for (std::size_t id = count; id < places_.size(); ++id)
        forget(static_cast<ProxyId>(id));
    resize_array(places_, count);
    resize_array(travels_, count);
    resize_array(seen_, count);
    for (IdSet *set : {&renewed_, &awaited_})
        set->resize(count);
    free_memory(followed_);
    free_memory(moves_);
}

void MeasuredShapes::forget(ProxyId id)
{
    if (!in_use_ || id >= places_.size() || !has_shape(id))
        return;
    const std::size_t last = owners_.size() - 1;
    shapes_[place_of(id)] = std::move(shapes_[last]);
    owners_[place_of(id)] = owners_[last];
    places_[owners_[last]] = places_[id];
    shapes_.resize(last);
    owners_.resize(last);
    places_[id] = 0;
    awaited_.erase(id);
}

void MeasuredShapes::keep_only(const IdSet &wanted)
{
    for (std::size_t place = owners_.size(); place-- > 0;)
        if (!wanted.contains(owners_[place]))
            forget(owners_[place]);
    give_back_spare(shapes_);
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

// Collects pointers only after all places exist, because adding one may move the shapes.
void MeasuredShapes::make_places()
{
    for (ProxyId id : stale_)
        if (!has_shape(id))
        {
            shapes_.resize(owners_.size() + 1);
            owners_.push_back(id);
            places_[id] = static_cast<std::uint32_t>(owners_.size());
        }
    followed_.clear();
    for (ProxyId id : stale_)
        followed_.push_back(&shapes_[place_of(id)]);
}

void MeasuredShapes::follow_stale(Scene &scene)
{
    if (stale_.empty())
        return;
    make_places();
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
    {
        renewed_.insert(id);
        any_renewed_ = true;
    }
}

void MeasuredShapes::clear_renewed()
{
    if (!any_renewed_)
        return;
    renewed_.clear();
    any_renewed_ = false;
}

std::size_t MeasuredShapes::bytes() const
{
    return bytes_of(shapes_) + bytes_of(owners_) + bytes_of(places_) + bytes_of(travels_) + bytes_of(followed_) +
           bytes_of(moves_) + bytes_of(seen_) + renewed_.bytes() + awaited_.bytes() + bytes_of(stale_);
}
} // namespace ode_predictive_space
