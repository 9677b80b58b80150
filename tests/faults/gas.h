// A scene for tests of exceptions: it can be made again for each fault, and checks that reports are exact.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_FAULTS_GAS_H
#define ODE_PREDICTIVE_SPACE_TESTS_FAULTS_GAS_H

#include <algorithm>
#include <cstdint>
#include <vector>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
enum class Matter
{
    plain,  ///< spheres and boxes
    shapes, ///< also convexes and meshes
    user    ///< also geoms of a user class, whose functions can throw (UserClass)
};

/// A class of geoms, cubes with edges of 0.6, whose functions throw on request.
class UserClass
{
public:
    struct Thrown
    {};

    static dGeomID create(dSpaceID space);

    /// During its lifetime, one call of the functions throws, after `spared` others.
    class Fault
    {
    public:
        explicit Fault(long spared) { spared_ = spared; }
        ~Fault() { spared_ = -1; }
        Fault(const Fault &) = delete;
        Fault &operator=(const Fault &) = delete;
        bool struck() const { return spared_ < 0; }
    };

private:
    static void count_call();
    static void bounds(dGeomID geom, dReal aabb[6]);
    static int overlaps(dGeomID geom, dGeomID other, dReal aabb[6]);

    static inline long spared_ = -1; // calls before the one that throws; negative: none throws
};

class Gas
{
public:
    explicit Gas(int count, Matter matter = Matter::plain, int proximity = dPredictiveProximityBox)
        : space_(dPredictiveSpaceCreate(nullptr)), matter_(matter), leaves_out_(proximity != dPredictiveProximityBox)
    {
        dPredictiveSpaceSetProximity(space_, proximity);
        bodies_.reserve(2 * static_cast<std::size_t>(count)); // the test itself must not fail to allocate
        for (int i = 0; i < count; ++i)
            add();
    }
    ~Gas() { dSpaceDestroy(space_); }
    Gas(const Gas &) = delete;
    Gas &operator=(const Gas &) = delete;

    dSpaceID space() const { return space_; }
    dGeomID geom(std::size_t i) const { return bodies_[i].geom; }

    void add()
    {
        const dReal x = shift_ + place(), y = place(), z = place();
        dGeomID geom = create();
        dGeomSetPosition(geom, x, y, z);
        number_geom(geom, next_number_++);
        const dReal slow = 0.02;
        bodies_.push_back({geom, {slow * number(), slow * number(), slow * number()}});
    }

    void remove(std::size_t i)
    {
        dGeomDestroy(bodies_[i].geom);
        bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(i));
    }

    void move()
    {
        for (std::size_t i = 0; i < bodies_.size(); i += 2)
        {
            const dReal *position = dGeomGetPosition(bodies_[i].geom), *velocity = bodies_[i].velocity;
            dGeomSetPosition(bodies_[i].geom, position[0] + velocity[0], position[1] + velocity[1],
                             position[2] + velocity[2]);
        }
    }

    /// Moves everything, also what is added later, by this distance along x.
    void shift(dReal distance)
    {
        shift_ += distance;
        for (const Body &body : bodies_)
        {
            const dReal *position = dGeomGetPosition(body.geom);
            dGeomSetPosition(body.geom, position[0] + distance, position[1], position[2]);
        }
    }

    void explode()
    {
        for (Body &body : bodies_)
            for (dReal &velocity : body.velocity)
                velocity = 0.3 * number();
        move();
        for (std::size_t i = 0; i < bodies_.size(); i += 3)
            dGeomSetPosition(bodies_[i].geom, shift_ + place(), place(), place());
    }

    void run(int ticks)
    {
        for (int i = 0; i < ticks; ++i)
        {
            move();
            collide(space_);
        }
    }

    void expect_exact_answer() const
    {
        dGeomID probe = number_geom(dCreateSphere(nullptr, 2), -1);
        dGeomSetPosition(probe, shift_ + REAL(2.5), 0, 0); // outside the region in which geoms are made
        Pairs expected;
        for (const Body &body : bodies_)
            if (overlap(probe, body.geom))
                expected.push_back({-1, geom_number(body.geom)});
        const Pairs reported = unordered(collide2(probe, as_geom(space_)));
        if (leaves_out_)
            EXPECT_LE(reported.size(), expected.size());
        else
            EXPECT_EQ(reported, unordered(expected));
        dGeomDestroy(probe);
    }

    void expect_exact_for(int ticks)
    {
        for (int i = 0; i < ticks; ++i)
        {
            const Pairs reported = unordered(collide(space_));
            expect_right(reported);
            EXPECT_EQ(dPredictiveSpaceValidate(space_), 1);
            if (HasFailure())
                return;
            move();
        }
    }

private:
    dGeomID create()
    {
        if (matter_ == Matter::user && next_number_ % 3 == 0)
            return UserClass::create(space_);
        if (matter_ == Matter::shapes && next_number_ % 3 == 0)
            return create_geom(next_number_ % 2 ? GeomKind::convex : GeomKind::trimesh, 0.3, space_);
        return next_number_ % 2 ? dCreateSphere(space_, 0.4) : dCreateBox(space_, 0.6, 0.6, 0.6);
    }

    struct Body
    {
        dGeomID geom;
        dReal velocity[3];
    };

    // With the sphere and shape tests, pairs without contacts may be left out; dPredictiveSpaceValidate() checks for contacts.
    void expect_right(const Pairs &reported) const
    {
        const Pairs expected = overlapping();
        if (leaves_out_)
            EXPECT_TRUE(std::includes(expected.begin(), expected.end(), reported.begin(), reported.end()));
        else
            EXPECT_EQ(reported, expected);
    }

    static bool HasFailure() { return ::testing::Test::HasFailure(); }

    Pairs overlapping() const
    {
        Pairs pairs;
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            for (std::size_t j = i + 1; j < bodies_.size(); ++j)
                if (overlap(bodies_[i].geom, bodies_[j].geom))
                    pairs.push_back({geom_number(bodies_[i].geom), geom_number(bodies_[j].geom)});
        return unordered(pairs);
    }

    static bool overlap(dGeomID one, dGeomID other)
    {
        dReal a[6], b[6];
        dGeomGetAABB(one, a);
        dGeomGetAABB(other, b);
        return a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3] && a[4] <= b[5] && b[4] <= a[5];
    }

    dReal number()
    {
        state_ = state_ * 1664525u + 1013904223u;
        return static_cast<dReal>(state_ >> 8) / (1u << 23) - 1;
    }
    dReal place() { return 4 * number(); }

    dSpaceID space_;
    Matter matter_;
    bool leaves_out_;
    std::vector<Body> bodies_;
    dReal shift_ = 0;
    int next_number_ = 0;
    std::uint32_t state_ = 1;
};
} // namespace ode_predictive_space

#endif
