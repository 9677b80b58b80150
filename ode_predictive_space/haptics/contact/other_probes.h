// The positions of the other probes of the program.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_OTHER_PROBES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_OTHER_PROBES_H

#include "ode_predictive_space/haptics/device.h"

#include <cstdint>
#include <ode/common.h>
#include <vector>

namespace ode_predictive_space::haptics
{
/// The tool of a probe with a sphere of the library's own, as other probes touch it.
struct ProbeTool
{
    const void *owner = nullptr;
    dGeomID region = nullptr;           ///< the probe's geom in the scene: larger than the tool
    dGeomID sphere = nullptr;           ///< at the tool, in no space
    std::uintptr_t object = 0;          ///< Touch::object
    dSpaceID scene = nullptr;           ///< the outermost space
    unsigned long category = 0;         ///< bits of the region, as ODE has them
    unsigned long collides = 0;         ///< the same
    Vector3 centre = Vector3::Zero();   ///< m
    Vector3 velocity = Vector3::Zero(); ///< m/s
    double radius = 0;                  ///< m
    double stiffness = 0;               ///< N/m; as it is rendered
};

/// Two probes must feel the same force, whatever the order in which they are reported and the loops that run them. So a probe does not
/// take the other one from the near callback: each announces its tool, and finds those of the others here.
///
/// From any thread. A probe that cannot have the list at once keeps what it knew in the tick before, except when probes were made or
/// destroyed: only then it waits.
class OtherProbes
{
public:
    OtherProbes() = default;
    ~OtherProbes() { leave(); }
    OtherProbes(const OtherProbes &) = delete;
    OtherProbes &operator=(const OtherProbes &) = delete;

    /// The probe's own tool is this from now on; its owner is filled in.
    void announce(ProbeTool tool);

    /// The probe has no tool any more.
    void leave();

    /// Takes the latest list.
    void update();

    /// Those that the tool of this probe may touch, by spaces and bits.
    const std::vector<ProbeTool> &near() const { return near_; }

    /// The tool whose region this is; 0 for a geom that is none.
    const ProbeTool *find(dGeomID region);

private:
    void take_list();

    ProbeTool self_;
    std::vector<ProbeTool> all_; ///< as known
    std::vector<ProbeTool> near_;
    std::uint64_t version_ = 0; ///< of the list of probes, as known
};
} // namespace ode_predictive_space::haptics

#endif
