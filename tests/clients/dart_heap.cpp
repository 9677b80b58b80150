// A heap of boxes, spheres and cylinders in DART's world, with ODE as its collision detector.
// Usage: dart_heap [bodies] [steps] [near|far]. With "far", the last body is 1e10 m away. Prints the others' final positions.

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/dart.hpp>

namespace
{
namespace dyn = dart::dynamics;

dyn::ShapePtr shape_of(int number)
{
    if (number % 3 == 0)
        return std::make_shared<dyn::BoxShape>(Eigen::Vector3d(0.3, 0.2, 0.25));
    if (number % 3 == 1)
        return std::make_shared<dyn::SphereShape>(0.12);
    return std::make_shared<dyn::CylinderShape>(0.1, 0.3);
}

void give_shape(dyn::BodyNode *body, const dyn::ShapePtr &shape)
{
    body->createShapeNodeWith<dyn::VisualAspect, dyn::CollisionAspect, dyn::DynamicsAspect>(shape);
}

dyn::SkeletonPtr thing(int number, double away)
{
    auto skeleton = dyn::Skeleton::create("thing " + std::to_string(number));
    auto [joint, body] = skeleton->createJointAndBodyNodePair<dyn::FreeJoint>();
    const dyn::ShapePtr shape = shape_of(number);
    give_shape(body, shape);
    body->setInertia(dyn::Inertia(1.0, Eigen::Vector3d::Zero(), shape->computeInertia(1.0)));
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.translation() =
        Eigen::Vector3d(away + 0.45 * (number % 6), 0.45 * (number / 6 % 6), 0.3 + 0.4 * (number / 36));
    place.rotate(Eigen::AngleAxisd(0.3 * number, Eigen::Vector3d::UnitX()));
    joint->setTransform(place);
    return skeleton;
}

dyn::SkeletonPtr ground()
{
    auto skeleton = dyn::Skeleton::create("ground");
    auto *body = skeleton->createJointAndBodyNodePair<dyn::WeldJoint>().second;
    give_shape(body, std::make_shared<dyn::BoxShape>(Eigen::Vector3d(20, 20, 0.2)));
    return skeleton;
}
} // namespace

int main(int argc, char **argv)
{
    const int bodies = argc > 1 ? std::atoi(argv[1]) : 100;
    const int steps = argc > 2 ? std::atoi(argv[2]) : 300;
    const bool far = argc > 3 && std::strcmp(argv[3], "far") == 0;
    auto world = dart::simulation::World::create();
    world->getConstraintSolver()->setCollisionDetector(dart::collision::OdeCollisionDetector::create());
    world->setTimeStep(0.005);
    world->addSkeleton(ground());
    for (int number = 0; number < bodies; ++number)
        world->addSkeleton(thing(number, far && number == bodies - 1 ? 1e10 : 0));
    for (int step = 0; step < steps; ++step)
        world->step();
    const int counted = bodies - (far ? 1 : 0);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i <= static_cast<std::size_t>(counted); ++i)
        sum += world->getSkeleton(i)->getBodyNode(0)->getTransform().translation();
    std::printf("%d bodies, mean position %.17g %.17g %.17g\n", counted, sum.x() / counted, sum.y() / counted,
                sum.z() / counted);
    return sum.allFinite() && sum.z() > 0 ? 0 : 1;
}
