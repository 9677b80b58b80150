// Spaces in the space: one for each robot, or many without geoms.

#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/makers.h"
#include "tests/scenes/worlds/vehicle.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double nested_step = 0.005;
constexpr int balls = 10; // beside the empty spaces

double half_side_of_nested(int robots)
{
    return std::sqrt(robots) + 2;
}

SceneBounds bounds_of_nested(int robots)
{
    return {Vector3::Zero(), {half_side_of_nested(robots), half_side_of_nested(robots), 2}};
}

class SpacesWorld : public WorldScene
{
public:
    void collide(dSpaceID space, PairList &list) override { dSpaceCollide(space, &list, &PairList::collect_in_spaces); }

protected:
    SpacesWorld(const SceneSpec &spec, dSpaceID space) : WorldScene(spec, space, nested_step)
    {
        objects_.add_geom(dCreatePlane(space, 0, 0, 1, 0));
    }
};

/// The geoms of a robot are not tested against one another.
class RobotSpacesWorld : public SpacesWorld
{
public:
    RobotSpacesWorld(const SceneSpec &spec, dSpaceID space) : SpacesWorld(spec, space)
    {
        const double half = half_side_of_nested(spec.objects) - 1;
        const int side = static_cast<int>(std::ceil(std::sqrt(spec.objects)));
        for (int i = 0; i < spec.objects; ++i)
        {
            const Vector3 place(2 * half * (i % side + 0.5) / side - half, 2 * half * (i / side + 0.5) / side - half,
                                0);
            add_vehicle(objects_, add_space(bounds_of_nested(spec.objects)), {}, place, random_.uniform(-pi, pi),
                        random_);
        }
    }
};

class EmptySpacesWorld : public SpacesWorld
{
public:
    EmptySpacesWorld(const SceneSpec &spec, dSpaceID space) : SpacesWorld(spec, space)
    {
        for (int i = 0; i < spec.objects; ++i)
            add_space(bounds_of_nested(spec.objects));
        for (int i = 0; i < balls; ++i)
        {
            BodyState state;
            state.position = random_.in_box({2, 2, 0}) + Vector3(0, 0, 0.2);
            state.velocity = random_.in_box({1, 1, 0});
            add_body(objects_, dCreateSphere(space, 0.15), 1, state);
        }
    }
};
} // namespace

SceneRecipe nested_world(const SceneSpec &spec)
{
    return {[](const SceneSpec &made, dSpaceID space) { return std::make_unique<RobotSpacesWorld>(made, space); },
            bounds_of_nested(spec.objects), nested_step};
}

SceneRecipe empty_spaces_world(const SceneSpec &spec)
{
    return {[](const SceneSpec &made, dSpaceID space) { return std::make_unique<EmptySpacesWorld>(made, space); },
            bounds_of_nested(spec.objects), nested_step};
}
} // namespace ode_predictive_space::scenes
