// A small ODE world with a probe, as in a program.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_PROBE_WORLD_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_PROBE_WORLD_H

#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/penalty_law.h"
#include "ode_predictive_space/haptics/probe.h"
#include "ode_predictive_space/haptics/proxy_law.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <ode/ode.h>
#include <ode_predictive_space/predictive_space.h>
#include <string>
#include <vector>

namespace ode_predictive_space::haptics
{
enum class SpaceChoice
{
    simple,
    hash,
    sweep_and_prune,
    predictive,
    predictive_by_shape
};

constexpr SpaceChoice all_space_choices[] = {SpaceChoice::simple, SpaceChoice::hash, SpaceChoice::sweep_and_prune,
                                             SpaceChoice::predictive, SpaceChoice::predictive_by_shape};

inline dSpaceID make_space(SpaceChoice choice, dSpaceID parent = nullptr)
{
    switch (choice)
    {
    case SpaceChoice::simple:
        return dSimpleSpaceCreate(parent);
    case SpaceChoice::hash:
        return dHashSpaceCreate(parent);
    case SpaceChoice::sweep_and_prune:
        return dSweepAndPruneSpaceCreate(parent, dSAP_AXES_XYZ);
    case SpaceChoice::predictive:
    case SpaceChoice::predictive_by_shape:
        break;
    }
    const dSpaceID space = dPredictiveSpaceCreate(parent);
    if (choice == SpaceChoice::predictive_by_shape)
        dPredictiveSpaceSetProximity(space, dPredictiveProximityShape);
    return space;
}

class OdeUse
{
public:
    OdeUse() { dInitODE2(0); }
    ~OdeUse() { dCloseODE(); }
    OdeUse(const OdeUse &) = delete;
    OdeUse &operator=(const OdeUse &) = delete;
};

inline std::shared_ptr<ForceLaw> make_law(bool by_proxy, const Material &material = {})
{
    if (by_proxy)
        return std::make_shared<ProxyLaw>(material);
    return std::make_shared<PenaltyLaw>(material);
}

inline RenderSettings with_law(std::shared_ptr<ForceLaw> law, NoticeSink sink = {})
{
    RenderSettings settings;
    settings.law = std::move(law);
    settings.notice = std::move(sink);
    return settings;
}

inline RenderSettings with_stiffness(double stiffness, NoticeSink sink = {})
{
    return with_law(std::make_shared<PenaltyLaw>(Material{stiffness}), std::move(sink));
}

class ProbeWorld
{
public:
    explicit ProbeWorld(SpaceChoice choice = SpaceChoice::predictive)
        : world(dWorldCreate()), space(make_space(choice)), contacts_(dJointGroupCreate(0))
    {}

    ~ProbeWorld()
    {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space);
        dWorldDestroy(world);
    }

    ProbeWorld(const ProbeWorld &) = delete;
    ProbeWorld &operator=(const ProbeWorld &) = delete;

    /// Adds a body with the inertia of a ball of 0.1 m radius.
    dBodyID add_body(const Vector3 &position, double kilograms)
    {
        const dBodyID body = dBodyCreate(world);
        dMass mass;
        dMassSetSphereTotal(&mass, kilograms, 0.1);
        dBodySetMass(body, &mass);
        dBodySetPosition(body, position.x(), position.y(), position.z());
        return body;
    }

    dGeomID add_box(const Vector3 &sides, const Vector3 &position)
    {
        const dGeomID box = dCreateBox(space, sides.x(), sides.y(), sides.z());
        dGeomSetPosition(box, position.x(), position.y(), position.z());
        return box;
    }

    dBodyID add_moving_box(const Vector3 &sides, const Vector3 &position, double kilograms)
    {
        const dBodyID body = add_body(position, kilograms);
        dGeomSetBody(add_box(sides, position), body);
        return body;
    }

    void collide(HapticProbe &haptic_probe)
    {
        probe_ = &haptic_probe;
        dSpaceCollide(space, this, &near);
    }

    void step(double dt)
    {
        step_world(world, dt);
        dJointGroupEmpty(contacts_);
    }

    /// The work of a loop. @param after called at the end of each step, with its length; may be empty.
    SceneWork work(HapticProbe &haptic_probe, const std::function<void(double dt)> &after = {})
    {
        return {[this, &haptic_probe] { collide(haptic_probe); },
                [this, after](double dt) {
                    step(dt);
                    if (after)
                        after(dt);
                }};
    }

    /// Runs ticks without a loop of the library.
    void run(HapticProbe &haptic_probe, int ticks, double dt = 0.001)
    {
        for (int i = 0; i < ticks; ++i)
        {
            haptic_probe.begin(dt * tick_++);
            collide(haptic_probe);
            haptic_probe.render(dt);
            step(dt);
        }
    }

    decltype(&dWorldStep) step_world = &dWorldStep; ///< or &dWorldQuickStep
    std::function<void(dGeomID, dGeomID)> on_pair;  ///< called for each pair of the near callback; may be empty
    const dWorldID world;
    const dSpaceID space;

private:
    static void near(void *data, dGeomID first, dGeomID second)
    {
        auto &self = *static_cast<ProbeWorld *>(data);
        if (self.on_pair)
            self.on_pair(first, second);
        if (self.probe_->touch(first, second))
            return;
        if (dGeomIsSpace(first) != 0 || dGeomIsSpace(second) != 0)
        {
            dSpaceCollide2(first, second, data, &near);
            return;
        }
        self.add_contacts(first, second);
    }

    /// Bodies that a joint connects do not collide.
    void add_contacts(dGeomID first, dGeomID second)
    {
        const dBodyID one = dGeomGetBody(first);
        const dBodyID other = dGeomGetBody(second);
        if ((one == nullptr && other == nullptr) ||
            (one != nullptr && other != nullptr && dAreConnectedExcluding(one, other, dJointTypeContact) != 0))
            return;
        dContact contacts[8] = {};
        const int count = dCollide(first, second, 8, &contacts[0].geom, sizeof(dContact));
        for (int i = 0; i < count; ++i)
        {
            contacts[i].surface.mode = dContactApprox1;
            contacts[i].surface.mu = 0.5;
            dJointAttach(dJointCreateContact(world, contacts_, &contacts[i]), one, other);
        }
    }

    HapticProbe *probe_ = nullptr;
    dJointGroupID contacts_;
    int tick_ = 0;
};

inline int broken_contact(dGeomID, dGeomID, int, dContactGeom *contact, int)
{
    const dReal nan = std::numeric_limits<dReal>::quiet_NaN();
    *contact = {};
    contact->depth = nan;
    std::fill_n(contact->pos, 3, nan);
    contact->normal[2] = 1;
    return 1;
}

inline dColliderFn *broken_collider(int)
{
    return &broken_contact;
}

inline void broken_box(dGeomID, dReal box[6])
{
    for (int axis = 0; axis < 3; ++axis)
    {
        box[2 * axis] = -1;
        box[2 * axis + 1] = 1;
    }
}

/// A geom two metres wide whose contacts are not numbers. ODE has room for four of them until it is closed.
inline dGeomID add_broken_geom(dSpaceID space)
{
    dGeomClass description = {};
    description.aabb = &broken_box;
    description.collider = &broken_collider;
    const int number = dCreateGeomClass(&description);
    const dGeomID geom = dCreateGeom(number);
    dSpaceAdd(space, geom);
    return geom;
}

inline Vector3 momentum_of(dBodyID body)
{
    dMass mass;
    dBodyGetMass(body, &mass);
    const dReal *velocity = dBodyGetLinearVel(body);
    return mass.mass * Vector3(velocity[0], velocity[1], velocity[2]);
}

class NoticeList
{
public:
    NoticeSink sink()
    {
        return [this](const Notice &notice) { notices_.push_back(notice); };
    }

    int count(NoticeKind kind) const
    {
        return static_cast<int>(
            std::count_if(notices_.begin(), notices_.end(), [&](const Notice &notice) { return notice.kind == kind; }));
    }

    std::string text(NoticeKind kind) const
    {
        for (const Notice &notice : notices_)
            if (notice.kind == kind)
                return std::string(notice.sentence());
        return {};
    }

    const std::vector<Notice> &all() const { return notices_; }

private:
    std::vector<Notice> notices_;
};
} // namespace ode_predictive_space::haptics

#endif
