// The positions of the other probes of the program.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_OTHER_PROBES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_OTHER_PROBES_H

#include "ode_predictive_space/haptics/device.h"

#include <cstdint>
#include <ode/common.h>
#include <vector>

namespace ode_predictive_space::haptics
{
/// The sphere at the tool of a probe, which other probes touch.
struct ProbeTool
{
    const void *owner = nullptr;
    dGeomID region = nullptr;   ///< the probe's geom in the scene: larger than the tool
    dGeomID sphere = nullptr;   ///< at the tool, in no space
    std::uintptr_t object = 0;  ///< Touch::object
    dSpaceID scene = nullptr;   ///< the outermost space
    unsigned long category = 0; ///< bits of the region, as ODE has them
    unsigned long collides = 0;
    Vector3 centre = Vector3::Zero();   ///< m
    Vector3 velocity = Vector3::Zero(); ///< m/s
    double radius = 0;                  ///< m
    double stiffness = 0;               ///< N/m
};

/// Two probes must feel the same force, whatever the order of callbacks and loops. So each probe announces its tool here, and
/// finds the other tools here instead of in the near callback. From any thread. A probe that finds the list locked uses its
/// copy of the tick before; it waits only after probes were made or destroyed.
class OtherProbes
{
public:
    OtherProbes() = default;
    ~OtherProbes() { leave(); }
    OtherProbes(const OtherProbes &) = delete;
    OtherProbes &operator=(const OtherProbes &) = delete;

    /// Publishes the probe's tool, and fills in its owner.
    void announce(ProbeTool tool);

    void leave();

    void update();

    /// The tools that this probe may touch, by spaces and bits.
    const std::vector<ProbeTool> &near() const { return near_; }

    const ProbeTool *find(dGeomID region);

private:
    void take_list();

    ProbeTool self_;
    std::vector<ProbeTool> all_;
    std::vector<ProbeTool> near_;
    std::uint64_t version_ = 0; ///< of the list of probes, as known
};
} // namespace ode_predictive_space::haptics

#endif
