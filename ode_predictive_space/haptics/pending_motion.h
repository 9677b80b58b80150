// How what is touched moves by impulses that the scene does not show yet.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PENDING_MOTION_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PENDING_MOTION_H

#include "ode_predictive_space/haptics/contact_model.h"
#include "ode_predictive_space/haptics/force_shares.h"

namespace ode_predictive_space::haptics
{
/// The scene gets an impulse up to a step after the hand gave it, and shows what came of it another step later. A light body would be
/// pushed on meanwhile, as if it were a wall. So the servo moves the planes on by itself:
///
///     shift = lead + yield * sum of response(J) (t - t_J)        over the impulses J that the model does not include
///
/// t_J is the beginning of the tick in which J was given: the integration is semi-implicit as ODE's is, and creates no energy. When a model
/// comes that includes J, the body has moved by J since the beginning of the scene's step only; what it lacks goes into the lead, so
/// that the surface goes on from where it was. The lead of a free body lasts as long as the contact, or fades within a second; that of a
/// held one, which was an error, within 20 ms.
///
/// Used from the servo's thread. Neither allocates nor locks.
class PendingMotion
{
public:
    /// @param most_impulses that can be on their way.
    explicit PendingMotion(std::size_t most_impulses);

    /// An impulse that the scene will get: N s, on the body, at a point in the scene's frame.
    /// @param time s; when the force began.
    /// @param number goes up from impulse to impulse.
    void add(std::uintptr_t object, const Vector3 &point, const Vector3 &impulse, double time, std::uint64_t number);

    /// The tick that begins now.
    ///
    /// @param contacts the latest model. @param is_new whether it was not there in the tick before.
    /// @param held the forces that the hand feels since a time (s). They count as long as nothing else is told.
    void update(const ContactModel &contacts, bool is_new, const std::vector<ForceShare> &held, double since,
                double now);

    const ContactModel::Shifts &shifts() const { return shifts_; }

private:
    struct Given
    {
        std::uintptr_t object;
        Vector3 point;
        Vector3 impulse;
        double time;
        std::uint64_t number;
    };

    /// Of a surface.
    struct Lead
    {
        std::uintptr_t object = 0;
        unsigned feature = 0;
        Vector3 offset = Vector3::Zero(); ///< m
        double yield = 1;
    };

    const Lead *lead_before(const Touch &touch) const;
    void renew(const ContactModel &contacts, double now);
    void fade(double elapsed);
    void shift(const ContactModel &contacts, double now);

    std::size_t most_impulses_;
    std::vector<Given> given_;
    std::vector<Lead> leads_; ///< of the model's surfaces, in their order
    std::vector<Lead> leads_before_;
    ContactModel::Shifts shifts_;
    double last_time_ = 0;
};
} // namespace ode_predictive_space::haptics

#endif
