// The shapes of objects as they were last looked at, and how far each object has travelled.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_MEASURED_SHAPES_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_MEASURED_SHAPES_H

#include <cstdint>
#include <vector>

#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/objects/proxy_store.h"
#include "ode_predictive_space/broadphase/objects/scene.h"
#include "ode_predictive_space/broadphase/shape/convex_shape.h"

namespace ode_predictive_space
{
/// Takes memory only while it is in use, and holds the shapes of the objects that were last wanted alone: most objects of a large
/// scene are near no other.
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

    /// Gives the shape back: the object is gone, or is made of other data.
    void forget(ProxyId id);

    /// Looks at those wanted objects that are there and have moved or whose data are others, and adds to their travels. Goes on with
    /// the hulls that any object awaits.
    void update(Scene &scene, const IdSet &wanted, const ProxyStore &proxies);

    /// Objects were seen for the first time, or resized, since the last clear_renewed(): their travels say nothing about the time
    /// before.
    bool any_renewed() const { return any_renewed_; }
    const IdSet &renewed() const { return renewed_; }
    bool renewed(const CandidatePair &pair) const
    {
        return any_renewed_ && (renewed_.contains(pair.first) || renewed_.contains(pair.second));
    }
    void clear_renewed();

    /// Has the object been looked at, and not been forgotten since?
    bool has_shape(ProxyId id) const { return places_[id] > 0; }

    /// The shape of an object. @pre has_shape(id).
    const ConvexShape &operator[](ProxyId id) const { return shapes_[place_of(id)]; }

    /// Gives the shapes of all other objects back: when they are looked at again, it is as for the first time.
    void keep_only(const IdSet &wanted);

    void add_owners_to(IdSet &ids) const
    {
        for (ProxyId id : owners_)
            ids.insert(id);
    }

    /// Of both objects together.
    double travel(const CandidatePair &pair) const { return travels_[pair.first] + travels_[pair.second]; }

    std::size_t bytes() const;

private:
    std::size_t place_of(ProxyId id) const { return places_[id] - 1; }
    bool is_current(Scene &scene, ProxyId id, UpdateNumber moved) const;
    void make_places();
    void follow_stale(Scene &scene);
    void note(ProxyId id, double move);

    bool in_use_ = false;
    std::vector<ConvexShape> shapes_;
    std::vector<ProxyId> owners_;       // of these
    std::vector<std::uint32_t> places_; // of each object among these, counted from 1; 0: it has none
    std::vector<double> travels_;       // of the objects
    std::vector<UpdateNumber> seen_;    // of each object, the update that saw its last move before it was looked at
    IdSet renewed_;
    IdSet awaited_; // objects whose hulls are being made
    bool any_renewed_ = false;
    std::vector<ProxyId> stale_;          // scratch
    std::vector<ConvexShape *> followed_; // scratch: the shapes of these
    std::vector<double> moves_;           // scratch
};
} // namespace ode_predictive_space

#endif
