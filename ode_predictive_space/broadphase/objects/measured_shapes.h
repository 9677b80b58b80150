// The shapes of objects as they were last looked at, and how far each object has travelled.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_MEASURED_SHAPES_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_MEASURED_SHAPES_H

#include <vector>

#include "ode_predictive_space/broadphase/base/id_list.h"
#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/objects/scene.h"
#include "ode_predictive_space/broadphase/shape/convex_shape.h"

namespace ode_predictive_space
{
/// Takes memory only while it is in use.
///
/// The travel of an object is a sum: it grows by at least as much as any point of the surface has moved, turning included.
/// Two objects that were a gap apart cannot touch before their travels have grown by that gap together. What happened between
/// two looks does not matter, because the sum of moves is never less than the move from the first to the last place.
class MeasuredShapes
{
public:
    /// Nothing is known of objects 0 to count - 1. On an exception nothing has changed.
    void start(std::size_t count);
    /// Gives all memory back.
    void stop() { *this = {}; }
    bool in_use() const { return in_use_; }

    /// Makes room for objects 0 to count - 1, when in use.
    void resize(std::size_t count);

    /// The objects have moved.
    void invalidate(const IdSet &moved)
    {
        if (in_use_)
            valid_ -= moved;
    }

    /// Gives the shape back: the object is gone, or is made of other data.
    void forget(ProxyId id);

    /// Looks at those wanted objects that are there and have moved, and adds to their travels.
    void update(Scene &scene, const IdSet &wanted, const IdSet &members);

    /// Looks at those wanted objects whose hulls no longer serve, although they may not have moved.
    void renew_outdated(Scene &scene, const IdSet &wanted, const IdSet &members);

    /// Objects were seen for the first time, or resized, since the last clear_renewed(): their travels say nothing about the time
    /// before.
    bool any_renewed() const { return any_renewed_; }
    const IdSet &renewed() const { return renewed_; }
    bool renewed(const CandidatePair &pair) const
    {
        return any_renewed_ && (renewed_.contains(pair.first) || renewed_.contains(pair.second));
    }
    void clear_renewed();

    const ConvexShape &operator[](ProxyId id) const { return shapes_[id]; }

    /// Of both objects together.
    double travel(const CandidatePair &pair) const { return travels_[pair.first] + travels_[pair.second]; }

    std::size_t bytes() const;

private:
    void follow_stale(Scene &scene);
    void note(ProxyId id, double move);

    bool in_use_ = false;
    std::vector<ConvexShape> shapes_;
    std::vector<double> travels_;
    IdSet valid_; // and some that are not there
    IdSet renewed_;
    IdSet hulls_; // objects whose shape is a hull
    bool any_renewed_ = false;
    IdList stale_;              // scratch
    std::vector<double> moves_; // scratch
};
} // namespace ode_predictive_space

#endif
