// Answers from single-precision places must never be wrong, whatever the numbers are.

#include "ode_predictive_space/broadphase/objects/place.h"

#include <cfenv>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
const Origin origin; // the program's own

constexpr Watch formulas[] = {Watch::sphere, Watch::capsule, Watch::box, Watch::cylinder};

double any_size(Random &random, double least, double most)
{
    return random.chance(0.5) ? random.uniform(0.1, 10) : std::pow(10, random.uniform(least, most));
}

// The sizes are limited so that the largest sum is still a float.
Object any_solid(Random &random)
{
    Object object;
    object.formula = formulas[random.index(std::size(formulas))];
    const double place = random.chance(0.2) ? 0 : any_size(random, -40, 36);
    const double size = any_size(random, -40, 36);
    object.centre = random.vector(place);
    object.half = size * (Vector3::Ones() + random.vector(0.999));
    if (object.formula != Watch::box)
        object.half.y() = object.half.x();
    if (object.formula == Watch::sphere)
        object.half.z() = object.half.x();
    if (random.chance(0.8))
    {
        const Vector3 axis = (random.vector(1) + Vector3(1e-3, 0, 0)).normalized();
        const Eigen::Matrix3d turned = Eigen::AngleAxisd(random.uniform(-3, 3), axis).toRotationMatrix();
        for (std::size_t i = 0; i < 12; ++i)
            object.rotation[i] =
                i % 4 < 3 ? turned(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) : nan;
    }
    return object;
}

Place placed(const Object &object)
{
    Place place;
    place.measure(solid_of(object), object.centre.data(), object.rotation.data(), origin);
    return place;
}

bool contains(const FloatBox &outer, const Box &inner)
{
    for (int axis = 0; axis < 3; ++axis)
        if (!(outer.low[axis] <= inner.min()[axis] && inner.max()[axis] <= outer.high[axis]))
            return false;
    return true;
}

// NaN overlaps everything, as in ODE's comparison.
bool overlap(const Box &one, const Box &other)
{
    for (int axis = 0; axis < 3; ++axis)
        if (one.min()[axis] > other.max()[axis] || one.max()[axis] < other.min()[axis])
            return false;
    return true;
}

TEST(Place, ATightBoxHoldsTheBoundingBox)
{
    Random random(1);
    for (int i = 0; i < 300000; ++i)
    {
        const Object object = any_solid(random);
        const Place place = placed(object);
        ASSERT_TRUE(is_finite(place.tight_lanes())) << i;
        ASSERT_TRUE(contains(place.tight(), bounds_of(object))) << i;
    }
}

TEST(Place, ATightBoxIsTight)
{
    Random random(2);
    for (int i = 0; i < 100000; ++i)
    {
        const Object object = any_solid(random);
        const FloatBox box = placed(object).tight();
        const Box exact = bounds_of(object);
        for (int axis = 0; axis < 3; ++axis)
        {
            const double size = std::abs(exact.min()[axis]) + std::abs(exact.max()[axis]);
            ASSERT_LE(exact.min()[axis] - box.low[axis], 2e-6 * size + 1e-37) << i;
            ASSERT_LE(box.high[axis] - exact.max()[axis], 2e-6 * size + 1e-37) << i;
        }
    }
}

// ODE in single precision rounds its boxes differently.
TEST(Place, ATightBoxHoldsWhatIsComputedInSinglePrecision)
{
    Random random(3);
    for (int i = 0; i < 300000; ++i)
    {
        const Object object = any_solid(random);
        if (object.formula == Watch::cylinder)
            continue; // then ODE measures it
        float position[3], rotation[12], side[3];
        for (int axis = 0; axis < 3; ++axis)
        {
            position[axis] = static_cast<float>(object.centre[axis]);
            side[axis] = 2 * static_cast<float>(object.half[axis]);
        }
        for (std::size_t k = 0; k < 12; ++k)
            rotation[k] = static_cast<float>(object.rotation[k]);
        Place place;
        ASSERT_TRUE(place.measure({object.formula, side[0] / 2, side[1] / 2, side[2] / 2}, position, rotation, origin));
        Box computed;
        for (int axis = 0; axis < 3; ++axis)
        {
            const float *row = rotation + 4 * axis;
            const float along_z = std::abs(row[2] * side[2]);
            const float reach = object.formula == Watch::sphere ? side[0] / 2
                                : object.formula == Watch::capsule
                                    ? along_z / 2 + side[0] / 2
                                    : 0.5f * (std::abs(row[0] * side[0]) + std::abs(row[1] * side[1]) + along_z);
            const float low = position[axis] - reach, high = position[axis] + reach;
            computed.min()[axis] = double{low};
            computed.max()[axis] = double{high};
        }
        ASSERT_TRUE(contains(place.tight(), computed)) << i;
    }
}

TEST(Place, NoFormulaHoldsForWhatIsNotFinite)
{
    for (double bad : {nan, infinity, -infinity, 1e39, -1e200})
        for (int axis = 0; axis < 3; ++axis)
            for (Watch formula : formulas)
            {
                Object object;
                object.formula = formula;
                object.centre[axis] = bad;
                EXPECT_EQ(placed(object).watch(), Watch::nothing) << bad;
            }
    Object object;
    object.formula = Watch::box;
    object.rotation[5] = nan;
    EXPECT_EQ(placed(object).watch(), Watch::nothing);
}

// A side that is NaN becomes infinite.
TEST(Place, TheBoxOfTheProgramIsHeldWhateverItIs)
{
    for (double bad : {nan, infinity, -infinity, 1e39, -1e39, 1e200, -1e200, 1e-300})
        for (int axis = 0; axis < 3; ++axis)
        {
            Box box(Vector3::Constant(-1), Vector3::Constant(1));
            box.max()[axis] = bad;
            Place place;
            place.set_tight(box);
            EXPECT_LE(place.tight().low[axis], -1);
            EXPECT_TRUE(std::isnan(bad) ? place.tight().high[axis] == float_infinity : place.tight().high[axis] >= bad);
        }
}

struct TwoBoxes
{
    Box boxes[2];
    Place places[2];

    explicit TwoBoxes(Random &random)
    {
        Object one = any_solid(random), other = any_solid(random);
        const Vector3 between = bounds_of(one).sizes() / 2 + bounds_of(other).sizes() / 2;
        const double size = random.chance(0.5) ? 1 : between.norm() + one.centre.norm();
        other.centre = one.centre + random.vector(1).cwiseProduct(between);
        const auto axis = static_cast<Eigen::Index>(random.index(3));
        const double sign = random.chance(0.5) ? 1 : -1, off = std::pow(10, random.uniform(-17, -3)) * size;
        if (random.chance(0.9))
            other.centre[axis] =
                one.centre[axis] + sign * (between[axis] + (random.chance(0.2) ? 0 : random.uniform(-1, 1) * off));
        take(0, one, random);
        take(1, other, random);
    }

private:
    void take(int k, const Object &object, Random &random)
    {
        constexpr double extremes[] = {nan, infinity, -infinity, 1e39, -1e39, 1e200, -1e200, 2e200};
        boxes[k] = bounds_of(object);
        if (random.chance(0.7))
        {
            places[k] = placed(object);
            return;
        }
        for (int axis = 0; axis < 3; ++axis)
        {
            if (random.chance(0.05))
                boxes[k].min()[axis] = extremes[random.index(8)];
            if (random.chance(0.05))
                boxes[k].max()[axis] = extremes[random.index(8)];
        }
        places[k].set_tight(boxes[k]);
    }
};

TEST(Place, IsNeverWrongAboutWhetherBoxesOverlap)
{
    Random random(4);
    int apart = 0, together = 0, unsure = 0;
    for (int i = 0; i < 1000000; ++i)
    {
        const TwoBoxes two(random);
        const bool overlapping = overlap(two.boxes[0], two.boxes[1]);
        const bool surely_not = surely_apart(two.places[0], two.places[1]);
        const bool surely = surely_overlap(two.places[0], two.places[1], origin.doubt());
        ASSERT_FALSE(surely_not && overlapping) << i;
        ASSERT_FALSE(surely && !overlapping) << i;
        ASSERT_EQ(surely_not, surely_apart(two.places[1], two.places[0]));
        ASSERT_FALSE(surely_overlap(two.places[1], two.places[0], origin.doubt()) && !overlapping) << i;
        apart += surely_not;
        together += surely;
        unsure += !surely && !surely_not;
    }
    EXPECT_GT(apart, 100000);
    EXPECT_GT(together, 100000);
    EXPECT_GT(unsure, 100000) << "the test is about what nearly touches";
}

// Sides that overflow single precision are equal there.
TEST(Place, IsNotSureOfBoxesThatAreFartherAwayThanSinglePrecisionReaches)
{
    for (double scale : {1.0, -1.0})
    {
        Place near, far, plane;
        near.set_tight(Box(Vector3::Constant(scale * 1e200 - 1e190), Vector3::Constant(scale * 1e200 + 1e190)));
        far.set_tight(Box(Vector3::Constant(scale * 3e200 - 1e190), Vector3::Constant(scale * 3e200 + 1e190)));
        EXPECT_FALSE(surely_overlap(near, far, origin.doubt()));
        EXPECT_FALSE(surely_apart(near, far));
        plane.set_tight(Box(Vector3::Constant(-infinity), Vector3::Constant(infinity)));
        EXPECT_TRUE(surely_overlap(plane, plane, origin.doubt())) << "infinity is not too far to tell";
    }
}

// The object was predicted by its sphere, and has met others since.
TEST(Place, ATightenedEnvelopeHoldsTheObjectAndIsNoLargerThanBefore)
{
    Random random(8);
    for (int i = 0; i < 100000; ++i)
    {
        Object object = any_solid(random);
        object.radius =
            (object.formula == Watch::capsule ? object.half.x() + object.half.z() : object.half.norm()) * (1 + 1e-9);
        const float radius = round_up(object.radius);
        const Float4 centre = Float4::nearest(object.centre.data());
        Place place = placed(object);
        const TightBox sphere = TightBox::around(centre, Float4::all(radius), origin.doubt());
        const bool has_slack = random.chance(0.5);
        const Float4 slack = Float4::all(has_slack ? 0.01f * radius : 0);
        place.set_envelope({sphere.low - slack, sphere.high + slack});
        const FloatBox before = place.envelope();
        place.tighten(radius);
        ASSERT_TRUE(contains(place.envelope(), bounds_of(object))) << i;
        ASSERT_TRUE(place.holds() || !has_slack) << i;
        ASSERT_TRUE(before.contains(place.envelope())) << i;
    }
}

// Every test of two places, with vectors whose fourth lanes hold other data.
[[gnu::noinline]] int asked(Place &one, const Place &other, const Object &object)
{
    int answers = 0;
    if (one.watches_centre())
        answers += static_cast<int>(one.follow_centre(Float4::nearest(object.centre.data())));
    else if (one.watches_solid())
        answers += static_cast<int>(one.follow(object.centre.data(), object.rotation.data(), origin));
    float depths[4];
    overlap_depths(one, other).store(depths);
    answers += one.holds() + one.is_boundless() + one.has_end() + surely_apart(one, other) +
               surely_overlap(one, other, origin.doubt()) + envelopes_apart(one, other) + (depths[0] > 0);
    return answers;
}

// Programs may trap invalid operations.
TEST(Place, NoUpdateNumberMakesAnOperationInvalid)
{
    Object object = ball({1, 2, 3}, 0.5, {0, 0, 0});
    const Box boxes[] = {bounds_of(object), Box(Vector3::Constant(-1), Vector3(1, 1, 1e200))}; // the second overflows
    constexpr Watch watches[] = {Watch::nothing, Watch::carried, Watch::centre,  Watch::sphere,
                                 Watch::capsule, Watch::box,     Watch::cylinder};
    Random random(8);
    std::vector<UpdateNumber> numbers = {0, 1, 0x3c00001, Place::last_update - 1, Place::last_update};
    for (int bit = 0; bit < 26; ++bit)
        numbers.push_back(Place::last_update & ~((UpdateNumber{1} << bit) - 1));
    for (int i = 0; i < 1000; ++i)
        numbers.push_back(static_cast<UpdateNumber>(random.bits()) & Place::last_update);
    for (UpdateNumber number : numbers)
        for (Watch watch : watches)
            for (const Box &box : boxes)
                for (bool counted : {false, true})
                {
                    object.formula = watch > Watch::centre ? watch : Watch::nothing;
                    Place place = placed(object), other = placed(ball({1, 2, 3}, 0.5, {0, 0, 0}));
                    place.set_envelope({Float4::all(-10), Float4::all(10)});
                    other.set_envelope({Float4::all(-10), Float4::all(10)});
                    place.set_tight(box);
                    const float centre[] = {1, 2, 3};
                    if (watch == Watch::centre)
                        place.watch_centre(centre, 0.5f, origin.doubt());
                    if (watch == Watch::carried)
                        place.watch_carried(centre, 0.5f, origin.doubt(), 1);
                    ASSERT_EQ(place.watch(), watch);
                    if (counted)
                        place.note_move(number);
                    else
                        place.note_doubtful_move(number);
                    ASSERT_EQ(place.moved(), number);
                    std::feclearexcept(FE_ALL_EXCEPT);
                    const int answers = asked(place, other, object) + asked(other, place, object);
                    ASSERT_EQ(std::fetestexcept(FE_INVALID | FE_DIVBYZERO), 0)
                        << number << ", " << static_cast<int>(watch) << ", " << answers;
                }
}
} // namespace
} // namespace ode_predictive_space
