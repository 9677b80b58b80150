#include "tests/differential/operation.h"

#include <iomanip>
#include <sstream>

namespace ode_predictive_space
{
const char *action_name(Action action)
{
    static const char *const names[] = {"make_geom",
                                        "destroy_geom",
                                        "make_body",
                                        "destroy_body",
                                        "attach",
                                        "offset",
                                        "clear_offset",
                                        "move_geom",
                                        "move_body",
                                        "turn_geom",
                                        "turn_body",
                                        "resize",
                                        "enable_geom",
                                        "enable_body",
                                        "bits",
                                        "velocity",
                                        "force",
                                        "kinematic",
                                        "drive",
                                        "take_out",
                                        "put_in",
                                        "make_space",
                                        "destroy_space",
                                        "clean",
                                        "ask_bounds",
                                        "role",
                                        "deviation",
                                        "horizon",
                                        "step",
                                        "tick",
                                        "calm",
                                        "query",
                                        "tick_asking",
                                        "tick_broken_off",
                                        "query_broken_off",
                                        "data_changed",
                                        "bad_call",
                                        "tick_throwing_bounds",
                                        "query_throwing_bounds",
                                        "change_in_place",
                                        "ask_times",
                                        "shape_margin",
                                        "distort_geom",
                                        "distort_body",
                                        "aim_ray"};
    static_assert(sizeof names / sizeof *names == static_cast<std::size_t>(Action::last) + 1, "a name for each");
    return names[static_cast<int>(action)];
}

std::string to_text(const Operation &operation)
{
    std::ostringstream text;
    text << std::setprecision(17) << action_name(operation.action) << " " << operation.subject << " "
         << operation.object << " " << operation.number << " (";
    for (std::size_t i = 0; i < operation.value.size(); ++i)
        text << (i ? ", " : "") << operation.value[i];
    text << ")";
    return text.str();
}

std::string to_text(const History &history)
{
    std::ostringstream text;
    text << "gravity " << history.gravity << ", middle " << history.middle[0] << " " << history.middle[1] << " "
         << history.middle[2] << ", extent " << history.extent << ", contacts " << history.contacts << ", auto_disable "
         << history.auto_disable << ", " << history.operations.size() << " operations\n";
    for (const Operation &operation : history.operations)
        text << "  " << to_text(operation) << "\n";
    return text.str();
}
} // namespace ode_predictive_space
