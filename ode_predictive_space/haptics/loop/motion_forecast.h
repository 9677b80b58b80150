// Prediction of the motion of touched surfaces until the next step of the scene, with the hand's impulses.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MOTION_FORECAST_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MOTION_FORECAST_H

#include "ode_predictive_space/haptics/contact/short_list.h"
#include "ode_predictive_space/haptics/touch.h"

#include <algorithm>
#include <array>
#include <vector>

namespace ode_predictive_space::haptics
{
/// The motion of an object beyond that by its constant velocity.
struct Shift
{
    std::uintptr_t object = 0;          ///< as Touch has it
    Vector3 moved = Vector3::Zero();    ///< m; its centre of mass
    Vector3 velocity = Vector3::Zero(); ///< m/s; of that
    Vector3 turned = Vector3::Zero();   ///< rad; the vector of a rotation about the centre
    Vector3 spin = Vector3::Zero();     ///< rad/s
};

using Shifts = std::array<Shift, 8>;

/// The shift of an object, by its deepest touch; zero for an object without a prediction.
inline Shift shift_of(std::uintptr_t object, const Shifts &shifts)
{
    const Shift *const found = find_in(shifts, [object](const Shift &shift) { return shift.object == object; });
    return found != nullptr ? *found : Shift();
}

/// The impulse on the hand by an object in a tick of the servo. The object gets the opposite.
struct Impulse
{
    std::uintptr_t object;
    Vector3 arm;              ///< m; from the body's centre of mass, in the tick
    Vector3 impulse;          ///< N s
    double time = 0;          ///< s; when the tick began
    std::uint64_t number = 0; ///< increasing
};

/// A body's displacement and the vector of its rotation, about its centre of mass: m and rad. Or the velocities.
using BodyMotion = Eigen::Matrix<double, 6, 1>;

/// An impulse and its moment about the centre of mass: N s and N m s.
using ImpulseWrench = Eigen::Matrix<double, 6, 1>;

/// Results of the roll-outs: positions of the touched bodies at nodes of time, and their response to impulses through all
/// joints and contacts. It has a fixed size, to be passed between threads. Over the impulses J that the scene has not got,
///
///     moved_j(t) = free_j(t - t_0) - sum over i, tau of R_ij(t - tau) J_i(tau)
///
/// Motion is linear between the nodes and beyond the last. J acts on the hand; the body gets the opposite. Some pushes are
/// tried at each touch, and an impulse is expressed as their nearest combination.
struct MotionForecast
{
    static constexpr std::size_t most_touches = std::tuple_size_v<Shifts>;
    static constexpr std::size_t nodes = 2; ///< the next step, and a late one
    static constexpr int tried_pushes = 5;  ///< of one touch

    /// The value 0, then one for each node.
    template <typename Value> using Course = std::array<Value, nodes + 1>;
    using Response = Eigen::Matrix<double, 6, tried_pushes>; ///< motion of a body, a column for each push

    struct Place
    {
        Touch touch;
        BodyMotion velocity;                                ///< m/s, rad/s; at the beginning
        Eigen::Matrix<double, tried_pushes, 6> combination; ///< from an impulse to the tried pushes
        Course<BodyMotion> free;                            ///< motion without the hand
    };

    double time = 0;                 ///< s; of the beginning
    double node_length = 1;          ///< s; a step of the scene
    std::uint64_t last_included = 0; ///< number of the last applied impulse
    std::size_t count = 0;
    std::array<Place, most_touches> places;
    std::array<std::array<Course<Response>, most_touches>, most_touches> response; ///< by pushed place

    bool predicts(std::uintptr_t object) const;

    Shifts shifts(const std::vector<Impulse> &impulses, double now) const;
};
} // namespace ode_predictive_space::haptics

#endif
