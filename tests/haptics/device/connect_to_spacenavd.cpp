// Connects to the server of 3D mice and writes what came of it: the program that set_user_id_test.sh gives set-user-ID.

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
