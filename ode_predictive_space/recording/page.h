// One HTML page with plots of a run. It needs no network and no script: the plots are drawn in it as SVG.

#ifndef ODE_PREDICTIVE_SPACE_RECORDING_PAGE_H
#define ODE_PREDICTIVE_SPACE_RECORDING_PAGE_H

#include <string>
#include <vector>

#include "ode_predictive_space/recording/plot.h"

namespace ode_predictive_space::recording
{
/// The part of a page that comes first and answers a question.
struct Answer
{
    std::string sentence;                        ///< empty: there is no answer
    std::vector<std::vector<std::string>> table; ///< the first row is the head
    std::vector<std::string> notes;
    std::vector<Plot> plots;
};

struct Page
{
    std::string title;
    std::string text; ///< shown as it is, with its lines
    std::vector<Plot> plots;
    Answer answer = {}; ///< comes first, with its table and its plots
};

/// The page as text. Curves and plots without points are left out.
std::string html(const Page &page);

/// Makes the folder unless it exists, and checks that the page can be written there.
///
/// @throws std::runtime_error when it cannot.
void prepare_folder(const std::string &folder);

/// Writes `index.html` into the folder. A page that cannot be written to its end is removed, and an earlier one remains.
///
/// @return the file's path.
/// @throws std::runtime_error when it cannot.
std::string write_page(const std::string &folder, const Page &page);
} // namespace ode_predictive_space::recording

#endif
