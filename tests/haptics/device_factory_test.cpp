#include "ode_predictive_space/haptics/device_factory.h"

#include "ode_predictive_space/haptics/hand_path_device.h"
#include "ode_predictive_space/haptics/mouse_device.h"
#include "ode_predictive_space/haptics/replay_device.h"
#include "ode_predictive_space/haptics/virtual_device.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
template <class Kind> bool makes(const std::string &name)
{
    return dynamic_cast<Kind *>(make_device(name).get()) != nullptr;
}

TEST(DeviceFactory, MakesDevicesByName)
{
    EXPECT_TRUE(makes<VirtualDevice>("virtual"));
    EXPECT_TRUE(makes<HandPathDevice>("hand-path"));
    EXPECT_TRUE(makes<MouseDevice>("mouse"));
    EXPECT_TRUE(makes<ReplayDevice>("replay:/some/file.txt"));
}

TEST(DeviceFactory, MakesEveryDeviceThatItNamesAndDoesNotOpenIt)
{
    EXPECT_GE(device_names().size(), 4u);
    for (const std::string &name : device_names())
    {
        EXPECT_FALSE(make_device(name)->status().open) << name;
    }
}

TEST(DeviceFactory, TheVirtualHandStaysInItsWorkspace)
{
    const std::unique_ptr<Device> device = make_device("virtual");
    device->open();
    double farthest = 0;
    for (int i = 0; i < 30000; ++i)
    {
        const Vector3 position = device->read(0.001 * i).position;
        ASSERT_TRUE(device->capabilities().workspace.contains(position)) << "at " << 0.001 * i << " s";
        farthest = std::max(farthest, position.cwiseAbs().maxCoeff());
    }
    EXPECT_GT(farthest, 0.05) << "and uses it";
}

TEST(DeviceFactory, AnUnknownNameIsAnsweredWithTheNames)
{
    for (const std::string name : {"phantom", "", "replay:", "replay"})
    {
        try
        {
            make_device(name);
            ADD_FAILURE() << "there is no device " << name;
        }
        catch (const std::invalid_argument &error)
        {
            for (const std::string &known : device_names())
            {
                EXPECT_NE(std::string(error.what()).find(known), std::string::npos) << error.what();
            }
        }
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
