#include "ode_predictive_space/broadphase/verify/notice_board.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
std::set<ProxyId> drain(NoticeBoard &board, std::size_t room)
{
    IdSet set;
    set.resize(room);
    board.drain_into(set);
    std::set<ProxyId> found;
    set.for_each([&](ProxyId id) { found.insert(id); });
    return found;
}

TEST(NoticeBoard, GivesEachNoteOnce)
{
    Random random(1);
    NoticeBoard board;
    std::set<ProxyId> noted;
    std::size_t room = 0;
    for (int step = 0; step < 20000; ++step)
    {
        if (room == 0 || random.chance(0.01))
            board.resize(room += 1 + random.index(70));
        const ProxyId id = static_cast<ProxyId>(random.index(room));
        if (random.chance(0.9))
        {
            board.note(id);
            noted.insert(id);
        }
        else
        {
            board.erase(id);
            noted.erase(id);
        }
        if (random.chance(0.02))
        {
            ASSERT_EQ(drain(board, room), noted) << room;
            noted.clear();
            ASSERT_EQ(drain(board, room), noted) << "each note is given once";
        }
    }
}

TEST(NoticeBoard, KeepsWhatIsInTheSet)
{
    IdSet set;
    set.resize(130);
    NoticeBoard board;
    board.resize(130);
    set.insert(1);
    board.note(0);
    board.note(129);
    board.drain_into(set);
    EXPECT_EQ(set.size(), 3u);
    EXPECT_TRUE(set.contains(0) && set.contains(1) && set.contains(129));
}
} // namespace
} // namespace ode_predictive_space
