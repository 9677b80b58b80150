// Random histories of contacts, each with a theme: no contact is without a callback. The fuzzer starts with such histories.

#include <array>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fuzz/contact_history.h"

namespace ode_predictive_space
{
namespace
{
using Action = ContactAction;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t by_sphere = 0, by_shape = 1, large_deviation = 4, largest_deviation = 6, asking = 8;
constexpr std::uint8_t body = 16, coherent = 32;

struct Theme
{
    const char *name;
    std::vector<std::uint8_t> settings; ///< one of these is chosen
    std::vector<int> classes;           ///< classes of the geoms
    std::uint8_t made;                  ///< bits that are set in the number of each geom
    std::uint8_t thinnest, longest;     ///< range of the bytes for sides
    std::uint8_t least, most;           ///< range of the bytes for small parts
    std::vector<Action> actions;        ///< in addition to placing geoms beside each other
};

void PrintTo(const Theme &theme, std::ostream *stream)
{
    *stream << theme.name;
}

const std::vector<int> all_classes{dSphereClass, dBoxClass,    dCapsuleClass,       dCylinderClass, dPlaneClass,
                                   dRayClass,    dConvexClass, dGeomTransformClass, dTriMeshClass,  dHeightfieldClass};

std::vector<Action> all_actions()
{
    std::vector<Action> actions;
    for (int action = 0; action <= static_cast<int>(Action::last); ++action)
        actions.push_back(static_cast<Action>(action));
    return actions;
}

class HistoryMaker
{
public:
    HistoryMaker(const Theme &theme, unsigned seed) : theme_(theme), random_(seed) {}

    Bytes make()
    {
        bytes_.push_back(any_of(theme_.settings));
        for (std::uint8_t slot = 0; slot < slot_count / 2; ++slot)
            append(Action::make, slot, static_cast<std::uint8_t>(any_of(theme_.classes)));
        constexpr int operations = 40;
        for (int i = 0; i < operations; ++i)
        {
            if (random_() % 2 == 0)
            {
                append(Action::place_beside, slot(), slot());
                append(any_of(theme_.actions), last(subject_at), last(object_at));
            }
            else
                append(any_of(theme_.actions), slot(), slot());
        }
        return bytes_;
    }

private:
    template <typename Item> Item any_of(const std::vector<Item> &items) { return items[random_() % items.size()]; }
    std::uint8_t any() { return static_cast<std::uint8_t>(random_() % 256); }
    std::uint8_t slot() { return static_cast<std::uint8_t>(random_() % (slot_count / 2)); }
    std::uint8_t between(std::uint8_t low, std::uint8_t high)
    {
        return static_cast<std::uint8_t>(low + random_() % (high - low + 1u));
    }

    static constexpr std::size_t subject_at = 1, object_at = 2;
    std::uint8_t last(std::size_t at) const { return bytes_[bytes_.size() - bytes_per_contact_operation + at]; }

    void append(Action action, std::uint8_t subject, std::uint8_t object)
    {
        const bool form = action == Action::make || action == Action::resize || action == Action::rebuild_in_place;
        const bool makes = action == Action::make;
        bytes_.push_back(static_cast<std::uint8_t>(action));
        bytes_.push_back(subject);
        bytes_.push_back(object);
        bytes_.push_back(makes ? static_cast<std::uint8_t>((any() & ~body & ~coherent) | theme_.made) : any());
        bytes_.push_back(form ? between(theme_.thinnest, theme_.longest) : between(theme_.least, theme_.most));
        for (int i = 0; i < 3; ++i)
            bytes_.push_back(form ? between(theme_.thinnest, theme_.longest) : any());
    }

    const Theme &theme_;
    std::mt19937 random_;
    Bytes bytes_;
};

class ContactHistories : public ::testing::TestWithParam<Theme>
{};

TEST_P(ContactHistories, EachContactHasACallback)
{
    static const bool ready = dInitODE2(0) != 0;
    ASSERT_TRUE(ready);
#ifdef ODE_PREDICTIVE_SPACE_LONG_TEST
    constexpr unsigned histories = 20000;
#else
    constexpr unsigned histories = 150;
#endif
    ContactTally tally;
    for (unsigned seed = 1; seed <= histories; ++seed)
    {
        const Bytes bytes = HistoryMaker(GetParam(), seed).make();
        ASSERT_EQ(run_contact_history(bytes.data(), bytes.size(), tally), "")
            << "seed " << seed << ", shrunk:\n"
            << report_of_contact_history(bytes.data(), bytes.size());
    }
    std::cout << tally.ticks << " ticks, " << tally.overlapping << " pairs, " << tally.contacts << " contacts, "
              << tally.left_out << " left out, " << tally.forecasts << " forecasts, " << tally.classes.size()
              << " pairs of classes\n";
    EXPECT_GT(tally.contacts, tally.ticks / 20);
    EXPECT_GT(tally.left_out, tally.ticks / 100);
    if (GetParam().name == std::string("wobbling_bodies"))
    {
        EXPECT_GT(tally.forecasts, tally.ticks / 100);
    }
}

const Theme themes[] = {
    {"any",
     {by_sphere, by_shape, by_shape | large_deviation, by_shape | asking},
     all_classes,
     0,
     0,
     255,
     0,
     255,
     all_actions()},
    {"thin",
     {by_shape, by_shape | largest_deviation},
     {dBoxClass, dTriMeshClass},
     0,
     0,
     200,
     0,
     120,
     {Action::creep, Action::spin, Action::turn}},
    {"blunt",
     {by_shape | largest_deviation},
     {dCapsuleClass, dCapsuleClass, dTriMeshClass},
     0,
     60,
     130,
     150,
     245,
     {Action::creep, Action::spin, Action::turn}},
    {"coherent",
     {by_shape},
     {dCapsuleClass, dTriMeshClass},
     coherent,
     40,
     130,
     60,
     255,
     {Action::resize, Action::resize, Action::creep, Action::place_beside}},
    {"skewed", {by_sphere, by_shape}, all_classes, 0, 100, 200, 60, 255, {Action::skew, Action::creep, Action::place}},
    {"skewed_bodies",
     {by_sphere, by_shape},
     all_classes,
     body,
     100,
     200,
     60,
     255,
     {Action::skew, Action::creep, Action::place_beside}},
    {"bodies",
     {by_sphere, by_shape, by_shape | asking},
     all_classes,
     body,
     100,
     200,
     60,
     255,
     {Action::drive, Action::steps, Action::offset, Action::release, Action::skew}},
    {"hills",
     {by_sphere, by_shape, by_shape | asking},
     {dHeightfieldClass, dSphereClass, dBoxClass, dCapsuleClass, dCylinderClass, dConvexClass, dTriMeshClass},
     0,
     100,
     200,
     60,
     255,
     {Action::creep, Action::turn, Action::resize, Action::place_beside}},
    {"data",
     {by_shape, by_shape | large_deviation},
     {dSphereClass, dBoxClass, dConvexClass, dTriMeshClass},
     0,
     100,
     200,
     60,
     255,
     {Action::resize, Action::change_in_place, Action::rebuild_in_place, Action::creep}},
    {"breathing",
     {by_shape | large_deviation, by_shape | largest_deviation},
     {dSphereClass, dBoxClass, dTriMeshClass},
     0,
     100,
     180,
     200,
     250,
     {Action::breathe, Action::creep}},
    {"wobbling",
     {by_sphere | large_deviation | asking, by_shape | large_deviation | asking},
     {dSphereClass, dSphereClass, dBoxClass},
     0,
     130,
     180,
     140,
     147,
     {Action::wobble}},
    // The forecast of a geom without a body extrapolates its motion; that of a resting body stays in place.
    {"wobbling_bodies",
     {by_sphere | large_deviation | asking, by_shape | large_deviation | asking},
     {dSphereClass, dSphereClass, dBoxClass},
     body,
     130,
     180,
     140,
     147,
     {Action::wobble}},
};

INSTANTIATE_TEST_SUITE_P(Each, ContactHistories, ::testing::ValuesIn(themes),
                         [](const ::testing::TestParamInfo<Theme> &info) { return info.param.name; });
} // namespace
} // namespace ode_predictive_space
