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
    free_memory(found_);
}

void MeasuredShapes::update(Scene &scene, const IdSet &wanted, const IdSet &members)
{
    stale_.clear();
    drop_outdated(scene, wanted, members);
    for (std::size_t i = 0; i < wanted.words(); ++i)
        IdSet::visit_word(i, wanted.word(i) & members.word(i) & ~valid_.word(i),
                          [this](ProxyId id) { stale_.add(id); });
    if (stale_.empty())
        return;
    if (found_.size() < stale_.size())
        found_.resize(stale_.size());
    for (std::size_t i = 0; i < stale_.size(); ++i)
        found_[i] = shapes_[stale_.data()[i]];
    scene.update_shapes(stale_.data(), stale_.size(), found_.data());
    for (std::size_t i = 0; i < stale_.size(); ++i)
        note(stale_.data()[i], found_[i]);
}

void MeasuredShapes::drop_outdated(Scene &scene, const IdSet &wanted, const IdSet &members)
{
    for (std::size_t i = 0; i < hulls_.words(); ++i)
        IdSet::visit_word(i, hulls_.word(i) & wanted.word(i) & members.word(i), [&](ProxyId id) {
            if (scene.hull_is_outdated(id, shapes_[id]))
                valid_.erase(id);
        });
}

void MeasuredShapes::note(ProxyId id, const ConvexShape &shape)
{
    ConvexShape &before = shapes_[id];
    valid_.insert(id);
    if (shape.hull)
        hulls_.insert(id);
    else
        hulls_.erase(id);
    // A half space that turns moves without bounds far away.
    if (!shape.same_size(before) || shape.kind == ShapeKind::half_space)
    {
        renewed_.insert(id);
        any_renewed_ = true;
    }
    else if (shape.known())
        travels_[id] = rounds_up * (travels_[id] + shape.moved_from(before));
    before = shape;
}

void MeasuredShapes::clear_renewed()
{
    renewed_.clear();
    any_renewed_ = false;
}

std::size_t MeasuredShapes::bytes() const
{
    return bytes_of(shapes_) + bytes_of(travels_) + bytes_of(found_) + valid_.bytes() + renewed_.bytes() +
           hulls_.bytes() + stale_.bytes();
}
} // namespace ode_predictive_space
