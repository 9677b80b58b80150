// An HTML page with plots of a run. It needs no network and no script: the plots are SVG.

#ifndef ODE_PREDICTIVE_SPACE_RECORDING_PAGE_H
#define ODE_PREDICTIVE_SPACE_RECORDING_PAGE_H

#include <string>
#include <vector>

namespace ode_predictive_space::recording
{
struct Point
{
    double x;
    double y;
};

/// A point that is not finite is left out, and with a logarithmic axis also one that is not above 0.
struct Curve
{
    enum class Style
    {
        line,
        dots
    };

    std::string name;
    std::vector<Point> points;
    Style style = Style::line;
};

struct Plot
{
    std::string title;
    std::string x_label; ///< with the unit
    std::string y_label; ///< with the unit
    std::vector<Curve> curves;
    bool logarithmic = false; ///< the y axis
};

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

/// Leaves out curves and plots without points.
std::string html(const Page &page);

/// Makes the folder unless it exists. @throws std::runtime_error when the page cannot be written there.
void prepare_folder(const std::string &folder);

/// Writes `index.html` completely, or leaves an earlier one as it is. @return the file's path. @throws std::runtime_error
std::string write_page(const std::string &folder, const Page &page);
} // namespace ode_predictive_space::recording

#endif
