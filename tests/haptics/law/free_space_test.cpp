// A program's law adds a force in free space. The touched body gets the contact's force only.

#include "ode_predictive_space/haptics/proxy_law.h"
#include "tests/haptics/support/probe_fixture.h"

namespace ode_predictive_space::haptics
{
namespace
{
class Magnet final : public ForceLaw
{
public:
    explicit Magnet(double pull) : pull_(pull) {}

    void forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces) override
    {
        law_.forces(tool, touches, dt, forces);
        contact += dt * sum_of(forces);
        forces.emplace_back(pull_, 0, 0);
    }

    TouchView view() const override { return law_.view(); }
    void reset() override { law_.reset(); }
    Material material() const override { return law_.material(); }

    Vector3 contact = Vector3::Zero(); ///< N s; of touches only

private:
    ProxyLaw law_;
    double pull_; ///< N
};

using FreeSpaceTest = HapticProbeTest;

TEST_F(FreeSpaceTest, OnTheHandDoesNotPushTheBodyThatIsTouched)
{
    ProbeWorld world;
    const dBodyID body = world.add_moving_box({0.2, 0.2, 0.1}, {0, 0, -0.05}, 1);
    ScriptedDevice device(reach({0, 0, 0.03}, {0, 0, 0.005}));
    const auto law = std::make_shared<Magnet>(0.3);
    HapticProbe probe(device, world.space, radius, with_law(law));
    const Vector3 hand = impulse_on_hand(world, probe, reach_ticks);
    EXPECT_GT(hand.x(), 0.3) << "the pull is felt";
    EXPECT_GT(law->contact.z(), 0.01) << "the box is touched";
    EXPECT_NEAR(momentum_of(body).x(), 0, 1e-12);
    EXPECT_NEAR(momentum_of(body).z(), -hand.z(), 1e-9);
}
} // namespace
} // namespace ode_predictive_space::haptics
