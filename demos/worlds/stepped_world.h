#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_STEPPED_WORLD_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_STEPPED_WORLD_H

#include "demos/worlds/world.h"

namespace ode_predictive_space::worlds
{
constexpr double wall_thickness = 0.5; ///< m; of the walls around a room

constexpr double standard_gravity = 9.81; // m/s^2

/// A world stepped by dWorldQuickStep(). Every exact space gives the same motion, to the last bit: contacts are made in the
/// order of the geoms' numbers, and the random numbers that QuickStep draws are the world's own.
class SteppedWorld : public World
{
public:
    ~SteppedWorld() override { dJointGroupDestroy(joints_); }

    void advance() override;
    void respond(const std::vector<IndexPair> &pairs) override;
    bool moves_by_itself() const override { return false; }

protected:
    SteppedWorld(const WorldSpec &spec, dSpaceID space, double step_seconds);

    /// Let each step be longer or shorter by up to this share.
    void vary_steps(double share) { variation_ = share; }

    double step() const { return step_; } ///< s

    /// Called before each step: adds the world's own forces.
    virtual void before_step() {}

    /// Called for each pair that has contacts, before joints are made. When it returns true, the contacts get no joints.
    virtual bool take_contacts(const IndexPair &, const dContactGeom *, int /* count */) { return false; }

    /// The walls of a box-shaped room, open above when `lid` is false. Boxes and not planes: an infinite geom is near
    /// everything in a sweep-and-prune space.
    void add_walls(const Vector3 &half_room, bool lid);

    /// Without gravity, and everything bounces.
    void let_bounce(double mu, double bounce, double slowest);

    /// With gravity, and nothing bounces.
    void let_fall(double mu);

    dSurfaceParameters surface_{};

private:
    double mean_step_;
    double step_;
    double variation_ = 0;
    haptics::Random step_random_;
    unsigned long quickstep_seed_;
    dJointGroupID joints_;
};

/// A world as a program has it: gravity, soft contacts between all bodies that no joint connects, spaces in the space.
class ProgramWorld : public SteppedWorld
{
public:
    ~ProgramWorld() override;

protected:
    ProgramWorld(const WorldSpec &spec, dSpaceID space, double step_seconds);

    /// A space of the same kind in the world's space, or in `parent`.
    dSpaceID add_space(const Bounds &bounds, dSpaceID parent = nullptr);

    bool take_contacts(const IndexPair &pair, const dContactGeom *contacts, int count) override;

private:
    std::vector<dSpaceID> spaces_;
};

/// Set the speed of a hinge, in rad/s, and the largest torque for it, in N m.
void drive(dJointID hinge, double speed, double torque);

/// A space of the same kind and with the same settings as another one, in `parent` or, when that is null, by itself.
dSpaceID make_space_like(dSpaceID model, dSpaceID parent, const Bounds &bounds);
} // namespace ode_predictive_space::worlds

#endif
