// The shapes of objects as last measured, and the travel of each object.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_MEASURED_SHAPES_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_OBJECTS_MEASURED_SHAPES_H

#include <memory>
#include <vector>

#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/objects/proxy_store.h"
#include "ode_predictive_space/broadphase/objects/scene.h"
#include "ode_predictive_space/broadphase/shape/convex_shape.h"

namespace ode_predictive_space
{
/// Holds shapes only of wanted objects, because most objects of a large scene are near no other. At each update of a shape, the
/// travel of its object grows by at least the displacement of its surface. So two shapes with a gap cannot touch before the sum
/// of their travels has grown by that gap.
class MeasuredShapes
{
public:
    /// On an exception nothing has changed.
    void start(std::size_t count);
    void stop() { *this = {}; }
    bool in_use() const { return in_use_; }

    void resize(std::size_t count);

    /// Drops the shape of an object that was removed or is made of other data.
    void forget(ProxyId id);

    /// Measures the wanted objects that have moved or have other data, adds to their travels, and continues awaited hulls.
    void update(Scene &scene, const IdSet &wanted, const ProxyStore &proxies);

    /// Whether shapes were measured for the first time, or replaced, since clear_renewed(). Travels do not cover such changes.
    const IdSet &renewed() const { return renewed_; }
    bool renewed(const CandidatePair &pair) const
    {
        return !renewed_.empty() && (renewed_.contains(pair.first) || renewed_.contains(pair.second));
    }
    void clear_renewed() { renewed_.clear(); }

    bool has_shape(ProxyId id) const { return shapes_[id] != nullptr; }

    /// @pre has_shape(id).
    const ConvexShape &operator[](ProxyId id) const { return *shapes_[id]; }

    /// Drops the shapes of all other objects. Their next measure counts as the first.
    void keep_only(const IdSet &wanted);

    void add_owners_to(IdSet &ids) const
    {
        for (std::size_t id = 0; id < shapes_.size(); ++id)
            if (shapes_[id])
                ids.insert(static_cast<ProxyId>(id));
    }

    double travel(const CandidatePair &pair) const { return travels_[pair.first] + travels_[pair.second]; }

    std::size_t bytes() const;

private:
    bool is_current(Scene &scene, ProxyId id, UpdateNumber moved) const;
    void follow_stale(Scene &scene);
    void note(ProxyId id, double move);

    bool in_use_ = false;
    std::vector<std::unique_ptr<ConvexShape>> shapes_; // by object; null for most
    std::vector<double> travels_;                      // by object
    std::vector<UpdateNumber> seen_;                   // by object: Place::moved() when its shape was measured
    IdSet renewed_;
    IdSet awaited_;                       // objects whose hulls are being made
    std::vector<ProxyId> stale_;          // scratch
    std::vector<ConvexShape *> followed_; // scratch: the shapes of stale_
    std::vector<double> moves_;           // scratch
};
} // namespace ode_predictive_space

#endif
