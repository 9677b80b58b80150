// OMPL, a library for motion planning, with its propagation of states by ODE: a planner pushes a box among loose boxes. Each
// step of the planner sets all boxes back to a state that it reached before.
// Usage: ompl_push BOXES ITERATIONS

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include <ompl/base/goals/GoalRegion.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/extensions/ode/OpenDESimpleSetup.h>
#include <ompl/util/RandomNumbers.h>

namespace base = ompl::base;
namespace control = ompl::control;

namespace
{
constexpr double edge = 0.4, apart = 0.7; // metres

class Boxes : public control::OpenDEEnvironment
{
public:
    explicit Boxes(int count) : space_(dHashSpaceCreate(nullptr))
    {
        world_ = dWorldCreate();
        dWorldSetGravity(world_, 0, 0, -9.81);
        collisionSpaces_.push_back(space_);
        dCreatePlane(space_, 0, 0, 1, -0.01);
        const int row = static_cast<int>(std::ceil(std::sqrt(count)));
        for (int i = 0; i < count; ++i)
            add_box(apart * (i % row), apart * (i / row));
        stepSize_ = 0.02;
        minControlSteps_ = 2;
        maxControlSteps_ = 10;
    }

    ~Boxes() override
    {
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }

    unsigned int getControlDimension() const override { return 2; }

    void getControlBounds(std::vector<double> &lower, std::vector<double> &upper) const override
    {
        lower = {-20, -20};
        upper = {20, 20};
    }

    void applyControl(const double *force) const override { dBodyAddForce(stateBodies_[0], force[0], force[1], 0); }

    bool isValidCollision(dGeomID, dGeomID, const dContact &) const override { return true; }

private:
    void add_box(double x, double y)
    {
        dBodyID body = dBodyCreate(world_);
        dMass mass;
        dMassSetBoxTotal(&mass, 1, edge, edge, edge);
        dBodySetMass(body, &mass);
        dGeomSetBody(dCreateBox(space_, edge, edge, edge), body);
        dBodySetPosition(body, x, y, edge / 2);
        stateBodies_.push_back(body);
    }

    dSpaceID space_;
};

/// A goal for the first box that is out of reach in a few iterations, so that all of them are done.
class FarAway : public base::GoalRegion
{
public:
    explicit FarAway(const base::SpaceInformationPtr &information) : base::GoalRegion(information) { threshold_ = 0.1; }

    double distanceGoal(const base::State *state) const override
    {
        return std::abs(100 - state->as<control::OpenDEStateSpace::StateType>()->getBodyPosition(0)[0]);
    }
};
} // namespace

int main(int argc, char **argv)
{
    if (argc != 3)
        return 2;
    ompl::msg::noOutputHandler();
    ompl::RNG::setSeed(1);
    dInitODE2(0);
    {
        control::OpenDESimpleSetup setup(std::make_shared<Boxes>(std::atoi(argv[1])));
        base::RealVectorBounds everywhere(3);
        everywhere.setLow(-1000);
        everywhere.setHigh(1000);
        setup.getStateSpace()->as<control::OpenDEStateSpace>()->setVolumeBounds(everywhere);
        setup.setGoal(std::make_shared<FarAway>(setup.getSpaceInformation()));
        setup.setPlanner(std::make_shared<control::RRT>(setup.getSpaceInformation()));
        setup.setup();
        base::IterationTerminationCondition iterations(static_cast<unsigned>(std::atoi(argv[2])));
        setup.solve(iterations);
        base::PlannerData data(setup.getSpaceInformation());
        setup.getPlanner()->getPlannerData(data);
        double sum = 0;
        for (unsigned i = 0; i < data.numVertices(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                sum +=
                    data.getVertex(i).getState()->as<control::OpenDEStateSpace::StateType>()->getBodyPosition(0)[axis];
        std::printf("%u states, sum of positions %.17g\n", data.numVertices(), sum);
    }
    dCloseODE();
}
