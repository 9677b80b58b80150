// Ten minutes of scrubbing over each of three meshes as rough as scans.

#include "tests/haptics/contact/scrubbing.h"

namespace ode_predictive_space::haptics
{
namespace
{
TEST(LongScrubbingTest, KeepsTheBudgetInEachTick)
{
    for (const int rings : {112, 320, 570}) // 50,000 to 1.3 million triangles
        expect_budget_kept(rings, 200000);
}
} // namespace
} // namespace ode_predictive_space::haptics
