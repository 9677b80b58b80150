// An ODE that the plugin was not built for: refused with a message that says why.
//
// Compiled three times, each time with one thing about ODE replaced; what a program defines itself comes before what a
// library does. One test to a program, because the plugin looks at its ODE only once.

#include <dlfcn.h>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/ode_test.h"

// The test's own name, so that the three have different ones.
#if defined(MISFIT_PRECISION)
#define MISFIT_CASE PrecisionIsRefused
extern "C" __attribute__((visibility("default"))) int dCheckConfiguration(const char *)
{
    return 0;
}
#elif defined(MISFIT_LAYOUT)
#define MISFIT_CASE LayoutIsRefused
// As if the category bits were kept elsewhere in a geom.
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
    const char *const reason = "laid out otherwise";
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
