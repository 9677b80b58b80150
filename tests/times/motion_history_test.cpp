// Random motions, and queries at random ticks for the time at which two geoms meet. Answers are compared with the later motion.

#include <algorithm>
#include <array>
#include <sstream>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/ode_test.h"
#include "tests/times/mover.h"

namespace ode_predictive_space
{
namespace
{
struct MotionTally
{
    long questions = 0;
    long needlessly_unknown = 0; ///< answers without a time on motions that had three samples
    long compared = 0;           ///< answers whose pair met later, on unchanged motions
    std::vector<double> parts;   ///< time of the answer over the time until the meeting, for pairs that were to meet
};

constexpr int needed = 3;

std::pair<dGeomID, dGeomID> in_order(dGeomID one, dGeomID other)
{
    return std::minmax(one, other);
}

class MotionHistory
{
public:
    MotionHistory(std::uint64_t seed, int proximity, MotionTally &tally)
        : random_(seed), proximity_(proximity), tally_(tally), step_(random_.chance(0.5) ? 0.001 : 1.0 / 60)
    {
        dWorldSetGravity(world_, 0, 0, random_.chance(0.5) ? -9.81 : 0);
        if (proximity != dPredictiveProximityBox)
            dPredictiveSpaceSetProximity(space_, proximity);
        if (random_.chance(0.5))
            dPredictiveSpaceSetHorizon(space_, 200, 2000);
        const std::size_t count = 2 + random_.index(4);
        for (std::size_t i = 0; i < count; ++i)
            movers_.emplace_back(random_, world_, space_, step_);
        asked_.resize(count, -1);
        // The marker moves at each tick, so that time passes; the others make the space predict before the first query.
        marker_ = dCreateSphere(space_, 1);
        for (int i = random_.chance(0.5) ? 0 : 20; i > 0; --i)
            dGeomSetPosition(dCreateSphere(space_, 1), 5000, 5.0 * i, 0);
        first_question_ = static_cast<int>(random_.index(20));
    }

    ~MotionHistory()
    {
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }
    MotionHistory(const MotionHistory &) = delete;
    MotionHistory &operator=(const MotionHistory &) = delete;

    std::string run()
    {
        constexpr int ticks = 220;
        for (tick_ = 0; tick_ < ticks && wrong_.empty(); ++tick_)
        {
            if (tick_ > 0)
                advance();
            if (random_.chance(0.3))
                ask();
            collide();
            judge();
            if (random_.chance(0.3))
                ask();
            met_.clear();
        }
        return wrong_;
    }

private:
    struct Question
    {
        std::size_t one, other;
        int tick, meets;
        double ticks;
        bool known; // both motions were seen at three ticks
    };

    void advance()
    {
        for (std::size_t i = 0; i < movers_.size(); ++i)
        {
            if (random_.chance(0.01))
            {
                movers_[i].change_motion(random_);
                forget_questions(i);
                asked_[i] = asked_[i] < 0 ? -1 : tick_;
            }
            movers_[i].advance();
        }
        random_.chance(0.5) ? dWorldStep(world_, step_) : dWorldQuickStep(world_, step_);
        dGeomSetPosition(marker_, 9000 + tick_, 0, 0);
    }

    void forget_questions(std::size_t mover)
    {
        questions_.erase(std::remove_if(questions_.begin(), questions_.end(),
                                        [&](const Question &q) { return q.one == mover || q.other == mover; }),
                         questions_.end());
    }

    // Number of ticks with samples of the motion since the first query about the geom, or since its last change.
    int samples(std::size_t mover)
    {
        if (asked_[mover] < 0)
            asked_[mover] = tick_;
        return tick_ - asked_[mover] + 1;
    }

    void ask()
    {
        if (tick_ < first_question_)
            return;
        const std::size_t one = random_.index(movers_.size()), other = random_.index(movers_.size());
        if (one == other || have_met(one, other))
            return;
        if (random_.chance(0.2))
            ask_for_encounters(one, other);
        dReal ticks = -1;
        const int meets =
            dPredictiveSpaceGetTimeOfProximity(space_, movers_[one].geom(), movers_[other].geom(), &ticks);
        const int seen = std::min(samples(one), samples(other));
        ++tally_.questions;
        tally_.needlessly_unknown += !meets && ticks == 0 && seen >= needed;
        if (!(ticks >= 0))
            wrong_ = "a time is negative or not a number";
        questions_.push_back({one, other, tick_, meets, ticks, seen >= needed});
    }

    void ask_for_encounters(std::size_t one, std::size_t other)
    {
        std::array<dPredictiveEncounter, 8> list;
        const int count = dPredictiveSpaceGetEncounters(space_, movers_[one].geom(), list.data(), 8);
        dReal ticks = -1;
        const int meets =
            dPredictiveSpaceGetTimeOfProximity(space_, movers_[one].geom(), movers_[other].geom(), &ticks);
        for (std::size_t i = 0; i < movers_.size(); ++i)
            samples(i);
        const auto end = list.begin() + count;
        const auto listed =
            std::find_if(list.begin(), end, [&](const auto &met) { return met.geom == movers_[other].geom(); });
        if ((listed != end) != (meets != 0) || (meets && listed->ticks != ticks))
            wrong_ = "the list of encounters says something else than the time of proximity";
    }

    void collide()
    {
        met_.clear();
        dSpaceCollide(space_, this, [](void *data, dGeomID one, dGeomID other) {
            auto &self = *static_cast<MotionHistory *>(data);
            dContactGeom contact;
            const bool meet =
                self.proximity_ != dPredictiveProximityShape || dCollide(one, other, 1, &contact, sizeof contact) > 0;
            if (meet)
                self.met_.push_back(in_order(one, other));
        });
    }

    bool have_met(std::size_t one, std::size_t other) const
    {
        return std::count(met_.begin(), met_.end(), in_order(movers_[one].geom(), movers_[other].geom())) > 0;
    }

    void judge()
    {
        std::vector<Question> left;
        for (const Question &question : questions_)
            if (have_met(question.one, question.other))
                compare(question);
            else
                left.push_back(question);
        questions_.swap(left);
    }

    void compare(const Question &question)
    {
        const double until = tick_ - question.tick;
        if (!question.known)
            return;
        ++tally_.compared;
        if (until > 0 && question.meets)
            tally_.parts.push_back(question.ticks / until);
        if (question.ticks <= until)
            return;
        std::ostringstream text;
        text << "asked at tick " << question.tick << ": answer " << question.meets << ", " << question.ticks
             << " ticks; they met " << until << " ticks later; classes " << dGeomGetClass(movers_[question.one].geom())
             << " and " << dGeomGetClass(movers_[question.other].geom()) << ", with body "
             << (dGeomGetBody(movers_[question.one].geom()) != nullptr) << " and "
             << (dGeomGetBody(movers_[question.other].geom()) != nullptr) << ", offset "
             << dGeomIsOffset(movers_[question.one].geom()) << " and " << dGeomIsOffset(movers_[question.other].geom());
        wrong_ = text.str();
    }

    Random random_;
    int proximity_;
    MotionTally &tally_;
    double step_;
    dWorldID world_ = dWorldCreate();
    dSpaceID space_ = dPredictiveSpaceCreate(nullptr);
    dGeomID marker_;
    std::vector<Mover> movers_;
    std::vector<int> asked_; // the tick of the first sample of each, or -1
    std::vector<Question> questions_;
    std::vector<std::pair<dGeomID, dGeomID>> met_;
    int first_question_, tick_ = 0;
    std::string wrong_;
};
double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return values.empty() ? 0 : *middle;
}

class MotionHistories : public ::testing::TestWithParam<int>
{};

TEST_P(MotionHistories, NoTimeIsLaterThanTheMeeting)
{
    const OdeMessages messages;
#ifdef ODE_PREDICTIVE_SPACE_LONG_TEST
    constexpr std::uint64_t histories = 60000;
#else
    constexpr std::uint64_t histories = 400;
#endif
    MotionTally tally;
    for (std::uint64_t seed = 1; seed <= histories; ++seed)
        ASSERT_EQ(MotionHistory(seed, GetParam(), tally).run(), "") << "seed " << seed;
    EXPECT_GT(tally.compared, tally.questions / 20);
    EXPECT_LT(tally.needlessly_unknown, tally.questions / 20);
    EXPECT_GT(median(tally.parts), 0.3);
}

std::string name_of(const ::testing::TestParamInfo<int> &info)
{
    static const char *const names[] = {"by_box", "by_sphere", "by_shape"};
    return names[info.param];
}

INSTANTIATE_TEST_SUITE_P(Each, MotionHistories,
                         ::testing::Values(dPredictiveProximityBox, dPredictiveProximitySphere,
                                           dPredictiveProximityShape),
                         name_of);
} // namespace
} // namespace ode_predictive_space
