#include "ode_predictive_space/preload/survivors.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <unistd.h>

namespace ode_predictive_space::preload
{
namespace
{
constexpr std::size_t most_named = 10;

std::string text_of(int process, const char *file)
{
    std::ostringstream text;
    text << std::ifstream("/proc/" + std::to_string(process) + "/" + file).rdbuf();
    return text.str();
}

// A process that has ended and was not waited for has no environment any more.
bool has_in_environment(int process, const std::string &setting)
{
    const std::string environment = '\0' + text_of(process, "environ");
    return environment.find('\0' + setting + '\0') != std::string::npos;
}

int number_of(const std::string &name)
{
    int number = 0;
    const auto end = std::from_chars(name.data(), name.data() + name.size(), number);
    return end.ptr == name.data() + name.size() ? number : 0;
}

std::set<int> numbers_of_processes_with(const std::string &setting)
{
    std::set<int> found;
    std::error_code end; // of what can be read
    for (std::filesystem::directory_iterator each("/proc", end), last; !end && each != last; each.increment(end))
    {
        const int process = number_of(each->path().filename());
        if (process > 0 && process != getpid() && has_in_environment(process, setting))
            found.insert(process);
    }
    return found;
}

std::string described(int process)
{
    std::string name = text_of(process, "comm");
    name.erase(std::remove(name.begin(), name.end(), '\n'), name.end());
    return name + " (process " + std::to_string(process) + ")";
}

std::vector<std::string> described(const std::set<int> &processes)
{
    std::vector<std::string> all;
    for (int process : processes)
        all.push_back(described(process));
    return all;
}
} // namespace

bool is_alive(int process)
{
    const std::string text = text_of(process, "stat");
    const std::size_t name_end = text.rfind(") ");
    return name_end != std::string::npos && std::strchr("ZX", text[name_end + 2]) == nullptr;
}

std::vector<std::string> processes_with(const std::string &setting)
{
    return described(numbers_of_processes_with(setting));
}

std::vector<std::string> survivors(CountsFile &counts)
{
    std::set<int> processes = numbers_of_processes_with(std::string(counts_variable) + "=" + counts.name());
    for (const SpaceCounts *page : counts.pages())
        if (page->state == PageState::counting && is_alive(page->process_id))
            processes.insert(page->process_id);
    return described(processes);
}

std::string list_of(const std::vector<std::string> &processes)
{
    std::string text;
    for (std::size_t i = 0; i < std::min(processes.size(), most_named); ++i)
        text += (i > 0 ? ", " : "") + processes[i];
    if (processes.size() > most_named)
        text += " and " + std::to_string(processes.size() - most_named) + " more";
    return text;
}
} // namespace ode_predictive_space::preload
