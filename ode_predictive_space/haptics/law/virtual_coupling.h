// A spring between the hand and a body of the scene.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_VIRTUAL_COUPLING_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_VIRTUAL_COUPLING_H

#include "ode_predictive_space/haptics/force_law.h"

namespace ode_predictive_space::haptics
{
/// Holds a dynamic body (the tool) to the device by a spring and a damper, for position and for orientation
/// (Colgate, Stanley and Brown, "Issues in the haptic display of tool use", 1995). The body collides as any other; the hand feels
/// only the coupling, which therefore bounds what stiffness the device has to render, whatever the tool hits.
class VirtualCoupling
{
public:
    /// @throws std::invalid_argument when a property is negative or not finite.
    explicit VirtualCoupling(const CouplingProperties &properties = {});

    /// The wrench on the device; the tool body gets exactly the opposite, force and torque, at its position.
    ///
    /// @param device the device's handle, @param tool the body that is held; both in the scene's frame.
    /// The orientations are joined by the shorter way round.
    Wrench on_device(const ToolState &device, const ToolState &tool) const;

    double stiffness() const { return properties_.stiffness; } ///< N/m
    double damping() const { return properties_.damping; }     ///< N s/m

    /// For the stability check. @throws std::invalid_argument when it is negative or not finite.
    void set_stiffness(double stiffness);

private:
    CouplingProperties properties_;
};

/// What the other side of a wrench feels: exactly minus it.
Wrench opposite(const Wrench &wrench);
} // namespace ode_predictive_space::haptics

#endif
