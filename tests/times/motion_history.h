// Random motions, and queries at random ticks for the time at which two geoms meet. Answers are compared with the later motion.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_TIMES_MOTION_HISTORY_H
#define ODE_PREDICTIVE_SPACE_TESTS_TIMES_MOTION_HISTORY_H

#include <cstdint>
#include <string>
#include <vector>

namespace ode_predictive_space
{
struct MotionTally
{
    long questions = 0;
    long unknown = 0;             ///< answers without a time, as a motion had less than three samples
    long needlessly_unknown = 0;  ///< likewise, for motions that had lasted longer
    long compared = 0;            ///< answers whose pair met later, on unchanged motions
    long late_after_a_change = 0; ///< late answers before the third sample of a changed motion, which are allowed
    std::vector<double> parts;    ///< time of the answer over the time until the meeting, for pairs that were to meet
    std::vector<double> parts_of_apart; ///< likewise, for pairs that were to stay apart for some time
};

/// @param proximity one of the three tests. @return what is wrong, or an empty text.
std::string run_motion_history(std::uint64_t seed, int proximity, MotionTally &tally);
} // namespace ode_predictive_space

#endif
