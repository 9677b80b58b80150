// A pair is postponed until its gap may have closed: until then its shapes are apart in spite of all motion and turning.

#include <limits>

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/near/shape_test.h"
#include "ode_predictive_space/broadphase/objects/measured_shapes.h"
#include "tests/shape/random_shapes.h"
#include "tests/support/effort.h"

namespace ode_predictive_space
{
namespace
{
constexpr CandidatePair the_pair{0, 1};

#ifdef ODE_PREDICTIVE_SPACE_LONG_TEST
constexpr unsigned seeds = 100000;
#else
constexpr unsigned seeds = of_cases(4000);
#endif

class TwoShapes : public Scene
{
public:
    TwoShapes()
    {
        proxies_.add();
        proxies_.add();
        shapes_.start(2);
    }

    ConvexShape now[2];
    double margin = 0;

    bool reported()
    {
        for (Place &place : proxies_.places)
            place.note_move(update_);
        ++update_;
        shapes_.update(*this, proxies_.members(), proxies_);
        if (shapes_.renewed(the_pair))
            cache_ = GapCache(Payer::none);
        shapes_.clear_renewed();
        const OverlapTest boxes{*this, proxies_.places.data(), false, Origin().doubt(), Float4::all(0)};
        ShapeTest test({*this, proxies_, shapes_}, boxes, margin, gap_checks_);
        if (test.postpones(the_pair, cache_))
            return false;
        return cache_.pause > 0 ? cache_.pause-- > 0 : test.check_gap(the_pair, cache_, budget_);
    }

    bool postponed() const { return shapes_.travel(the_pair) < cache_.due; }
    std::uint64_t gap_checks() const { return gap_checks_; }

    void follow(const ProxyId *ids, std::size_t count, ConvexShape *const *shapes, double *moves) override
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            ConvexShape &shape = *shapes[i];
            const ConvexShape &other = now[ids[i]];
            const bool same = shape.kind == other.kind && shape.kind != ShapeKind::half_space &&
                              shape.radius == other.radius && shape.half_sides == other.half_sides;
            moves[i] = same ? other.moved_from(shape) : std::numeric_limits<double>::infinity();
            shape = other;
        }
    }
    void measure(const ProxyId *, std::size_t, Place *, const Origin &) override {}
    void observe(const ProxyId *, std::size_t, Observation *, const Origin &) override {}
    Box bounds(ProxyId) override { return Box(Vector3::Constant(-1e6), Vector3::Constant(1e6)); }
    SampledPose pose(ProxyId) override { return {}; }
    bool overlap(ProxyId, ProxyId) override { return true; }
    void find_disabled(const ProxyId *, std::size_t, std::vector<ProxyId> &) override {}

private:
    ProxyStore proxies_;
    UpdateNumber update_ = 1;
    MeasuredShapes shapes_;
    GapCache cache_{Payer::none};
    GapBudget budget_;
    std::uint64_t gap_checks_ = 0;
};

TEST(Travel, MovesNoPointFartherThanItSays)
{
    ShapeMaker maker(1);
    for (int i = 0; i < 500000; ++i)
    {
        const SolidKind solid = solids[static_cast<std::size_t>(maker.between(0, 4.999))];
        const ConvexShape before = moved(maker.shape(solid), maker.rotation(), maker.vector());
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(maker.between(0, maker.one_in(2) ? 3 : 0.01), maker.direction()).toRotationMatrix();
        const ConvexShape after = moved(before, turn, maker.between(0, 0.1) * maker.vector());
        const Vector3 direction = maker.direction();
        const double change =
            direction.dot(after.centre - before.centre) + after.reach(direction) - before.reach(direction);
        ASSERT_LE(std::abs(change), after.moved_from(before) + 1e-13) << "shape " << i;
    }
}

// The travel of the capsule itself would be too small when it turns: a contact could be missed.
TEST(Travel, OfACapsuleBesideMeshesIsThatOfTheCylinderAroundIt)
{
    ShapeMaker maker(1);
    for (int i = 0; i < 100000; ++i)
    {
        ConvexShape capsule = maker.shape(SolidKind::capsule);
        capsule.blunt_beside = 1;
        capsule.blunt_margin = maker.between(0, 0.01);
        const ConvexShape before = moved(capsule, maker.rotation(), maker.vector());
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(maker.between(0, maker.one_in(2) ? 3 : 0.01), maker.direction()).toRotationMatrix();
        const ConvexShape after = moved(before, turn, Vector3::Zero());
        const Vector3 direction = maker.direction();
        const double change = after.blunt().reach(direction) - before.blunt().reach(direction);
        ASSERT_LE(std::abs(change), after.moved_from(before) + 1e-13) << "capsule " << i;
    }
}

TEST(Travel, ShapesOfPostponedPairsAreApart)
{
    long postponed = 0, touching = 0, steps = 0;
    std::uint64_t gap_checks = 0;
    for (unsigned seed = 0; seed < seeds; ++seed)
    {
        ShapeMaker maker(seed);
        TwoShapes pair;
        pair.margin = maker.one_in(2) ? 0 : 0.02;
        pair.now[0] = maker.shape(solids[static_cast<std::size_t>(maker.between(0, 5.999))]);
        pair.now[1] = moved(maker.shape(solids[static_cast<std::size_t>(maker.between(0, 4.999))]), maker.rotation(),
                            maker.between(0.3, 1.5) * maker.direction());
        const double speed = std::exp(maker.between(-8, -3)), spin = std::exp(maker.between(-8, -2));
        const bool far_away = maker.one_in(10);
        for (ConvexShape &shape : pair.now)
            shape.centre += far_away ? Vector3(1e6, -1e5, 0) : Vector3(0, 0, 0);
        for (int tick = 0; tick < 300; ++tick, ++steps)
        {
            for (ConvexShape &shape : pair.now)
            {
                const Eigen::Matrix3d turn =
                    Eigen::AngleAxisd(spin * maker.between(-1, 1), maker.direction()).toRotationMatrix();
                shape = moved(shape, turn, speed * maker.vector());
            }
            if (maker.one_in(100)) // comes back
                pair.now[1].centre = pair.now[0].centre + maker.vector();
            if (maker.one_in(200)) // resized
                pair.now[1] = scaled(pair.now[1], 1.2);
            const bool reported = pair.reported();
            const double distance = distance_from_above(pair.now[0], pair.now[1], 8);
            ASSERT_TRUE(reported || distance >= pair.margin - (far_away ? 1e-9 : 1e-13))
                << "seed " << seed << ", tick " << tick;
            postponed += pair.postponed();
            touching += distance < 1e-6;
        }
        gap_checks += pair.gap_checks();
    }
    EXPECT_GT(postponed, steps / 3);
    EXPECT_GT(touching, steps / 100);
    EXPECT_LT(gap_checks, static_cast<std::uint64_t>(steps) / 3) << "most ticks need no gap check";
}
} // namespace
} // namespace ode_predictive_space
