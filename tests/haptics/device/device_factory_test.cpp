#include "ode_predictive_space/haptics/drivers.h"

#include "ode_predictive_space/haptics/hand_path.h"
#include "ode_predictive_space/haptics/mouse_device.h"
#include "ode_predictive_space/haptics/recording.h"
#include "ode_predictive_space/haptics/virtual_device.h"

#include "tests/haptics/support/allocation_count.h"
#include "tests/haptics/support/temporary_file.h"

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
        EXPECT_FALSE(make_device(name)->status().open) << name;
}

TEST(DeviceFactory, OtherSeedsAreOtherHands)
{
    for (const std::string name : {"virtual", "hand-path"})
    {
        const auto position = [&](std::uint64_t seed) {
            const std::unique_ptr<Device> device = make_device(name, seed);
            device->open();
            device->read(0);
            return device->read(0.4).position;
        };
        EXPECT_EQ(position(1), position(1)) << name;
        EXPECT_NE(position(1), position(2)) << name;
    }
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
                EXPECT_NE(std::string(error.what()).find(known), std::string::npos) << error.what();
        }
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
