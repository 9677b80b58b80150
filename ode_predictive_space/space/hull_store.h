// The convex hulls of convexes and meshes, and the ground of heightfields: one for all geoms that are made of the same data.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_HULL_STORE_H
#define ODE_PREDICTIVE_SPACE_SPACE_HULL_STORE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "ode_predictive_space/broadphase/shape/vertex_hull.h"
#include "ode_predictive_space/space/ode_internals.h"

namespace ode_predictive_space
{
/// Beyond this, squares of lengths may overflow.
constexpr double largest_length = 1e100;

/// Divides two lengths. The result is infinite when the second is 0; the division is then left out, as programs may trap it.
inline double quotient(double one, double other)
{
    return other > 0 ? one / other : std::numeric_limits<double>::infinity();
}

/// Where a geom's data are and how many: pointers, counts and scales.
using DataKey = std::array<std::uint64_t, 9>;

/// The hull of a geom's data.
struct DataHull : VertexHull
{
    DataHull(VertexHull &&points, const DataKey &data) : VertexHull(std::move(points)), key(data) {}

    DataKey key;
    /// Twice the area of the smallest triangle of a mesh; infinite for a convex.
    double least_normal = std::numeric_limits<double>::infinity();
    /// The largest aspect ratio of a triangle of a mesh: its longest side by the height on it. Of a convex, 1.
    double aspect = 1;
    bool outdated = false; ///< the data have been changed in place
    bool has_old_box =
        false; ///< ODE's box of a mesh's data does not fit: they were changed in place, and not built again
};

/// A hull lives as long as a shape of a geom has it.
class HullStore
{
public:
    /// The hull of a convex or mesh. Of a heightfield the rectangle around its grid, with that as the surface.
    ///
    /// @param before the geom's last hull, or null; found again without a search when the geom is made of the same data.
    /// @return null for other classes, for data that cannot be read and for points that are not finite or too far away for
    ///         squares of lengths. Of very many points only the box.
    std::shared_ptr<const DataHull> hull_of(dxGeom *geom, const std::shared_ptr<const VertexHull> &before);

    /// Is the geom made of other data than its hull, which hull_of() gave?
    static bool is_outdated(dxGeom *geom, const VertexHull &hull);

    /// The data of a geom may have been changed in place: hulls of these are made anew.
    void outdate(dxGeom *geom);

    std::size_t bytes() const;

private:
    std::shared_ptr<const DataHull> make_hull(dxGeom *geom, const DataKey &key);
    void forget_unused();

    std::map<DataKey, std::weak_ptr<DataHull>> hulls_;
};
} // namespace ode_predictive_space

#endif
