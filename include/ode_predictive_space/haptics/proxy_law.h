// The proxy law: a god object, which stays outside of all surfaces.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PROXY_LAW_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PROXY_LAW_H

#include "ode_predictive_space/haptics/force_law.h"

namespace ode_predictive_space::haptics
{
/// F = k (proxy - tool). The proxy is the allowed point nearest to the tool (Zilles and Salisbury, "A constraint-based
/// god-object method for haptic display", 1995). A touch forbids the points behind the plane at its depth above the
/// tool, along its normal.
///
/// Up to three planes carry the proxy (a face, an edge, a corner). Each pushes along its normal by its share, with the
/// stiffness of its material: k d n on a single plane without friction. Without an allowed point (a slit narrower than
/// the tool), or with a very far one (a sharp wedge), each plane pushes by k d n alone.
///
/// Friction: the proxy stays on the surfaces, and moves with them, while the tool is in the cone of static friction
/// below it; otherwise it follows to the edge of the cone of friction (Salisbury and Tarr 1997; Harwin and Melder
/// 2002). Damping acts along the normals of carrying planes, and never pulls; it does not move proxy().
///
/// If a touch does not have the side of entry (Touch::from_entry_side), and the back of a thin object becomes nearer,
/// the front keeps pushing until the tool leaves the object.
class ProxyLaw final : public ForceLaw
{
public:
    /// @throws std::invalid_argument for a property that is negative or not finite.
    explicit ProxyLaw(const Material &material = {});

    void forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces) override;
    TouchView view() const override { return TouchView::all_together; }
    void reset() override;
    Material material() const override { return material_; }
    const char *name() const override { return "proxy"; }

    /// The proxy of the last forces(), m, in the scene's frame; equal to the tool without a touch.
    const Vector3 &proxy() const { return proxy_; }

private:
    Vector3 friction(const Vector3 &tool, const Vector3 &lifted, double carried, const std::vector<Touch> &touches,
                     double dt);
    double most_friction(const std::vector<Touch> &touches, bool slides) const;

    Material material_;
    bool slides_ = false;
    Vector3 proxy_ = Vector3::Zero();
    bool has_proxy_ = false;
};
} // namespace ode_predictive_space::haptics

#endif
