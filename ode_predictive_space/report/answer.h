// The part of a page that comes first and answers a question: a sentence, a table, plots.

#ifndef ODE_PREDICTIVE_SPACE_REPORT_ANSWER_H
#define ODE_PREDICTIVE_SPACE_REPORT_ANSWER_H

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
} // namespace ode_predictive_space::report

#endif
