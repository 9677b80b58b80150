// Random histories of geoms that move, turn, grow and vanish in all ways of ODE, with the contacts found by brute force.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SHAPE_SHAPE_HISTORY_H
#define ODE_PREDICTIVE_SPACE_TESTS_SHAPE_SHAPE_HISTORY_H

#include <deque>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <ode/ode.h>

#include "tests/contract/support/geom_zoo.h"
#include "tests/shape/hills_geom.h"
#include "tests/shape/polyhedron_geom.h"

namespace ode_predictive_space
{
class ShapeHistory
{
public:
    struct Setting
    {
        unsigned seed = 0;
        int geoms = 24;
        double half_room = 2;    ///< half the side of the cube that holds them
        double surprises = 0.3;  ///< changes per tick beside motion
        bool all_classes = true; ///< otherwise spheres, boxes and capsules, and the next two
        bool with_plane = true;
        bool with_cylinders = true;
        bool with_room = false;  ///< a mesh around all, with pillars, in place of the plane; half of the rooms move
        bool with_hills = false; ///< a heightfield below all, in place of the plane; some can be moved
        int proximity = 0;
        int interactive = 2;  ///< one in this many geoms is interactive: its pairs with primitives are tested by shape
        double deviation = 0; ///< fixed; 0: the space adapts it. A large one keeps pairs near for long.
    };

    explicit ShapeHistory(const Setting &setting);
    ~ShapeHistory();
    ShapeHistory(const ShapeHistory &) = delete;
    ShapeHistory &operator=(const ShapeHistory &) = delete;

    void advance();

    using GeomPairs = std::set<std::pair<dGeomID, dGeomID>>;

    struct Collision
    {
        GeomPairs contacts; ///< pairs with a contact
        long calls = 0;     ///< calls of dCollide(), one for each pair reported
        long repeated = 0;  ///< pairs that were reported before at the same tick
    };
    Collision collide();

    struct Truth
    {
        GeomPairs contacts;
        long overlapping = 0; ///< pairs whose boxes overlap
    };
    Truth brute_force() const;

    /// A dSpaceCollide2() of the space with a probe, which may be in this space or in none.
    Collision ask(dGeomID probe);
    Truth brute_force(dGeomID probe) const;
    /// Probes among the geoms: a ball and a ray, which go elsewhere each time, and one of the geoms.
    std::vector<dGeomID> probes();

    dSpaceID space() const { return space_; }

private:
    struct Member
    {
        dGeomID geom;
        GeomKind kind;
    };

    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    dReal real(double low, double high) { return static_cast<dReal>(between(low, high)); }
    std::size_t any(std::size_t count) { return random_() % count; }

    void create();
    void create_room();
    void create_hills();
    void give_body(dGeomID geom);
    void set_velocity(dBodyID body);
    void place(dGeomID geom);
    void turn(dGeomID geom);
    void offset(dGeomID geom);
    void push(dGeomID geom);
    void lose_body(dGeomID geom);
    void destroy(std::size_t index);
    void resize(std::size_t index);
    dGeomID create_geom(GeomKind kind);
    Polyhedron polyhedron();
    void give_other_data(const Member &member);
    void change_in_place();
    void change_hills();
    void surprise();
    void keep_inside();
    static void compare(dGeomID one, dGeomID other, Truth &truth);

    Setting setting_;
    std::mt19937_64 random_;
    std::deque<MeshArrays> meshes_; // outlive the geoms
    std::deque<Hills> hills_;
    std::deque<ConvexArrays> convexes_;
    dWorldID world_;
    dSpaceID space_;
    dGeomID ball_, ray_;          // in no space
    std::vector<Member> members_; // the plane, room or hills first
};
} // namespace ode_predictive_space

#endif
