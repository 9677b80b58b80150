#include "ode_predictive_space/recording/page.h"

#include "ode_predictive_space/recording/drawing.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace ode_predictive_space::recording
{
namespace
{
constexpr char style[] =
    R"(body { font-family: sans-serif; max-width: 54em; margin: 2em auto; padding: 0 1em; color: #222; }
pre { background: #f4f4f4; padding: 1em; white-space: pre-wrap; }
h2 { font-size: 1.1em; margin: 2em 0 0.3em; }
svg { width: 100%; height: auto; }
text { font-size: 12px; fill: #444; }
.answer { font-size: 1.15em; border-left: 0.3em solid #0072b2; padding: 0.5em 1em; background: #eef5fa; }
table { border-collapse: collapse; }
th, td { padding: 0.3em 0.8em; border-bottom: 1px solid #ddd; text-align: right; }
th:first-child, td:first-child { text-align: left; })";

std::string path_of_page(const std::string &folder)
{
    return (std::filesystem::path(folder) / "index.html").string();
}

std::string unfinished_page(const std::string &folder)
{
    return path_of_page(folder) + ".unfinished";
}
} // namespace

namespace
{
std::string html_of_row(const std::vector<std::string> &row, const char *cell)
{
    std::string text = "<tr>";
    for (const std::string &each : row)
        text += std::string("<") + cell + ">" + escaped(each) + "</" + cell + ">";
    return text + "</tr>\n";
}

std::string html_of(const Answer &answer)
{
    if (answer.sentence.empty())
        return "";
    std::string text = "<p class=\"answer\">" + escaped(answer.sentence) + "</p>\n<table>\n";
    for (std::size_t i = 0; i < answer.table.size(); ++i)
        text += html_of_row(answer.table[i], i == 0 ? "th" : "td");
    text += "</table>\n";
    for (const std::string &note : answer.notes)
        text += "<p>" + escaped(note) + "</p>\n";
    for (const Plot &plot : answer.plots)
        text += svg(plot);
    return text + "<h2>How it was recorded</h2>\n";
}

std::error_code last_failure()
{
    return {errno, std::generic_category()};
}

[[noreturn]] void refuse(const std::string &path, const std::error_code &failure)
{
    throw std::runtime_error(path + " cannot be written" + (failure ? ": " + failure.message() : ""));
}
} // namespace

std::string html(const Page &page)
{
    std::string text = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
                       escaped(page.title) + "</title>\n<style>\n" + style + "\n</style>\n</head>\n<body>\n<h1>" +
                       escaped(page.title) + "</h1>\n" + html_of(page.answer) + "<pre>" + escaped(page.text) +
                       "</pre>\n";
    for (const Plot &plot : page.plots)
        text += svg(plot);
    return text + "</body>\n</html>\n";
}

void prepare_folder(const std::string &folder)
{
    std::error_code failure, none;
    if (std::filesystem::exists(folder, none) && !std::filesystem::is_directory(folder, none))
        throw std::runtime_error(folder + " is not a folder: name another one for the page");
    std::filesystem::create_directories(folder, failure);
    if (!failure && std::filesystem::is_directory(path_of_page(folder), none))
        failure = std::make_error_code(std::errc::is_a_directory);
    if (!failure && !std::ofstream(unfinished_page(folder)))
        failure = last_failure();
    if (failure || !std::filesystem::remove(unfinished_page(folder), failure))
        refuse(path_of_page(folder), failure);
}

std::string write_page(const std::string &folder, const Page &page)
{
    const std::string path = path_of_page(folder);
    const std::string unfinished = unfinished_page(folder);
    std::ofstream out(unfinished);
    out << html(page);
    out.close();
    std::error_code failure, none;
    if (out)
        std::filesystem::rename(unfinished, path, failure);
    else
        failure = last_failure();
    if (!out || failure)
    {
        std::filesystem::remove(unfinished, none);
        refuse(path, failure);
    }
    return path;
}
} // namespace ode_predictive_space::recording
