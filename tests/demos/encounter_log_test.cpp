#include "demos/haptic/encounter_log.h"

#include "tests/haptics/support/probe_world.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::demo
{
using namespace haptics;

namespace
{
class EncounterLogTest : public testing::Test
{
protected:
    std::vector<Touch> touching() const
    {
        Touch touch;
        touch.object = object_of(geom_);
        return {touch};
    }

    const OdeUse ode_;
    dGeomID geom_ = dCreateSphere(nullptr, 1);
    EncounterLog log_;

    ~EncounterLogTest() override { dGeomDestroy(geom_); }
};

TEST_F(EncounterLogTest, ComparesTheForecastWithTheContact)
{
    log_.add(1.0, {}, {});
    log_.add(2.0, {{geom_, 3.5}}, {});
    log_.add(3.0, {{geom_, 2.0}}, {}); // near at 5
    log_.add(5.0, {{geom_, 0.0}}, {});
    log_.add(6.0, {{geom_, 0.0}}, touching());
    log_.add(7.0, {{geom_, 0.0}}, touching());
    ASSERT_EQ(log_.contacts().size(), 1U) << "first contacts only";
    EXPECT_EQ(log_.contacts()[0].time, 6);
    EXPECT_EQ(log_.contacts()[0].warning, 4);
    EXPECT_EQ(log_.contacts()[0].forecast, 5);
    const EncounterSummary summary = log_.summary();
    EXPECT_EQ(summary.predicted, 1U);
    EXPECT_EQ(summary.late, 0U);
    EXPECT_EQ(summary.missed, 0U);
    EXPECT_EQ(summary.mean_early, 1);
}

TEST_F(EncounterLogTest, AContactBeforeItsForecastIsLate)
{
    log_.add(1.0, {{geom_, 5.0}}, {});
    log_.add(2.0, {{geom_, 0.0}}, touching());
    EXPECT_EQ(log_.summary().late, 1U);
    EXPECT_EQ(log_.summary().missed, 0U);
}

TEST_F(EncounterLogTest, AContactOfWhatIsNotNearIsMissed)
{
    log_.add(1.0, {}, touching());
    EXPECT_EQ(log_.summary().missed, 1U);
    EXPECT_EQ(log_.summary().predicted, 0U);
    log_.add(2.0, {}, {});
    log_.add(3.0, {{geom_, 1.0}}, touching());
    EXPECT_EQ(log_.summary().missed, 2U);
}
} // namespace
} // namespace ode_predictive_space::demo
