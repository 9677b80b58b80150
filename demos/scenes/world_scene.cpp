#include "demos/scenes/world_scene.h"

#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double standard_gravity = 9.81; // m/s^2
constexpr unsigned long scenery_category = 2;
constexpr int nested_quadtree_depth = 3;
} // namespace

dBodyID add_body(SceneObjects &objects, dGeomID geom, double mass, const BodyState &state)
{
    objects.add_geom(geom);
    dReal box[6];
    dGeomGetAABB(geom, box);
    dMass inertia;
    dMassSetBoxTotal(&inertia, mass, box[1] - box[0], box[3] - box[2], box[5] - box[4]);
    const dBodyID body = dBodyCreate(objects.world());
    dBodySetMass(body, &inertia);
    dGeomSetBody(geom, body);
    set_state(body, state);
    return body;
}

void attach(SceneObjects &objects, dGeomID geom, dBodyID body, const Vector3 &offset)
{
    objects.add_geom(geom);
    dGeomSetBody(geom, body);
    dGeomSetOffsetPosition(geom, offset.x(), offset.y(), offset.z());
}

dGeomID add_scenery(SceneObjects &objects, dGeomID geom)
{
    dGeomSetCategoryBits(geom, scenery_category);
    dGeomSetCollideBits(geom, ~scenery_category);
    return objects.add_geom(geom);
}

void drive(dJointID hinge, double speed, double torque)
{
    dJointSetHingeParam(hinge, dParamVel, speed);
    dJointSetHingeParam(hinge, dParamFMax, torque);
}

WorldScene::WorldScene(const SceneSpec &spec, dSpaceID space, double step_seconds)
    : ContactScene(space, step_seconds, spec.seed), random_(spec.seed), mean_step_(step_seconds), step_(step_seconds),
      step_random_(haptics::mix_bits(spec.seed))
{
    dWorldSetGravity(objects_.world(), 0, 0, -standard_gravity);
    dWorldSetCFM(objects_.world(), 1e-5);
    dWorldSetContactSurfaceLayer(objects_.world(), 0.001);
    dWorldSetContactMaxCorrectingVel(objects_.world(), 1);
    surface_.mode = dContactSoftERP | dContactSoftCFM | dContactApprox1;
    surface_.mu = 0.8;
    surface_.soft_erp = 0.2;
    surface_.soft_cfm = 1e-5;
}

WorldScene::~WorldScene()
{
    for (const dSpaceID space : spaces_)
    {
        dSpaceSetCleanup(space, 0);
        dSpaceDestroy(space);
    }
}

void WorldScene::advance()
{
    step_ = mean_step_ * step_random_.uniform(1 - variation_, 1 + variation_);
    set_step(step_);
    ContactScene::advance();
}

dSpaceID WorldScene::add_space(const SceneBounds &bounds)
{
    spaces_.push_back(make_space_like(objects_.space(), objects_.space(), bounds));
    return spaces_.back();
}

bool WorldScene::take_contacts(const IndexPair &pair, const dContactGeom *, int)
{
    const dBodyID first = dGeomGetBody(objects_.geom(pair.first));
    const dBodyID second = dGeomGetBody(objects_.geom(pair.second));
    return first != nullptr && second != nullptr && dAreConnectedExcluding(first, second, dJointTypeContact) != 0;
}

dSpaceID make_space_like(dSpaceID model, dSpaceID parent, const SceneBounds &bounds)
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
} // namespace ode_predictive_space::scenes
