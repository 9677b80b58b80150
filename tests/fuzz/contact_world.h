// Geoms of extreme forms and poses in a predictive space. Each tick compares its callbacks with the contacts of all pairs.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_FUZZ_CONTACT_WORLD_H
#define ODE_PREDICTIVE_SPACE_TESTS_FUZZ_CONTACT_WORLD_H

#include <array>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <ode/ode.h>

#include <Eigen/Core>

#include "tests/contract/support/ode_test.h"
#include "tests/shape/hills_geom.h"
#include "tests/shape/polyhedron_geom.h"

namespace ode_predictive_space
{
constexpr int slot_count = 10;

/// The data of a geom. A class uses as many of the sides as it has sizes.
struct Form
{
    int type = dSphereClass; ///< a class of ODE's, up to dHeightfieldClass
    Eigen::Vector3d sides = Eigen::Vector3d::Ones();
    int polyhedron = 0;    ///< shape of a convex or mesh; seed of a heightfield
    bool body = false;     ///< carried by a body
    bool coherent = false; ///< for a mesh: it keeps its triangles from tick to tick
    bool single = false;   ///< for a mesh: its vertices are in single precision
};

/// Totals, to show that a history is not trivial.
struct ContactTally
{
    long ticks = 0;
    long overlapping = 0;                  ///< pairs whose boxes overlap
    long contacts = 0;                     ///< pairs with contacts
    long left_out = 0;                     ///< pairs whose boxes overlap, without a callback
    long forecasts = 0;                    ///< forecasts that were checked at a later tick
    std::set<std::pair<int, int>> classes; ///< pairs of classes with contacts
};

/// A slot is a number below slot_count. An operation has no effect on an empty slot, or on a class that does not support it.
class ContactWorld
{
public:
    struct Setting
    {
        int proximity = 0;
        double deviation = 0; ///< fixed; 0: the space adapts it
        bool asks = false;    ///< queries encounters at each tick, so that new geoms are predicted at once
    };

    ContactWorld(const Setting &setting, ContactTally &tally);
    ~ContactWorld();
    ContactWorld(const ContactWorld &) = delete;
    ContactWorld &operator=(const ContactWorld &) = delete;

    void make(int slot, const Form &form);
    void destroy(int slot);
    void place(int slot, const Eigen::Vector3d &at);
    /// Puts the geom to the border of another one in this direction: the last place with a contact or the first without one,
    /// and farther by this part of their size.
    void place_beside(int slot, int other, const Eigen::Vector3d &direction, bool with_contact, double part);
    void move(int slot, const Eigen::Vector3d &by);
    void turn(int slot, const Eigen::Vector3d &axis, double angle);
    /// Sets the matrix of a quaternion of any length, which need not be a rotation. On a body it is rounded to two digits.
    void set_quaternion(int slot, const Eigen::Vector4d &quaternion);
    void set_offset(int slot, const Eigen::Vector3d &offset);
    void set_velocity(int slot, const Eigen::Vector3d &linear, const Eigen::Vector3d &angular);
    void take_body(int slot);
    void resize(int slot, const Eigen::Vector3d &sides);
    /// Multiplies the sides of a convex by these factors. The corners of a mesh move by half the change of its sides.
    void change_in_place(int slot, const Eigen::Vector3d &factors);
    void rebuild_in_place(int slot, int polyhedron, const Eigen::Vector3d &sides);
    void step(double seconds);
    /// Stores the time of proximity of two geoms. Later ticks compare it with their contacts.
    void foretell(int slot, int other);

    double radius_of(int slot) const; ///< for a sphere, otherwise 0
    double extent_of(int slot) const; ///< diagonal of the bounding box; 0 when it is infinite

    /// One dSpaceCollide(). @return what is wrong, or an empty text.
    std::string tick();

private:
    struct Slot
    {
        dGeomID geom = nullptr;
        Form form;
        ConvexArrays *convex = nullptr; ///< in convexes_, if it is made from one
        MeshArrays *mesh = nullptr;     ///< in meshes_, likewise
    };
    using Bounds = std::array<dReal, 6>;
    struct Forecast
    {
        int slot = -1, other = -1;
        dReal ticks = 0;     ///< no contact before that many ticks, ...
        bool within = false; ///< ... and none at that tick, either
        long made = 0;
        std::array<std::optional<Bounds>, 2>
            boxes; ///< the forecast holds as long as both stay within the deviation of these
    };
    using Slots = std::pair<int, int>;

    dGeomID create(Slot &slot);
    void give_data(Slot &slot);
    Slot *find(int slot);
    static bool collidable(const Slot &one, const Slot &other);
    bool touch(const Slot &one, const Slot &other) const;
    bool overlap(const Slot &one, const Slot &other) const;
    std::set<Slots> reported();
    std::string check(const Slots &pair, bool was_reported);
    static std::optional<Bounds> resting_box(const Slot &slot);
    bool stayed(const Slot &slot, const std::optional<Bounds> &box) const;
    std::string broken_forecast(const Slots &pair);
    std::string describe(const Slots &pair, const char *what) const;

    ContactTally &tally_;
    OdeMessages messages_;
    Setting setting_;
    dWorldID world_;
    dSpaceID space_;
    std::array<Slot, slot_count> slots_;
    std::deque<ConvexArrays> convexes_; // outlive the geoms
    std::deque<MeshArrays> meshes_;
    std::deque<Hills> hills_;
    Forecast forecast_;
};
} // namespace ode_predictive_space

#endif
