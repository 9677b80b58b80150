// The convex hulls of convexes and meshes, and the ground of heightfields: one for all geoms that are made of the same data.

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
/// A hull lives as long as it is kept for a geom, or a shape has it.
class HullStore
{
public:
    /// None of other classes, and of data that cannot be read; nor while it is being made.
    struct Found
    {
        std::shared_ptr<const DataHull> hull;
        bool is_being_made = false;
    };

    /// The hull of a convex or mesh. Of a heightfield the rectangle around its grid, with that as the surface. It is kept for the geom,
    /// so that it is there when the geom is near others again. Where it is not known it is made, as far as the steps go.
    ///
    /// @param steps see HullMaker::go_on(). Those that are left are given back.
    Found hull_of(ProxyId id, dxGeom *geom, std::size_t &steps);

    /// Is the geom made of other data than its hull, which hull_of() gave?
    static bool is_outdated(dxGeom *geom, const VertexHull &hull);

    /// The data of a geom may have been changed in place: hulls of these are made anew.
    void outdate(dxGeom *geom);

    /// The geom is gone, or its data may be others now: changes of the old ones are not reported for it.
    void release(ProxyId id) { geoms_.erase(id); }
    void release_all() { geoms_.clear(); }

    std::size_t bytes() const;

private:
    struct OfGeom
    {
        std::shared_ptr<const DataHull> hull;
        std::unique_ptr<HullMaker> maker; // also of data that cannot be read, so that they are not read again
    };

    std::shared_ptr<const DataHull> known(const DataKey &key) const;
    void add(const std::shared_ptr<DataHull> &hull);

    std::map<DataKey, std::weak_ptr<DataHull>> hulls_;
    std::map<ProxyId, OfGeom> geoms_;
    std::size_t used_ =
        0; // hulls that were in use when expired ones were last removed, and the one that was added then
    std::uint32_t made_ = 0; // so many hulls
};
} // namespace ode_predictive_space

#endif
