#include "ode_predictive_space/broadphase/objects/measured_shapes.h"

#include <limits>
#include <utility>

#include "ode_predictive_space/broadphase/base/memory.h"

namespace ode_predictive_space
{
namespace
{
constexpr double rounds_up = 1 + 32 * std::numeric_limits<double>::epsilon();
}

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
    for (IdSet *set : {&valid_, &renewed_, &hulls_})
        set->resize(count);
    stale_.resize(count);
    free_memory(moves_);
}

void MeasuredShapes::forget(ProxyId id)
{
    if (!in_use_ || id >= shapes_.size())
        return;
    shapes_[id] = {};
    valid_.erase(id);
    hulls_.erase(id);
}

void MeasuredShapes::update(Scene &scene, const IdSet &wanted, const IdSet &members)
{
    stale_.clear();
    for (std::size_t i = 0; i < wanted.words(); ++i)
        IdSet::visit_word(i, wanted.word(i) & members.word(i) & ~valid_.word(i),
                          [this](ProxyId id) { stale_.add(id); });
    follow_stale(scene);
}

void MeasuredShapes::renew_outdated(Scene &scene, const IdSet &wanted, const IdSet &members)
{
    stale_.clear();
    for (std::size_t i = 0; i < hulls_.words(); ++i)
        IdSet::visit_word(i, hulls_.word(i) & wanted.word(i) & members.word(i), [&](ProxyId id) {
            if (scene.hull_is_outdated(id, shapes_[id]))
                stale_.add(id);
        });
    follow_stale(scene);
}

void MeasuredShapes::follow_stale(Scene &scene)
{
    if (stale_.empty())
        return;
    if (moves_.size() < stale_.size())
        moves_.resize(stale_.size());
    scene.follow(stale_.data(), stale_.size(), shapes_.data(), moves_.data());
    for (std::size_t i = 0; i < stale_.size(); ++i)
        note(stale_.data()[i], moves_[i]);
}

void MeasuredShapes::note(ProxyId id, double move)
{
    valid_.insert(id);
    if (shapes_[id].hull)
        hulls_.insert(id);
    else
        hulls_.erase(id);
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
    return bytes_of(shapes_) + bytes_of(travels_) + bytes_of(moves_) + valid_.bytes() + renewed_.bytes() +
           hulls_.bytes() + stale_.bytes();
}
} // namespace ode_predictive_space
