// The hulls of convexes, meshes and heightfields: one for all geoms with the same data.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_HULL_STORE_H
#define ODE_PREDICTIVE_SPACE_SPACE_HULL_STORE_H

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>

#include "ode_predictive_space/broadphase/base/ids.h"
#include "ode_predictive_space/space/hull_maker.h"

namespace ode_predictive_space
{
/// A hull lives while it is kept for a geom or used by a shape.
class HullStore
{
public:
    struct Found
    {
        std::shared_ptr<const DataHull> hull; // null for other classes, for unreadable data, and while it is being made
        bool is_being_made = false;
    };

    /// The hull of a convex, mesh or heightfield (the rectangle of its grid), kept for the geom until release(). An unknown
    /// hull is made, as far as the steps suffice. @param steps see HullMaker::go_on(); replaced by the unused ones.
    Found hull_of(ProxyId id, dxGeom *geom, std::size_t &steps);

    /// Has the geom other data now than `hull`, which hull_of() returned?
    static bool is_outdated(dxGeom *geom, const VertexHull &hull);

    /// Discards the hulls of the geom's data, which may have been changed in place.
    void outdate(dxGeom *geom);

    /// Forgets the hull of a geom that is removed, or may have other data.
    void release(ProxyId id) { geoms_.erase(id); }
    void release_all() { geoms_.clear(); }

    std::size_t bytes() const;

private:
    struct OfGeom
    {
        std::shared_ptr<const DataHull> hull;
        std::unique_ptr<HullMaker> maker; // kept for unreadable data, so that they are not read again
    };

    std::shared_ptr<const DataHull> known(const DataKey &key) const;
    void add(const std::shared_ptr<DataHull> &hull);

    std::map<DataKey, std::weak_ptr<DataHull>> hulls_;
    std::map<ProxyId, OfGeom> geoms_;
    std::size_t used_ = 0;   // hulls in use when expired ones were last removed, plus the one added then
    std::uint32_t made_ = 0; // number of the last hull
};
} // namespace ode_predictive_space

#endif
