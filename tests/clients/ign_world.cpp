// Gazebo's physics: a world in SDF, read by ign-physics and moved by its engine "dartsim", which is DART with ODE as its
// collision detector. Boxes, spheres and cylinders fall on a floor; every fifth model has a second link on a hinge.
// Usage: ign_world [models] [steps] [near|far|nan]. With "far", the last model is put 1e10 m away before the first step; with
// "nan", its height is not a number. Prints the final positions of the others.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>

#include <ignition/physics.hh>
#include <ignition/physics/FrameSemantics.hh>
#include <ignition/physics/FreeGroup.hh>
#include <ignition/physics/GetEntities.hh>
#include <ignition/physics/RequestEngine.hh>
#include <ignition/physics/sdf/ConstructModel.hh>
#include <ignition/physics/sdf/ConstructWorld.hh>
#include <ignition/plugin/Loader.hh>
#include <sdf/Root.hh>
#include <sdf/World.hh>

namespace
{
namespace physics = ignition::physics;

struct Features
    : physics::FeatureList<physics::sdf::ConstructSdfWorld, physics::GetModelFromWorld, physics::GetLinkFromModel,
                           physics::FindFreeGroupFeature, physics::SetFreeGroupWorldPose, physics::LinkFrameSemantics,
                           physics::ForwardStep>
{};

using Engine = physics::Engine3dPtr<Features>;
using World = physics::World3dPtr<Features>;

std::string geometry(int number)
{
    if (number % 3 == 0)
        return "<box><size>0.3 0.2 0.25</size></box>";
    if (number % 3 == 1)
        return "<sphere><radius>0.12</radius></sphere>";
    return "<cylinder><radius>0.1</radius><length>0.3</length></cylinder>";
}

std::string link(const std::string &name, const std::string &pose, const std::string &shape)
{
    return "<link name='" + name + "'><pose>" + pose + "</pose><collision name='shape'><geometry>" + shape +
           "</geometry></collision></link>";
}

std::string second_link()
{
    return link("second", "0.35 0 0 0 0 0", "<sphere><radius>0.08</radius></sphere>") +
           "<joint name='hinge' type='revolute'><parent>first</parent><child>second</child>"
           "<axis><xyz>0 1 0</xyz></axis></joint>";
}

std::string model(int number)
{
    std::ostringstream text;
    text << "<model name='model " << number << "'><pose>" << 0.5 * (number % 10) << ' ' << 0.45 * (number / 10 % 10)
         << ' ' << 0.3 + 0.4 * (number / 100) << ' ' << 0.3 * (number % 20) << " 0 0</pose>"
         << link("first", "0 0 0 0 0 0", geometry(number)) << (number % 5 == 0 ? second_link() : "") << "</model>";
    return text.str();
}

std::string world_of(int models)
{
    std::string text = "<sdf version='1.9'><world name='heap'><physics name='five' type='dart'>"
                       "<max_step_size>0.005</max_step_size></physics><model name='floor'><static>true</static>" +
                       link("floor", "0 0 -0.1 0 0 0", "<box><size>20 20 0.2</size></box>") + "</model>";
    for (int number = 0; number < models; ++number)
        text += model(number);
    return text + "</world></sdf>";
}

Engine engine()
{
    ignition::plugin::Loader loader;
    loader.LoadLib(DARTSIM_PLUGIN);
    return physics::RequestEngine3d<Features>::From(loader.Instantiate("ignition::physics::dartsim::Plugin"));
}

World read(const Engine &engine, int models)
{
    sdf::Root root;
    const sdf::Errors errors = root.LoadSdfString(world_of(models));
    for (const sdf::Error &error : errors)
        std::fprintf(stderr, "%s\n", error.Message().c_str());
    return errors.empty() ? engine->ConstructWorld(*root.WorldByIndex(0)) : nullptr;
}

void put(const World &world, int number, double x, double z)
{
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.translation() = Eigen::Vector3d(x, 0, z);
    world->GetModel("model " + std::to_string(number))->FindFreeGroup()->SetWorldPose(place);
}

Eigen::Vector3d sum_of_positions(const World &world, int models)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int number = 0; number < models; ++number)
        sum += world->GetModel("model " + std::to_string(number))
                   ->GetLink(0)
                   ->FrameDataRelativeToWorld()
                   .pose.translation();
    return sum;
}
} // namespace

int main(int argc, char **argv)
{
    const int models = argc > 1 ? std::atoi(argv[1]) : 300;
    const int steps = argc > 2 ? std::atoi(argv[2]) : 200;
    const std::string last = argc > 3 ? argv[3] : "near";
    const World world = read(engine(), models);
    if (!world)
        return 1;
    if (last == "far")
        put(world, models - 1, 1e10, 1);
    else if (last == "nan")
        put(world, models - 1, 0, std::numeric_limits<double>::quiet_NaN());
    physics::ForwardStep::Input input;
    physics::ForwardStep::Output output;
    physics::ForwardStep::State state;
    for (int step = 0; step < steps; ++step)
        world->Step(output, state, input);
    const int counted = models - (last == "near" ? 0 : 1);
    const Eigen::Vector3d mean = sum_of_positions(world, counted) / counted;
    std::printf("%d models, mean position %.17g %.17g %.17g\n", counted, mean.x(), mean.y(), mean.z());
    return mean.allFinite() ? 0 : 1;
}
