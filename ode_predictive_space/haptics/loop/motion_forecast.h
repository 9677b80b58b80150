// How touched surfaces will move until the scene is looked at again: by themselves, and by what the hand does to them.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MOTION_FORECAST_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MOTION_FORECAST_H

#include "ode_predictive_space/haptics/loop/contact_model.h"

#include <vector>

namespace ode_predictive_space::haptics
{
/// What the hand got of an object in a tick of the servo: it owes the object the opposite.
struct Impulse
{
    std::uintptr_t object;
    Vector3 point;            ///< m
    Vector3 impulse;          ///< N s
    double time = 0;          ///< s; when the tick began
    std::uint64_t number = 0; ///< goes up from impulse to impulse
};

/// A body's displacement and the vector of its rotation, about its centre of mass: m and rad. Or the velocities.
using BodyMotion = Eigen::Matrix<double, 6, 1>;

/// An impulse and its moment about the centre of mass: N s and N m s.
using ImpulseWrench = Eigen::Matrix<double, 6, 1>;

/// What the scene's roll-outs found: where the touched bodies will be at some nodes of time, and how impulses change that, through
/// all joints and contacts. Of fixed size, to be handed from thread to thread.
///
///     moved_j(t) = free_j(t - t_0) - sum over i, tau of R_ij(t - tau) J_i(tau)      over the impulses that the scene has not got
///
/// Straight lines between the nodes, and beyond the last. J is the hand's; the body gets the opposite. Of each touch some pushes were
/// tried; an impulse counts as the combination of them that comes nearest to it.
class MotionForecast
{
public:
    static constexpr std::size_t most_touches = 4;
    static constexpr std::size_t most_nodes = 2; ///< the next step, and one that comes late
    static constexpr int tried_pushes = 5;       ///< of one touch

    /// 0 at the beginning, then one value for each node.
    template <typename Value> using Course = std::array<Value, most_nodes + 1>;
    using PushWrenches = Eigen::Matrix<double, 6, tried_pushes>;
    using Response = Eigen::Matrix<double, 6, tried_pushes>; ///< by push: the motion of a body

    /// A touched place of a body.
    struct Place
    {
        Touch touch;
        Vector3 centre;                                     ///< m; of the body's mass
        BodyMotion velocity;                                ///< m/s, rad/s; when the scene was looked at
        Eigen::Matrix<double, tried_pushes, 6> combination; ///< from an impulse to the pushes that were tried
    };

    /// Nothing is touched. @param time s; when the scene was looked at.
    void begin(double time);

    /// @param nodes how many, 1 to most_nodes. @param node_length s; from one to the next.
    void set_nodes(std::size_t nodes, double node_length);

    /// The next free index is its.
    ///
    /// @param pushes what was tried, with impulses of 1 N s.
    void add(const Place &place, const PushWrenches &pushes);

    std::size_t count() const { return count_; }
    Course<BodyMotion> &free(std::size_t touch) { return free_[touch]; }
    Course<BodyMotion> free_of_velocity(std::size_t touch) const; ///< as if nothing acted on it
    Course<Response> &response(std::size_t pushed, std::size_t seen) { return response_[pushed][seen]; }

    /// Which impulses the scene had got.
    void set_included(std::uint64_t last) { last_included_ = last; }
    std::uint64_t last_included() const { return last_included_; }

    /// What the touched bodies did besides going on with the velocities that they had.
    ///
    /// @param impulses those that the scene has got are left out.
    void shift(const std::vector<Impulse> &impulses, double now, const ContactModel &planes,
               ContactModel::Shifts &shifts) const;

private:
    /// A time as a place between two nodes.
    struct Moment
    {
        std::size_t node; ///< the earlier one
        double part;      ///< of the way to the later one; above 1 beyond the last
    };

    struct Motion
    {
        BodyMotion moved;
        BodyMotion velocity;
    };

    Moment moment(double elapsed) const;
    std::size_t pushed_by(const Impulse &impulse) const;
    void add_response(const Impulse &impulse, double now, std::array<Motion, most_touches> &motions) const;

    std::array<Place, most_touches> places_;
    std::array<Course<BodyMotion>, most_touches> free_;
    std::array<std::array<Course<Response>, most_touches>, most_touches> response_;
    std::size_t count_ = 0;
    std::size_t nodes_ = 1;
    double node_length_ = 1;
    double time_ = 0;
    std::uint64_t last_included_ = 0;
};
} // namespace ode_predictive_space::haptics

#endif
