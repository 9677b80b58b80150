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
    Vector3 arm;              ///< m; from the body's centre of mass, in the tick
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
struct MotionForecast
{
    static constexpr std::size_t most_touches = std::tuple_size_v<Shifts>;
    static constexpr std::size_t nodes = 2; ///< the next step, and one that comes late
    static constexpr int tried_pushes = 5;  ///< of one touch

    /// 0 at the beginning, then one value for each node.
    template <typename Value> using Course = std::array<Value, nodes + 1>;
    using Response = Eigen::Matrix<double, 6, tried_pushes>; ///< by push: the motion of a body

    /// A touched place of a body.
    struct Place
    {
        Touch touch;
        Vector3 centre;                                     ///< m; of the body's mass
        BodyMotion velocity;                                ///< m/s, rad/s; when the scene was looked at
        Eigen::Matrix<double, tried_pushes, 6> combination; ///< from an impulse to the pushes that were tried
        Course<BodyMotion> free;                            ///< the motion of the body if the hand does nothing
    };

    double time = 0;                 ///< s; when the scene was looked at
    double node_length = 1;          ///< s; a step of the scene
    std::uint64_t last_included = 0; ///< the number of the last impulse that the scene had got
    std::size_t count = 0;           ///< of places
    std::array<Place, most_touches> places;
    std::array<std::array<Course<Response>, most_touches>, most_touches> response; ///< by the place that is pushed

    /// Whether it has an object: others answer a push with the next step of the scene.
    bool foresees(std::uintptr_t object) const;

    /// What the touched bodies did besides going on with the velocities that they had.
    ///
    /// @param impulses those that the scene has got are left out.
    Shifts shifts(const std::vector<Impulse> &impulses, double now) const;
};
} // namespace ode_predictive_space::haptics

#endif
