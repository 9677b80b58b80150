#include "ode_predictive_space/broadphase/schedule/event_wheel.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
using Ids = std::vector<ProxyId>;

Ids sorted_ids(const std::vector<Event> &events)
{
    Ids ids;
    for (const Event &event : events)
        ids.push_back(event.first);
    std::sort(ids.begin(), ids.end());
    return ids;
}

// The wheel beside a map; the map counts ticks in 64 bits, so that it knows no wrap-around.
class CheckedWheel
{
public:
    explicit CheckedWheel(std::uint64_t now) { restart(now); }

    void restart(std::uint64_t now)
    {
        now_ = now;
        wheel_.restart(static_cast<Tick>(now));
        reference_.clear();
    }

    void schedule(std::uint64_t ticks)
    {
        const ProxyId id = next_id_++;
        wheel_.schedule(static_cast<Tick>(now_ + ticks), {id, id + 1, id + 2, id + 3});
        reference_.emplace(now_ + ticks, id);
    }

    void advance()
    {
        ++now_;
        due_.clear();
        wheel_.advance(static_cast<Tick>(now_), due_);
        Ids expected;
        const auto range = reference_.equal_range(now_);
        for (auto entry = range.first; entry != range.second; ++entry)
            expected.push_back(entry->second);
        std::sort(expected.begin(), expected.end());
        reference_.erase(range.first, range.second);
        ASSERT_EQ(sorted_ids(due_), expected) << "at tick " << now_;
        ASSERT_EQ(wheel_.size(), reference_.size());
        for (const Event &event : due_)
            ASSERT_TRUE(event.second == event.first + 1 && event.first_generation == event.first + 2 &&
                        event.second_generation == event.first + 3);
    }

    void purge(ProxyId divisor)
    {
        wheel_.purge([&](const Event &event) { return event.first % divisor != 0; });
        for (auto entry = reference_.begin(); entry != reference_.end();)
            entry = entry->second % divisor == 0 ? reference_.erase(entry) : std::next(entry);
        expect_all_there();
    }

    void expect_all_there() const
    {
        std::vector<Event> events;
        wheel_.for_each([&](const Event &event) { events.push_back(event); });
        Ids expected;
        for (const auto &[due, id] : reference_)
            expected.push_back(id);
        std::sort(expected.begin(), expected.end());
        ASSERT_EQ(sorted_ids(events), expected);
        ASSERT_EQ(wheel_.size(), expected.size());
    }

    std::size_t bytes() const { return wheel_.bytes(); }

private:
    EventWheel wheel_;
    std::multimap<std::uint64_t, ProxyId> reference_;
    std::vector<Event> due_;
    std::uint64_t now_ = 0;
    ProxyId next_id_ = 0;
};

constexpr std::uint64_t wrap = std::uint64_t{1} << 32;

// Delays from the next tick to several turns of the wheel, the edges of the turns of its fine and coarse buckets among them.
std::uint64_t random_delay(Random &random)
{
    switch (random.index(6))
    {
    case 0:
        return 1 + random.index(10);
    case 1:
        return 1 + random.index(1100);
    case 2:
        return 60 + random.index(10);
    case 3:
        return 4030 + random.index(70);
    case 4:
        return 4092 + random.index(10);
    default:
        return 1 + random.index(20000);
    }
}

TEST(EventWheel, GivesEachEventAtItsTickOverMillionsOfTicks)
{
    Random random(1);
    // The count of ticks wraps around after a million and a half of them.
    CheckedWheel wheel(wrap - 1500000);
    for (int tick = 0; tick < 3000000; ++tick)
    {
        for (std::size_t count = random.index(8) == 0 ? random.index(6) : 0; count > 0; --count)
            wheel.schedule(random_delay(random));
        ASSERT_NO_FATAL_FAILURE(wheel.advance());
        if (random.chance(2e-5))
        {
            ASSERT_NO_FATAL_FAILURE(wheel.purge(static_cast<ProxyId>(1 + random.index(5))));
        }
    }
}

TEST(EventWheel, KnowsEveryDelayAtEveryPhaseOfATurn)
{
    for (std::uint64_t start : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{500}, std::uint64_t{63},
                                std::uint64_t{64}, std::uint64_t{4095}, wrap - 1, wrap - 64, wrap - 4096, wrap - 4097})
    {
        CheckedWheel wheel(start);
        for (std::uint64_t ticks = 1; ticks < 9000; ++ticks)
            wheel.schedule(ticks);
        for (int tick = 0; tick < 9000; ++tick)
            ASSERT_NO_FATAL_FAILURE(wheel.advance());
    }
}

TEST(EventWheel, KeepsWhatLiesBeyondManyTurns)
{
    CheckedWheel wheel(wrap - 100000);
    wheel.schedule(200000);
    wheel.schedule(99999);
    wheel.schedule(100000);
    wheel.schedule(100001);
    for (int tick = 0; tick < 200001; ++tick)
        ASSERT_NO_FATAL_FAILURE(wheel.advance());
    wheel.expect_all_there();
}

TEST(EventWheel, TakesTheFarthestTickThereIs)
{
    EventWheel wheel;
    wheel.restart(10);
    wheel.schedule(10 + 0x7fffffffu, {1, no_proxy, 0, 0});
    std::vector<Event> due;
    for (Tick now = 11; now < 5000; ++now)
        wheel.advance(now, due);
    EXPECT_TRUE(due.empty());
    EXPECT_EQ(wheel.size(), 1u);
}

TEST(EventWheel, PurgedOfEverythingItIsEmpty)
{
    CheckedWheel wheel(7);
    for (std::uint64_t ticks = 1; ticks < 3000; ++ticks)
        wheel.schedule(ticks);
    wheel.expect_all_there();
    ASSERT_NO_FATAL_FAILURE(wheel.purge(1));
    for (int tick = 0; tick < 3000; ++tick)
        ASSERT_NO_FATAL_FAILURE(wheel.advance());
}

TEST(EventWheel, PurgeKeepsTheOrderOfWhatStays)
{
    EventWheel touched, untouched;
    for (EventWheel *wheel : {&touched, &untouched})
        for (ProxyId id = 0; id < 100; ++id)
            wheel->schedule(1 + id % 3, {id, no_proxy, 0, 0});
    touched.purge([](const Event &) { return true; });
    for (Tick now = 1; now < 4; ++now)
    {
        std::vector<Event> one, other;
        touched.advance(now, one);
        untouched.advance(now, other);
        ASSERT_EQ(one.size(), other.size());
        for (std::size_t i = 0; i < one.size(); ++i)
            EXPECT_EQ(one[i].first, other[i].first);
    }
}

TEST(EventWheel, RestartForgetsAndSetsTheClock)
{
    CheckedWheel wheel(0);
    wheel.schedule(5);
    wheel.schedule(5000);
    for (std::uint64_t now : {std::uint64_t{100}, std::uint64_t{12345}, wrap - 3})
    {
        wheel.restart(now);
        wheel.expect_all_there();
        for (std::uint64_t ticks : {1, 63, 64, 65, 4095, 4096, 4097})
            wheel.schedule(ticks);
        for (int tick = 0; tick < 4500; ++tick)
            ASSERT_NO_FATAL_FAILURE(wheel.advance());
        wheel.schedule(3);
    }
}

TEST(EventWheel, UsesTheMemoryOfPastEventsAgain)
{
    CheckedWheel wheel(0);
    auto run = [&](int ticks) {
        for (int tick = 0; tick < ticks; ++tick)
        {
            wheel.schedule(1 + static_cast<std::uint64_t>(tick) % 2000);
            wheel.advance();
        }
    };
    run(5000);
    const std::size_t before = wheel.bytes();
    run(50000);
    EXPECT_EQ(wheel.bytes(), before);
}
} // namespace
} // namespace ode_predictive_space
