// Robots of seventeen bodies in a row, with a motor in each joint, on a plane.

#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/makers.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double chain_step = 0.004;
constexpr int links = 17;
constexpr double length = 0.2;         // of a link, metres
constexpr double radius = 0.06;        // metres
constexpr double torque = 8;           // N m
constexpr double fastest_in_chain = 2; // rad/s
constexpr double space_for_one = 2;    // metres

class ChainWorld : public WorldScene
{
public:
    ChainWorld(const SceneSpec &spec, dSpaceID space) : WorldScene(spec, space, chain_step)
    {
        objects_.add_geom(dCreatePlane(space, 0, 0, 1, 0));
        for (int i = 0; i < spec.objects; ++i)
            add_chain(space_for_one * i);
    }

private:
    void add_chain(double y)
    {
        dBodyID last = nullptr;
        for (int i = 0; i < links; ++i)
        {
            BodyState state;
            state.position = {length * i, y, radius + 0.02};
            const dGeomID geom = i % 2 == 0 ? dCreateBox(objects_.space(), length, 2 * radius, 2 * radius)
                                            : dCreateSphere(objects_.space(), radius);
            const dBodyID body = add_body(objects_, geom, 0.5, state);
            if (last != nullptr)
                join(last, body, i);
            last = body;
        }
    }

    void join(dBodyID last, dBodyID body, int number)
    {
        const dReal *place = dBodyGetPosition(body);
        const dJointID hinge = dJointCreateHinge(objects_.world(), nullptr);
        dJointAttach(hinge, last, body);
        dJointSetHingeAnchor(hinge, place[0] - length / 2, place[1], place[2]);
        dJointSetHingeAxis(hinge, 0, number % 2, 1 - number % 2);
        hinges_.push_back(hinge);
    }

    void before_step() override
    {
        time_ += step();
        for (std::size_t i = 0; i < hinges_.size(); ++i)
            drive(hinges_[i], fastest_in_chain * std::sin(2 * time_ + 0.8 * static_cast<double>(i)), torque);
    }

    std::vector<dJointID> hinges_;
    double time_ = 0;
};
} // namespace

SceneRecipe chain_world(const SceneSpec &spec)
{
    return {[](const SceneSpec &made, dSpaceID space) { return std::make_unique<ChainWorld>(made, space); },
            {{length * links / 2, space_for_one * spec.objects / 2, 0}, {5, space_for_one * spec.objects + 2, 2}},
            chain_step};
}
} // namespace ode_predictive_space::scenes
