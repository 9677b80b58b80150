#include "ode_predictive_space/haptics/safety.h"

#include "tests/haptics/support/allocation_count.h"

#include <gtest/gtest.h>
#include <string>

namespace ode_predictive_space::haptics
{
namespace
{
TEST(Notice, HoldsASentenceWithoutAllocating)
{
    const std::uint64_t before = allocation_count();
    const Notice notice(NoticeKind::guard, 1.5, "No force.");
    EXPECT_EQ(allocation_count(), before);
    EXPECT_EQ(notice.kind, NoticeKind::guard);
    EXPECT_EQ(notice.time, 1.5);
    EXPECT_EQ(notice.sentence(), "No force.");
}

TEST(Notice, CutsOffWhatIsTooLong)
{
    const std::string just_fits(239, 'a');
    EXPECT_EQ(Notice(NoticeKind::device, 0, just_fits).sentence(), just_fits);
    EXPECT_EQ(Notice(NoticeKind::device, 0, just_fits + "b").sentence(), just_fits);
    EXPECT_EQ(Notice(NoticeKind::device, 0, "").sentence(), "");
    EXPECT_EQ(Notice().sentence(), "");
}
} // namespace
} // namespace ode_predictive_space::haptics
