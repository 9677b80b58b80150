#include "ode_predictive_space/recording/instructions.h"

#include <cstdio>
#include <cstdlib>

namespace ode_predictive_space::recording
{
namespace
{
std::string quoted(const std::string &word)
{
    std::string text = "'";
    for (const char each : word)
        text += each == '\'' ? std::string("'\\''") : std::string(1, each);
    return text + "'";
}

// The text that a command writes to standard error; none when it fails.
std::optional<std::string> messages_of(const std::string &command)
{
    FILE *const pipe = popen((command + " 2>&1 >/dev/null").c_str(), "r");
    if (!pipe)
        return std::nullopt;
    std::string text;
    char part[4096];
    while (const std::size_t size = std::fread(part, 1, sizeof part, pipe))
        text.append(part, size);
    return pclose(pipe) == 0 ? std::optional<std::string>(text) : std::nullopt;
}
} // namespace

bool has_valgrind()
{
    return std::system("command -v valgrind >/dev/null") == 0;
}

std::optional<std::uint64_t> collected(const std::string &output)
{
    const std::string label = "Collected : ";
    const std::size_t place = output.rfind(label);
    if (place == std::string::npos)
        return std::nullopt;
    const char *digits = output.c_str() + place + label.size();
    char *end = nullptr;
    const std::uint64_t number = std::strtoull(digits, &end, 10);
    return end == digits ? std::nullopt : std::optional<std::uint64_t>(number);
}

std::optional<std::uint64_t> instructions_of(const std::vector<std::string> &program)
{
    // LD_BIND_NOW: functions are bound at the start and not while instructions are counted.
    std::string command = "LD_BIND_NOW=1 exec valgrind --tool=callgrind --callgrind-out-file=/dev/null "
                          "--toggle-collect=counted_changes --toggle-collect=counted_collide "
                          "--toggle-collect=counted_end";
    for (const std::string &word : program)
        command += " " + quoted(word);
    const auto output = messages_of(command);
    return output ? collected(*output) : std::nullopt;
}

std::optional<std::uint64_t> count_instructions(const std::string &tool, const std::string &path, SpaceKind kind,
                                                const CountedEvents &events)
{
    std::vector<std::string> program = {tool,        "replay",
                                        "--counted", name_of(kind),
                                        "--from",    std::to_string(events.from),
                                        "--to",      std::to_string(events.to),
                                        "--every",   std::to_string(events.every)};
    if (events.contacts)
        program.emplace_back("--contacts");
    if (events.whole_life)
        program.emplace_back("--whole-life");
    program.push_back(path);
    return instructions_of(program);
}
} // namespace ode_predictive_space::recording
