// An ODE that the plugin was not built for is refused with a message that gives the reason. The file is compiled three times,
// each time with one property of ODE replaced; definitions of a program come before those of a library. Each program has one
// test, because the plugin checks its ODE only once.

#include <dlfcn.h>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/ode_test.h"

#if defined(MISFIT_PRECISION)
#define MISFIT_CASE PrecisionIsRefused
extern "C" __attribute__((visibility("default"))) int dCheckConfiguration(const char *)
{
    return 0;
}
#elif defined(MISFIT_LAYOUT)
#define MISFIT_CASE LayoutIsRefused
// The category bits seem to be in another place of a geom.
extern "C" __attribute__((visibility("default"))) void dGeomSetCategoryBits(dGeomID geom, unsigned long bits)
{
    dGeomSetCollideBits(geom, bits);
}
#else
#define MISFIT_CASE SecondCopyIsRefused
#endif

namespace ode_predictive_space
{
namespace
{
using Misfit = OdeTest;

TEST_F(Misfit, MISFIT_CASE)
{
#ifdef MISFIT_SECOND_COPY
    ASSERT_NE(dlopen(MISFIT_SECOND_COPY, RTLD_NOW | RTLD_LOCAL), nullptr) << dlerror();
    const char *const reason = "more than one copy";
#elif defined(MISFIT_PRECISION)
    const char *const reason = "precision";
#else
    const char *const reason = "another memory layout";
#endif
    dSpaceID parent = dSimpleSpaceCreate(nullptr);
    for (dSpaceID each : {dSpaceID(nullptr), parent})
    {
        dSpaceID made = parent;
        const std::string complaint = ode_complaint([&] { made = dPredictiveSpaceCreate(each); });
        EXPECT_EQ(made, nullptr);
        EXPECT_NE(complaint.find("dPredictiveSpaceCreate"), std::string::npos) << complaint;
        EXPECT_NE(complaint.find(reason), std::string::npos) << complaint;
    }
    EXPECT_EQ(dSpaceGetNumGeoms(parent), 0);
    EXPECT_EQ(dSpaceIsPredictive(parent), 0);
    dSpaceDestroy(parent);
}
} // namespace
} // namespace ode_predictive_space
