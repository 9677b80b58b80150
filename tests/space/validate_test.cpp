#include <cstdio>

#include "ode_predictive_space/ode/internals.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
std::string address_of(dGeomID geom)
{
    char text[40];
    std::snprintf(text, sizeof text, "%p", static_cast<const void *>(geom));
    return text;
}

class Validate : public OdeTest
{
protected:
    Validate()
    {
        dGeomSetPosition(second, 1.9, 0, 0);
        dGeomSetPosition(apart, 10, 0, 0);
        // The space then predicts at once.
        dPredictiveSpaceGetEncounters(space, first, nullptr, 0);
        // After these ticks the pair rests.
        for (int i = 0; i < 100; ++i)
            EXPECT_EQ(collide(space).size(), 1u);
        EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
    }

    ~Validate() override { dSpaceDestroy(space); }

    std::string complaint()
    {
        int holds = 1;
        const std::string text = ode_complaint([&] { holds = dPredictiveSpaceValidate(space); });
        EXPECT_EQ(holds == 1, text.empty()) << text;
        return text;
    }

    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dGeomID first = dCreateSphere(space, 1);
    dGeomID second = dCreateSphere(space, 1);
    dGeomID apart = dCreateSphere(space, 1);
};

void expect_names(const std::string &complaint, std::initializer_list<dGeomID> named, dGeomID other)
{
    EXPECT_NE(complaint.find("dPredictiveSpaceValidate"), std::string::npos) << complaint;
    for (dGeomID geom : named)
        EXPECT_NE(complaint.find(address_of(geom)), std::string::npos) << address_of(geom) << ": " << complaint;
    EXPECT_EQ(complaint.find(address_of(other)), std::string::npos) << complaint;
}

TEST_F(Validate, NamesTheGeomThatIsOutsideItsEnvelope)
{
    for (int side = 0; side < 6; ++side)
    {
        const dReal out = side % 2 ? 1 : -1;
        apart->aabb[side] += out;
        const std::string said = complaint();
        EXPECT_NE(said.find("outside its envelope"), std::string::npos) << said;
        expect_names(said, {apart}, first);
        apart->aabb[side] -= out;
        EXPECT_EQ(complaint(), "");
    }
}

TEST_F(Validate, NamesBothGeomsOfAPairThatIsWrong)
{
    first->aabb[1] -= 0.5;
    const std::string said = complaint();
    EXPECT_NE(said.find("resting pair"), std::string::npos) << said;
    expect_names(said, {first, second}, apart);
    first->aabb[1] += 0.5;
    EXPECT_EQ(complaint(), "");
}

// ODE does not report that a geom is enabled. Once, the pair was missing until the next dSpaceCollide().
TEST_F(Validate, HoldsWhenAGeomHasJustBeenEnabled)
{
    dGeomDisable(first);
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(collide(space).empty());
    dGeomEnable(first);
    EXPECT_EQ(complaint(), "");
    EXPECT_EQ(collide(space).size(), 1u);
}
} // namespace
} // namespace ode_predictive_space
