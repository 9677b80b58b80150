// Connects to the server of 3D mice and prints the result; set_user_id_test.sh runs it as a set-user-ID program.

#include "ode_predictive_space/haptics/device/spnav_connection.h"

#include <cstdio>

using namespace ode_predictive_space::haptics;

int main()
{
    try
    {
        std::printf("connected to %s\n", SpnavConnection().mouse().c_str());
    }
    catch (const DeviceError &error)
    {
        std::printf("%s: %s\n", name_of(error.fault()), error.what());
    }
    return 0;
}
