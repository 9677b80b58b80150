// The god object: a point that stays outside of what the tool is in.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PROXY_LAW_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PROXY_LAW_H

#include "ode_predictive_space/haptics/force_law.h"

namespace ode_predictive_space::haptics
{
/// F = k (proxy - tool). The proxy is where the tool would be if no surface could be entered: the point nearest to it that no
/// touch forbids (Zilles and Salisbury, "A constraint-based god-object method for haptic display", 1995). A touch forbids what
/// is behind the plane that lies its depth above the tool, along its normal.
///
/// Up to three planes carry the proxy (a face, an edge, a corner). Each pushes along its own normal by what it contributes, with
/// the stiffness of its own material, so that the parts add up and every object feels its own: k d n on one plane without
/// friction. Where no point is allowed (a slit narrower than the tool), or only one that is unreasonably far (a very sharp
/// wedge), each plane pushes by k d n as if it were alone.
///
/// Friction: the proxy stays on the surfaces, and moves with them, as long as the tool is in the cone of static friction below
/// it; else it follows just to the edge of the cone of friction (Salisbury and Tarr 1997; Harwin and Melder 2002). Damping acts
/// along each carrying plane's normal, and never pulls; it is not part of proxy().
///
/// Where a touch does not know by which side the tool came in (Touch::from_entry_side), and the tool has gone so far into a thin
/// object that its back is nearer, the front keeps pushing until the tool leaves the object.
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

    /// m, in the scene's frame; where the last call left it. The tool's position when nothing is touched.
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
