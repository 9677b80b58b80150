// What a program would gain, in one sentence.

#ifndef ODE_PREDICTIVE_SPACE_REPLAY_ADVICE_H
#define ODE_PREDICTIVE_SPACE_REPLAY_ADVICE_H

#include <cstddef>
#include <string>

namespace ode_predictive_space::replay
{
/// Times in microseconds per event: of the collide or question and of the notices before it.
struct Findings
{
    std::size_t events = 0;
    std::string own_name;       ///< of the program's own kind of space: "hash"
    bool own_is_simple = false; ///< the launcher replaces simple spaces only with --space simple
    double own = 0, box = 0, shape = 0;
    double callbacks = 0;   ///< by boxes, per event
    double spared = 0;      ///< of these, those that spaces by shape do not call
    double spared_time = 0; ///< what dCollide() takes to find nothing in these, per event
};

enum class Advice
{
    unknown, ///< too little is recorded
    leave,
    use,
    use_by_shape
};

Advice advice_for(const Findings &findings);

/// The sentence, with the figures that it rests on.
std::string sentence_for(const Findings &findings);
} // namespace ode_predictive_space::replay

#endif
