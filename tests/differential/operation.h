// A history: a program's operations on a scene as plain records, so that it can be replayed and shrunk.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_DIFFERENTIAL_OPERATION_H
#define ODE_PREDICTIVE_SPACE_TESTS_DIFFERENTIAL_OPERATION_H

#include <array>
#include <string>
#include <vector>

namespace ode_predictive_space
{
/// `subject` and `object` are slots of geoms, bodies or spaces, or references to a geom or a space.
enum class Action
{
    make_geom,    ///< geom subject of GeomKind number, size value[0], at value[1..3], in space object (-1: in none)
    destroy_geom, ///< geom subject
    make_body,    ///< body subject at value[0..2]; number: 0 dynamic, 1 without gravity, 2 kinematic
    destroy_body, ///< body subject
    attach,       ///< geom subject to body object (-1: to none)
    offset,       ///< geom subject: value[0..2] from its body, turned by value[3]
    clear_offset, ///< geom subject
    move_geom,    ///< geom subject to value[0..2]
    move_body,    ///< body subject to value[0..2]
    turn_geom,    ///< geom subject, about the axis value[0..2] by value[3]
    turn_body,    ///< body subject, likewise
    resize,       ///< geom subject to size value[0]
    enable_geom,  ///< geom subject; number: 0 no, 1 yes
    enable_body,  ///< body subject; number likewise
    bits,         ///< geom or space subject; number: category bits + 256 * collide bits
    velocity,     ///< body subject: value[0..2]; it also spins, by value[3]
    force,        ///< body subject: value[0..2]
    kinematic,    ///< body subject; number: 0 no, 1 yes
    drive,        ///< geom subject moves by value[0..2] in each step; number: DriveMode
    take_out,     ///< geom or space subject leaves its space
    put_in,       ///< geom or space subject into space object, if it is in none
    make_space,   ///< space subject in space object; number: NestedKind + 16 * cleanup mode
    destroy_space,
    clean,            ///< dSpaceClean() of space subject
    ask_bounds,       ///< dGeomGetAABB() of geom or space subject
    role,             ///< geom subject gets role number, if it is in a predictive space
    deviation,        ///< for role number in space subject: value[0..2]
    horizon,          ///< for space subject: from number to object ticks
    step,             ///< the world, by value[0] seconds
    tick,             ///< dSpaceCollide() of the outermost space, and at times of the others
    calm,             ///< number ticks, each after `object` steps of value[0] seconds
    query,            ///< dSpaceCollide2() of the geoms or spaces subject and object
    tick_asking,      ///< a tick whose callback queries the outermost space for its first geom
    tick_broken_off,  ///< in a predictive space: a tick whose callback number `number` throws
    query_broken_off, ///< likewise for dSpaceCollide2() of the geoms or spaces subject and object
    data_changed,     ///< dPredictiveSpaceGeomChanged() of geom subject, if it is in a predictive space
    bad_call,         ///< in a predictive space: the call with a bad argument that has this number
    tick_throwing_bounds, ///< in predictive spaces: a tick in which the aabb function of a user class throws at call `number`
    query_throwing_bounds, ///< likewise for dSpaceCollide2() of the geoms or spaces subject and object
    change_in_place,       ///< convex or mesh subject gets size value[0]; if it has its own data, these change in place
    ask_times, ///< in a predictive space: when geoms subject and object meet, and the first `number` encounters of subject
    shape_margin, ///< for space subject: value[0]
    distort_geom, ///< geom subject gets a matrix that may be no rotation: that of turn_geom, changed by `number`, in hundredths
    distort_body, ///< body subject, likewise
    aim_ray,      ///< geom subject, if it is a ray: from value[0..2], in a direction that `number` selects
    last = aim_ray
};

enum class DriveMode
{
    none,
    straight,
    swinging,
    jerking ///< only now and then
};

/// The outermost space and nested spaces `of_same_kind` are simple in one universe and predictive in the other.
enum class NestedKind
{
    of_same_kind,
    simple,
    hash,
    sweep_and_prune,
    quadtree,
    last = quadtree
};

struct Operation
{
    Action action = Action::tick;
    int subject = -1;
    int object = -1;
    int number = 0;
    std::array<double, 4> value{};
};

/// Space slots as references, distinct from geom slots.
constexpr int first_space_reference = 100000;
constexpr int space_reference(int slot)
{
    return first_space_reference + slot;
}

struct History
{
    double gravity = 0; ///< along z, in metres per second^2
    std::array<double, 3> middle{};
    double extent = 10;        ///< bodies turn back when they are farther from the middle than this along an axis
    bool contacts = false;     ///< pairs that touch get contact joints
    bool auto_disable = false; ///< inactive bodies are disabled
    std::vector<Operation> operations;
};

const char *action_name(Action action);
std::string to_text(const Operation &operation);
std::string to_text(const History &history);
} // namespace ode_predictive_space

#endif
