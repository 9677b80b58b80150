#include "demos/worlds/stepped_world.h"

#include <algorithm>
#include <array>
#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr int nested_quadtree_depth = 3;
} // namespace

SteppedWorld::SteppedWorld(const WorldSpec &spec, dSpaceID space, double step_seconds)
    : World(spec, space), mean_step_(step_seconds), step_(step_seconds), step_random_(haptics::mix_bits(spec.seed)),
      quickstep_seed_(haptics::mix_bits(spec.seed) & 0xffffffffu), joints_(dJointGroupCreate(0))
{
    dWorldSetQuickStepNumIterations(objects_.world(), 20);
    dWorldSetAutoDisableFlag(objects_.world(), 0);
}

void SteppedWorld::advance()
{
    step_ = mean_step_ * step_random_.uniform(1 - variation_, 1 + variation_);
    before_step();
    // QuickStep draws from one stream for the whole process; other worlds must not disturb this one.
    dRandSetSeed(quickstep_seed_);
    dWorldQuickStep(objects_.world(), step_);
    quickstep_seed_ = dRandGetSeed();
    dJointGroupEmpty(joints_);
}

void SteppedWorld::respond(const std::vector<IndexPair> &pairs)
{
    contacts_ = 0;
    std::array<dContactGeom, max_contacts> found;
    for (const IndexPair &pair : pairs)
    {
        const dGeomID first = objects_.geom(pair.first);
        const dGeomID second = objects_.geom(pair.second);
        const int count = dCollide(first, second, max_contacts, found.data(), sizeof(dContactGeom));
        contacts_ += static_cast<std::size_t>(count);
        if (count == 0 || take_contacts(pair, found.data(), count))
            continue;
        const dBodyID first_body = dGeomGetBody(first);
        const dBodyID second_body = dGeomGetBody(second);
        for (int i = 0; i < count && (first_body != nullptr || second_body != nullptr); ++i)
        {
            dContact contact{};
            contact.surface = surface_;
            contact.geom = found[static_cast<std::size_t>(i)];
            dJointAttach(dJointCreateContact(objects_.world(), joints_, &contact), first_body, second_body);
        }
    }
}

// Walls touch one another at the edges of the room; these pairs do not count.
void SteppedWorld::add_walls(const Vector3 &half_room, bool lid)
{
    for (const Wall &wall : walls_of(half_room, wall_thickness, lid))
    {
        const Vector3 size = 2 * wall.half;
        set_position(objects_.add_scenery(dCreateBox(objects_.space(), size.x(), size.y(), size.z())), wall.centre);
    }
}

void SteppedWorld::let_bounce(double mu, double bounce, double slowest)
{
    dWorldSetGravity(objects_.world(), 0, 0, 0);
    surface_.mode = dContactApprox1 | dContactBounce;
    surface_.mu = mu;
    surface_.bounce = bounce;
    surface_.bounce_vel = slowest;
}

void SteppedWorld::let_fall(double mu)
{
    dWorldSetGravity(objects_.world(), 0, 0, -standard_gravity);
    dWorldSetContactSurfaceLayer(objects_.world(), 0.001);
    dWorldSetContactMaxCorrectingVel(objects_.world(), 1); // what overlaps at the start is not blasted apart
    surface_.mode = dContactApprox1;
    surface_.mu = mu;
}

ProgramWorld::ProgramWorld(const WorldSpec &spec, dSpaceID space, double step_seconds)
    : SteppedWorld(spec, space, step_seconds)
{
    let_fall(0.8);
    dWorldSetCFM(objects_.world(), 1e-5);
    surface_.mode = dContactSoftERP | dContactSoftCFM | dContactApprox1;
    surface_.soft_erp = 0.2;
    surface_.soft_cfm = 1e-5;
}

ProgramWorld::~ProgramWorld()
{
    std::for_each(spaces_.rbegin(), spaces_.rend(), [](dSpaceID space) {
        dSpaceSetCleanup(space, 0);
        dSpaceDestroy(space);
    });
}

dSpaceID ProgramWorld::add_space(const Bounds &bounds, dSpaceID parent)
{
    spaces_.push_back(make_space_like(objects_.space(), parent != nullptr ? parent : objects_.space(), bounds));
    return spaces_.back();
}

bool ProgramWorld::take_contacts(const IndexPair &pair, const dContactGeom *, int)
{
    const dBodyID first = dGeomGetBody(objects_.geom(pair.first));
    const dBodyID second = dGeomGetBody(objects_.geom(pair.second));
    return first != nullptr && second != nullptr && dAreConnectedExcluding(first, second, dJointTypeContact) != 0;
}

void drive(dJointID hinge, double speed, double torque)
{
    dJointSetHingeParam(hinge, dParamVel, speed);
    dJointSetHingeParam(hinge, dParamFMax, torque);
}

dSpaceID make_space_like(dSpaceID model, dSpaceID parent, const Bounds &bounds)
{
    if (dSpaceIsPredictive(model) != 0)
    {
        const dSpaceID space = dPredictiveSpaceCreate(parent);
        dPredictiveSpaceSetProximity(space, dPredictiveSpaceGetProximity(model));
        return space;
    }
    const dVector3 centre = {bounds.centre.x(), bounds.centre.y(), bounds.centre.z()};
    const dVector3 half = {bounds.half_extent.x(), bounds.half_extent.y(), bounds.half_extent.z()};
    switch (dSpaceGetClass(model))
    {
    case dHashSpaceClass:
        return dHashSpaceCreate(parent);
    case dQuadTreeSpaceClass:
        return dQuadTreeSpaceCreate(parent, centre, half, nested_quadtree_depth);
    case dSweepAndPruneSpaceClass:
        return dSweepAndPruneSpaceCreate(parent, dSAP_AXES_XYZ);
    default:
        return dSimpleSpaceCreate(parent);
    }
}
} // namespace ode_predictive_space::worlds
