// What the servo knows of the scene between two steps of it.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MODEL_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MODEL_H

#include "ode_predictive_space/haptics/mobility.h"
#include "ode_predictive_space/haptics/touch.h"

#include <array>
#include <limits>

namespace ode_predictive_space::haptics
{
/// The surfaces around the probe as planes that move: one for each touch, as it was when the scene was looked at last. Of
/// fixed size, to be handed from thread to thread; what it costs does not depend on the scene.
///
/// A plane moves with the velocity that the surface had at the contact, and by what impulses have moved it that the scene had not
/// got yet (see PendingMotion). Depth changes by how the tool moves along the normal: that is exact for a flat surface, whatever the
/// shape of the probe, as long as the probe does not turn.
class ContactModel
{
public:
    /// If there are more touches than that, the deepest are kept.
    static constexpr std::size_t capacity = 32;

    /// A plane.
    struct Surface
    {
        Touch touch;
        Mobility mobility; ///< what an impulse at the touch does to it
    };

    /// What a surface did that the scene does not know yet.
    struct Shift
    {
        Vector3 moved = Vector3::Zero();    ///< m
        Vector3 velocity = Vector3::Zero(); ///< m/s
    };
    using Shifts = std::array<Shift, capacity>;

    /// @param touches as TouchSensor tells them, those with a negative depth included.
    /// @param all_known whether these are all.
    /// @param tool m, the scene's frame; where the probe was.
    /// @param time s; when this was so.
    void set(const std::vector<Touch> &touches, bool all_known, const Vector3 &tool, double time);

    /// Which impulses have moved what the model shows: those up to this number, from this time on (s).
    void set_included(std::uint64_t last, double since)
    {
        last_included_ = last;
        included_since_ = since;
    }

    /// What a probe touches that is at another place at another time. Touches from the side of entry are left out: they are
    /// those of geoms that the servo knows better.
    ///
    /// @param shifts one for each surface.
    /// @param touches is overwritten: those whose depth is above 0.
    void evaluate(const Vector3 &tool, double time, const Shifts &shifts, std::vector<Touch> &touches) const;

    std::size_t count() const { return count_; }
    const Surface &surface(std::size_t index) const { return surfaces_[index]; }
    Mobility &mobility(std::size_t index) { return surfaces_[index].mobility; }
    bool all_known() const { return all_known_; }
    std::uint64_t last_included() const { return last_included_; }
    double included_since() const { return included_since_; }

private:
    std::array<Surface, capacity> surfaces_;
    std::size_t count_ = 0;
    bool all_known_ = true;
    Vector3 tool_ = Vector3::Zero();
    double time_ = 0;
    std::uint64_t last_included_ = 0;
    double included_since_ = -std::numeric_limits<double>::infinity();
};
} // namespace ode_predictive_space::haptics

#endif
