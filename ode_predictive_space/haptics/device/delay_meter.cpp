#include "ode_predictive_space/haptics/device/delay_meter.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int readings = 200;
constexpr double oldest = 0.1; // s
constexpr double grown = 1.1;  // times the delay so far: less is the noise of the mean
} // namespace

bool DelayMeter::note(double age, double period)
{
    if (!(age >= 0 && age <= oldest))
        return false;
    sum_ += age;
    if (++count_ < readings)
        return false;
    const double mean = std::max(0.0, sum_ / readings - period);
    sum_ = 0;
    count_ = 0;
    if (mean <= grown * delay_)
        return false;
    delay_ = mean;
    return true;
}
} // namespace ode_predictive_space::haptics
