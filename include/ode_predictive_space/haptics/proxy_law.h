// The god object: a point that stays outside of what the tool is in.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PROXY_LAW_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PROXY_LAW_H

#include "ode_predictive_space/haptics/force_law.h"

namespace ode_predictive_space::haptics
{
/// F = k (proxy - tool). The proxy is where the tool would be if no surface could be entered: the point nearest to the tool
/// that no touch forbids (Zilles and Salisbury, "A constraint-based god-object method for haptic display", 1995).
///
/// A touch forbids what is behind the plane that lies its depth above the tool, along its normal. Up to three such planes carry
/// the proxy (a face, an edge, a corner); each of them pushes along its own normal by what it contributes, so that the parts
/// add up to k (proxy - tool) and every object feels its own part. On one plane without friction that is k d n.
/// Where no point is allowed (a slit narrower than the tool), or only one that is unreasonably far (a very sharp wedge), each
/// plane pushes by k d n as if it were alone.
///
/// Friction: the proxy stays where it is on the surfaces, and moves along with them, as long as the tool is in the friction
/// cone below it; otherwise it follows just as far as the cone's edge (Salisbury and Tarr 1997; Harwin and Melder 2002).
/// Damping acts along each carrying plane's normal, and never pulls; it is not part of proxy().
///
/// Unlike a penalty, the proxy remembers on which side of an object it is: when the tool has gone so far into a thin object
/// that its surface at the back is nearer, and the normal turns round, the surface in front goes on to push, until
/// the tool leaves the object.
class ProxyLaw final : public ForceLaw
{
public:
    /// @throws std::invalid_argument as check() does.
    explicit ProxyLaw(const SurfaceProperties &properties = {});

    void forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces) override;
    void reset() override;
    double stiffness() const override { return properties_.stiffness; }
    double damping() const override { return properties_.damping; }
    void set_stiffness(double stiffness) override;

    /// m, in the scene's frame; where the proxy was after the last tick. The tool's position when nothing is touched.
    const Vector3 &proxy() const { return proxy_; }

private:
    /// The surface of an object that keeps the proxy out.
    struct Plane
    {
        std::uintptr_t object;
        Vector3 normal;
        double depth;  // m; how far the tool is below the plane
        double share;  // m; how far this plane lifts the proxy off the tool, along its normal
        double height; // m; of the plane along its normal: normal . (a point on it)
    };

    void find_planes(const Vector3 &tool, const std::vector<Touch> &touches, double dt);
    Plane plane_of(const Vector3 &tool, const Touch &touch, double dt) const;
    void lift();
    Vector3 slip(const Vector3 &tool, const std::vector<Touch> &touches, double dt) const;

    SurfaceProperties properties_;
    std::vector<Plane> planes_;      // of this tick, in the order of the touches
    std::vector<Plane> last_planes_; // of the tick before
    std::vector<Vector3> normals_;   // of planes_, as closest_point() wants them
    std::vector<double> depths_;
    std::vector<double> shares_;
    Vector3 proxy_ = Vector3::Zero();
};
} // namespace ode_predictive_space::haptics

#endif
