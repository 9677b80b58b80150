#include "ode_predictive_space/report/page.h"

#include "ode_predictive_space/report/drawing.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace ode_predictive_space::report
{
namespace
{
constexpr char style[] =
    R"(body { font-family: sans-serif; max-width: 54em; margin: 2em auto; padding: 0 1em; color: #222; }
pre { background: #f4f4f4; padding: 1em; white-space: pre-wrap; }
h2 { font-size: 1.1em; margin: 2em 0 0.3em; }
svg { width: 100%; height: auto; }
text { font-size: 12px; fill: #444; })";

std::string path_of_page(const std::string &folder)
{
    return (std::filesystem::path(folder) / "index.html").string();
}

std::string unfinished_page(const std::string &folder)
{
    return path_of_page(folder) + ".unfinished";
}
} // namespace

std::string html(const Page &page)
{
    std::string text = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
                       escaped(page.title) + "</title>\n<style>\n" + style + "\n</style>\n</head>\n<body>\n<h1>" +
                       escaped(page.title) + "</h1>\n<pre>" + escaped(page.text) + "</pre>\n";
    for (const Plot &plot : page.plots)
    {
        text += svg(plot);
    }
    return text + "</body>\n</html>\n";
}

void prepare_folder(const std::string &folder)
{
    std::error_code failure;
    if (std::filesystem::exists(folder, failure) && !std::filesystem::is_directory(folder, failure))
    {
        throw std::runtime_error(folder + " is not a folder");
    }
    std::filesystem::create_directories(folder, failure);
    if (failure || std::filesystem::is_directory(path_of_page(folder), failure) ||
        !std::ofstream(unfinished_page(folder)) || !std::filesystem::remove(unfinished_page(folder), failure))
    {
        throw std::runtime_error("cannot write " + path_of_page(folder));
    }
}

std::string write_page(const std::string &folder, const Page &page)
{
    const std::string path = path_of_page(folder);
    const std::string unfinished = unfinished_page(folder);
    std::ofstream out(unfinished);
    out << html(page);
    out.close();
    std::error_code failure;
    if (out)
    {
        std::filesystem::rename(unfinished, path, failure);
    }
    if (!out || failure)
    {
        std::filesystem::remove(unfinished, failure);
        throw std::runtime_error("cannot write " + path);
    }
    return path;
}
} // namespace ode_predictive_space::report
