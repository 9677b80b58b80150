// Gas, with probes and rays that query the space.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_QUERY_SCENE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_QUERY_SCENE_H

#include "demos/scenes/scene.h"
#include "ode_predictive_space/haptics/hand_path.h"

#include <vector>

namespace ode_predictive_space::scenes
{
/// The objects of gas, in the space; beside them, in no space, 20 spheres that follow hand paths, and a ray from each of
/// them in a direction that turns slowly. The spheres have radii from 0.1 to 0.3 m, the rays are 4 m long.
class QueryScene : public Scene
{
public:
    static constexpr int probes = 20; ///< and as many rays

    QueryScene(const SceneSpec &spec, dSpaceID space);

    /// The same probes and rays in another scene of as many objects, in a room as large.
    QueryScene(const SceneSpec &spec, std::unique_ptr<Scene> objects);

    ~QueryScene() override;

    void advance() override;
    void respond(const std::vector<IndexPair> &) override {}
    std::size_t contacts() const override { return 0; }
    bool moves_by_itself() const override { return true; }
    const std::vector<dGeomID> &geoms() const override { return objects_->geoms(); }
    const ProbeReport *probe() const override { return nullptr; }

    /// The spheres, then the rays.
    const std::vector<dGeomID> &queries() const override { return queries_; }

private:
    struct Hand
    {
        haptics::HandPath path;
        Vector3 axis;      ///< about which the ray turns
        Vector3 direction; ///< of the ray at the start
    };

    void place(std::size_t number);

    std::unique_ptr<Scene> objects_;
    std::vector<Hand> hands_;
    std::vector<dGeomID> queries_;
    int tick_ = 0;
};
} // namespace ode_predictive_space::scenes

#endif
