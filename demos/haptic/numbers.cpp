#include "demos/haptic/numbers.h"

#include <iomanip>
#include <locale>
#include <sstream>

namespace ode_predictive_space::demo
{
namespace
{
struct GroupsOfThree : std::numpunct<char>
{
    char do_thousands_sep() const override { return ','; }
    std::string do_grouping() const override { return "\3"; }
};
} // namespace

std::string fixed(double number, int decimals)
{
    std::ostringstream text;
    text.imbue(std::locale(std::locale::classic(), new GroupsOfThree));
    text << std::fixed << std::setprecision(decimals) << number;
    return text.str();
}
} // namespace ode_predictive_space::demo
