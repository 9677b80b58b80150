#include "ode_predictive_space/haptics/drivers.h"

#include "ode_predictive_space/haptics/hand_path.h"
#include "ode_predictive_space/haptics/mouse_device.h"
#include "ode_predictive_space/haptics/recording.h"
#include "ode_predictive_space/haptics/virtual_device.h"

#include "tests/haptics/support/allocation_count.h"
#include "tests/support/error_of.h"
#include "tests/support/scratch.h"

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

TEST(DeviceFactory, AServoLoopNeedsNoMemory)
{
    const ScratchFile file("0 1 2 3 0 0 0 1\n1 1 3 3 0 0 0 1\n");
    for (const std::string &name :
         {std::string("virtual"), std::string("hand-path"), std::string("mouse"), "replay:" + file.path()})
    {
        const std::unique_ptr<Device> device = make_device(name);
        device->open();
        const std::uint64_t before = allocation_count();
        for (int i = 0; i < 20000; ++i)
        {
            const DeviceState state = device->read(0.001 * i);
            device->write({-state.position, Vector3::Zero()});
        }
        EXPECT_EQ(allocation_count(), before) << name;
    }
}

TEST(DeviceFactory, AnUnknownNameIsAnsweredWithTheNames)
{
    for (const std::string name : {"phantom", "", "replay:", "replay"})
    {
        const std::string sentence = error_of<std::invalid_argument>([&] { make_device(name); }).what();
        for (const std::string &known : device_names())
            EXPECT_NE(sentence.find(known), std::string::npos) << sentence;
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
