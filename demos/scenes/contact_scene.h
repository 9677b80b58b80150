// What the scenes with real contacts share: contact joints in an order that does not depend on the space.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_CONTACT_SCENE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_CONTACT_SCENE_H

#include "demos/scenes/scene_objects.h"

namespace ode_predictive_space::scenes
{
/// A scene stepped by dWorldQuickStep(). Every exact space gives the same motion, to the last bit: contacts are made in the
/// order of the geoms' numbers, and the random numbers that QuickStep draws are the scene's own.
class ContactScene : public Scene
{
public:
    ~ContactScene() override;

    void advance() override;
    void respond(const std::vector<IndexPair> &pairs) override;
    std::size_t contacts() const override { return contacts_; }
    bool moves_by_itself() const override { return false; }
    const std::vector<dGeomID> &geoms() const override { return objects_.geoms(); }
    const ProbeReport *probe() const override { return nullptr; }

protected:
    ContactScene(dSpaceID space, double step_seconds, std::uint64_t seed);

    /// Called before each step: adds the scene's own forces.
    virtual void before_step() {}

    /// For steps that vary: how long the next ones are.
    void set_step(double seconds) { step_seconds_ = seconds; }

    /// Called for each pair that has contacts, before joints are made. When it returns true, the contacts of the pair get no
    /// joints.
    virtual bool take_contacts(const IndexPair &pair, const dContactGeom *contacts, int count);

    /// The walls of a box-shaped room, open above when `lid` is false. Boxes and not planes: an infinite geom is near
    /// everything in a sweep-and-prune space. Their category and collide bits keep them from colliding with one another.
    void add_walls(const Vector3 &half_room, double thickness, bool lid);

    SceneObjects objects_;
    dSurfaceParameters surface_{};

private:
    double step_seconds_;
    unsigned long random_seed_;
    dJointGroupID joints_;
    std::size_t contacts_ = 0;
};
} // namespace ode_predictive_space::scenes

#endif
