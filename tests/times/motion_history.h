// Random motions, and questions at random ticks: when do two geoms meet? The answer is compared with what happens later.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_TIMES_MOTION_HISTORY_H
#define ODE_PREDICTIVE_SPACE_TESTS_TIMES_MOTION_HISTORY_H

#include <cstdint>
#include <string>
#include <vector>

namespace ode_predictive_space
{
/// What histories had in them.
struct MotionTally
{
    long questions = 0;
    long unknown = 0;             ///< answers that said nothing, because less than three samples of a motion were there
    long needlessly_unknown = 0;  ///< the same, of motions that had lasted for longer
    long compared = 0;            ///< answers whose pair met later, on the same motions
    long late_after_a_change = 0; ///< before the third sample of a changed motion: nothing is promised
    std::vector<double> parts; ///< time that was answered over the time until the meeting, of those that were to meet
    std::vector<double> parts_of_apart; ///< the same, of those that were said to stay apart for some time
};

/// @param proximity one of the three tests.
/// @return what was wrong, or nothing.
std::string run_motion_history(std::uint64_t seed, int proximity, MotionTally &tally);
} // namespace ode_predictive_space

#endif
