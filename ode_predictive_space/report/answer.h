// The part of a page that comes first and answers a question: a sentence, a table, plots. One program may write it for another.

#ifndef ODE_PREDICTIVE_SPACE_REPORT_ANSWER_H
#define ODE_PREDICTIVE_SPACE_REPORT_ANSWER_H

#include <optional>
#include <string>
#include <vector>

#include "ode_predictive_space/report/plot.h"

namespace ode_predictive_space::report
{
struct Answer
{
    std::string sentence;                        ///< empty: there is no answer
    std::vector<std::vector<std::string>> table; ///< the first row is the head
    std::vector<std::string> notes;
    std::vector<Plot> plots;
};

/// Lines of fields, with tabs between them.
std::string lines_of(const Answer &answer);

/// What lines_of() wrote; none when it is not whole.
std::optional<Answer> answer_of(const std::string &lines);
} // namespace ode_predictive_space::report

#endif
