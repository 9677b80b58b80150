// How the geoms of a scene move.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SCENES_MOTION_H
#define ODE_PREDICTIVE_SPACE_TESTS_SCENES_MOTION_H

#include "demos/runs/world_run.h"
#include "demos/worlds/world.h"

#include <algorithm>
#include <map>

namespace ode_predictive_space::worlds
{
/// Whether a geom is somewhere: a plane is not.
inline bool has_place(dGeomID geom)
{
    return dGeomGetClass(geom) != dPlaneClass;
}

/// A scene and the places of its geoms, by their numbers.
class Motion
{
public:
    explicit Motion(const WorldSpec &spec) : scene_(WorldFactory(spec).make(space_.get())) {}

    void advance()
    {
        before_ = places();
        scene_->advance();
        after_ = places();
    }

    std::map<std::uint32_t, Vector3> places() const
    {
        std::map<std::uint32_t, Vector3> result;
        for (int i = 0; i < dSpaceGetNumGeoms(space_.get()); ++i)
        {
            const dGeomID geom = dSpaceGetGeom(space_.get(), i);
            if (has_place(geom))
                result[geom_index(geom)] = from_ode(dGeomGetPosition(geom));
        }
        return result;
    }

    /// Geoms that are elsewhere since the last advance().
    int moved() const
    {
        int count = 0;
        for (const auto &[index, place] : after_)
        {
            const auto old = before_.find(index);
            count += old != before_.end() && old->second != place ? 1 : 0;
        }
        return count;
    }

    /// The farthest way of a geom in the last advance().
    double longest_way() const
    {
        double longest = 0;
        for (const auto &[index, place] : after_)
        {
            const auto old = before_.find(index);
            longest = old == before_.end() ? longest : std::max(longest, (place - old->second).norm());
        }
        return longest;
    }

    /// Geoms that are there after the last advance(), but were not before.
    int made() const
    {
        int count = 0;
        for (const auto &[index, place] : after_)
            count += before_.count(index) == 0 ? 1 : 0;
        return count;
    }

    const std::map<std::uint32_t, Vector3> &before() const { return before_; }
    const std::map<std::uint32_t, Vector3> &after() const { return after_; }
    dSpaceID space() const { return space_.get(); }
    const World &scene() const { return *scene_; }

private:
    OdeSession ode_;
    OwnedSpace space_{dSimpleSpaceCreate(nullptr)};
    std::unique_ptr<World> scene_;
    std::map<std::uint32_t, Vector3> before_;
    std::map<std::uint32_t, Vector3> after_;
};
} // namespace ode_predictive_space::worlds

#endif
