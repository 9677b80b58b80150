#ifndef ODE_PREDICTIVE_SPACE_RECORDING_PLOT_H
#define ODE_PREDICTIVE_SPACE_RECORDING_PLOT_H

#include <string>
#include <vector>

namespace ode_predictive_space::recording
{
struct Point
{
    double x;
    double y;
};

/// What is not a finite number has no place in a plot and is left out; with a logarithmic axis, so is what is not above 0.
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

} // namespace ode_predictive_space::recording

#endif
