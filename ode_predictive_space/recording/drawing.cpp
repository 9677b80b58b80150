#include "ode_predictive_space/recording/drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

#include "ode_predictive_space/recording/printable.h"

namespace ode_predictive_space::recording
{
namespace
{
constexpr double width = 820, height = 300; // pixels
constexpr double left = 70, right = 30, top = 10, bottom = 45;

// Okabe and Ito's colours, which colour-blind people can distinguish.
constexpr const char *colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};

std::string number(double value, const char *format = "%.6g")
{
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

struct Axis
{
    double low;
    double high;
    double begin; ///< pixel of low
    double end;   ///< pixel of high
    bool logarithmic;

    double place(double value) const
    {
        const double part = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
        return begin + part * (end - begin);
    }

    std::vector<double> ticks() const
    {
        std::vector<double> ticks;
        const double step = logarithmic ? 10 : step_of_ticks();
        for (double tick = logarithmic ? low : std::ceil(low / step) * step;
             tick <= high * (1 + 1e-9) && ticks.size() < 30; tick = logarithmic ? tick * step : tick + step)
            ticks.push_back(tick);
        return ticks;
    }

private:
    /// 1, 2 or 5 times a power of ten; some six ticks.
    double step_of_ticks() const
    {
        const double rough = (high - low) / 6;
        const double power = std::pow(10, std::floor(std::log10(rough)));
        return power * (rough > 5 * power ? 10 : rough > 2 * power ? 5 : rough > power ? 2 : 1);
    }
};

bool has_a_place(const Point &point, bool logarithmic)
{
    constexpr double most = 1e30; // differences and ratios of the ends of an axis remain finite
    return std::abs(point.x) < most && std::abs(point.y) < most && (!logarithmic || point.y > 1 / most);
}

std::vector<Curve> drawn_curves(const Plot &plot)
{
    std::vector<Curve> drawn;
    for (Curve curve : plot.curves)
    {
        std::vector<Point> &points = curve.points;
        points.erase(std::remove_if(points.begin(), points.end(),
                                    [&](const Point &point) { return !has_a_place(point, plot.logarithmic); }),
                     points.end());
        if (!points.empty())
            drawn.push_back(std::move(curve));
    }
    return drawn;
}

Axis axis_over(const std::vector<Curve> &curves, double Point::*coordinate, bool logarithmic)
{
    Axis axis{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 0, 0, logarithmic};
    for (const Curve &curve : curves)
    {
        for (const Point &point : curve.points)
        {
            axis.low = std::min(axis.low, point.*coordinate);
            axis.high = std::max(axis.high, point.*coordinate);
        }
    }
    if (logarithmic) // whole decades
    {
        axis.low = std::pow(10, std::floor(std::log10(axis.low)));
        axis.high = std::max(std::pow(10, std::ceil(std::log10(axis.high))), 10 * axis.low);
        return axis;
    }
    axis.low = std::min(axis.low, 0.0);
    axis.high = axis.high > axis.low ? axis.high : axis.low + 1;
    return axis;
}

std::string text_at(double x, double y, const char *anchor, const std::string &text)
{
    return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\">" + escaped(text) +
           "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2)
{
    return "<path d=\"M" + number(x1) + " " + number(y1) + "L" + number(x2) + " " + number(y2) +
           "\" stroke=\"#ddd\"/>\n";
}

std::string grid(const Plot &plot, const Axis &x, const Axis &y)
{
    std::string text;
    for (const double tick : x.ticks())
        text += line(x.place(tick), y.begin, x.place(tick), y.end) +
                text_at(x.place(tick), y.begin + 17, "middle", number(tick));
    for (const double tick : y.ticks())
        text += line(x.begin, y.place(tick), x.end, y.place(tick)) +
                text_at(x.begin - 6, y.place(tick) + 4, "end", number(tick));
    return text + text_at((x.begin + x.end) / 2, height - 6, "middle", plot.x_label) + "<g transform=\"translate(14 " +
           number((y.begin + y.end) / 2) + ") rotate(-90)\">" + text_at(0, 0, "middle", plot.y_label) + "</g>\n";
}

std::string drawn(const Curve &curve, const char *colour, double stroke_width, const Axis &x, const Axis &y)
{
    const bool dots = curve.style == Curve::Style::dots;
    std::string text;
    for (const Point &point : curve.points)
    {
        const std::string column = number(x.place(point.x), "%.1f"), row = number(y.place(point.y), "%.1f");
        text += dots ? "<circle cx=\"" + column + "\" cy=\"" + row + "\" r=\"3\" fill=\"" + colour + "\"/>\n"
                     : column + "," + row + " ";
    }
    return dots ? text
                : "<polyline fill=\"none\" stroke=\"" + std::string(colour) + "\" stroke-width=\"" +
                      number(stroke_width) + "\" points=\"" + text + "\"/>\n";
}
} // namespace

std::string escaped(const std::string &text)
{
    std::string escaped;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
    {
        for (const char letter : printable(line))
            escaped += letter == '<'   ? "&lt;"
                       : letter == '>' ? "&gt;"
                       : letter == '&' ? "&amp;"
                       : letter == '"' ? "&quot;"
                                       : std::string(1, letter);
        if (!lines.eof())
            escaped += '\n';
    }
    return escaped;
}

std::string svg(const Plot &plot)
{
    const std::vector<Curve> curves = drawn_curves(plot);
    if (curves.empty())
        return "";
    Axis x = axis_over(curves, &Point::x, false);
    Axis y = axis_over(curves, &Point::y, plot.logarithmic);
    x.begin = left;
    x.end = width - right;
    y.begin = height - bottom;
    y.end = top;
    std::string legend;
    std::string marks;
    for (std::size_t i = 0; i < curves.size(); ++i)
    {
        const char *colour = colours[i % std::size(colours)];
        // The first curves are wider, so that each can be seen where curves coincide.
        marks += drawn(curves[i], colour, 1.2 + 1.4 * static_cast<double>(curves.size() - 1 - i), x, y);
        legend +=
            "<span style=\"color: " + std::string(colour) + "\">&#9632;</span> " + escaped(curves[i].name) + " &nbsp; ";
    }
    return "<h2>" + escaped(plot.title) + "</h2>\n<div>" + legend + "</div>\n<svg viewBox=\"0 0 " + number(width) +
           " " + number(height) + "\" role=\"img\" aria-label=\"" + escaped(plot.title) + "\">\n" + grid(plot, x, y) +
           marks + "</svg>\n";
}
} // namespace ode_predictive_space::recording
