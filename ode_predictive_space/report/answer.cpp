#include "ode_predictive_space/report/answer.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace ode_predictive_space::report
{
namespace
{
using Fields = std::vector<std::string>;

std::string field(std::string text)
{
    for (char &letter : text)
    {
        if (letter == '\t' || letter == '\n')
            letter = ' ';
    }
    return text;
}

std::string line(const char *kind, const Fields &fields)
{
    std::string text = kind;
    for (const std::string &each : fields)
        text += "\t" + field(each);
    return text + "\n";
}

std::string lines_of(const Plot &plot)
{
    std::string text = line("plot", {plot.title, plot.x_label, plot.y_label, plot.logarithmic ? "log" : "linear"});
    for (const Curve &curve : plot.curves)
    {
        Fields fields = {curve.name};
        for (const Point &point : curve.points)
        {
            char numbers[64];
            std::snprintf(numbers, sizeof numbers, "%.9g %.9g", point.x, point.y);
            fields.emplace_back(numbers);
        }
        text += line("curve", fields);
    }
    return text;
}

Fields fields_of(const std::string &text)
{
    Fields fields;
    std::istringstream words(text);
    for (std::string word; std::getline(words, word, '\t');)
        fields.push_back(word);
    return fields;
}

Curve curve_of(const Fields &fields)
{
    Curve curve;
    curve.name = fields[1];
    for (std::size_t i = 2; i < fields.size(); ++i)
    {
        char *end = nullptr;
        const double x = std::strtod(fields[i].c_str(), &end);
        curve.points.push_back({x, std::strtod(end, nullptr)});
    }
    return curve;
}

bool take_line(const Fields &fields, Answer &answer)
{
    const std::string &kind = fields[0];
    if (kind == "answer" && fields.size() == 2)
        answer.sentence = fields[1];
    else if (kind == "note" && fields.size() == 2)
        answer.notes.push_back(fields[1]);
    else if (kind == "row")
        answer.table.emplace_back(fields.begin() + 1, fields.end());
    else if (kind == "plot" && fields.size() == 5)
        answer.plots.push_back({fields[1], fields[2], fields[3], {}, fields[4] == "log"});
    else if (kind == "curve" && fields.size() >= 2 && !answer.plots.empty())
        answer.plots.back().curves.push_back(curve_of(fields));
    else
        return false;
    return true;
}
} // namespace

std::string lines_of(const Answer &answer)
{
    std::string text = line("answer", {answer.sentence});
    for (const Fields &row : answer.table)
        text += line("row", row);
    for (const std::string &note : answer.notes)
        text += line("note", {note});
    for (const Plot &plot : answer.plots)
        text += lines_of(plot);
    return text + "end\n";
}

std::optional<Answer> answer_of(const std::string &lines)
{
    Answer answer;
    std::istringstream text(lines);
    for (std::string each; std::getline(text, each);)
    {
        if (each == "end")
            return answer;
        const Fields fields = fields_of(each);
        if (fields.empty() || !take_line(fields, answer))
            return std::nullopt;
    }
    return std::nullopt;
}
} // namespace ode_predictive_space::report
