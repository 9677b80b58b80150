// An independent haptic program, compiled for the processor at hand: poses go into the library and come back.

#include <cstdio>

#include <ode/ode.h>
#include <ode_predictive_space/haptics/recording.h>
#include <ode_predictive_space/haptics/touch_sensor.h>
#include <ode_predictive_space/haptics/workspace.h>

namespace haptics = ode_predictive_space::haptics;
using haptics::Quaternion;
using haptics::Vector3;

namespace
{
int failures = 0;

void expect(bool holds, const char *what)
{
    if (!holds)
    {
        std::printf("wrong: %s\n", what);
        ++failures;
    }
}

haptics::DeviceState some_state()
{
    haptics::DeviceState state;
    state.position = Vector3(0.1, 0.2, 0.3);
    state.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vector3(0.6, 0, 0.8)));
    state.linear_velocity = Vector3(1, 2, 3);
    state.angular_velocity = Vector3(4, 5, 6);
    state.buttons = 7;
    state.time = 8;
    return state;
}

bool same(const haptics::DeviceState &a, const haptics::DeviceState &b)
{
    return a.position.isApprox(b.position) && a.orientation.isApprox(b.orientation) &&
           a.linear_velocity.isApprox(b.linear_velocity) && a.angular_velocity.isApprox(b.angular_velocity);
}

void map_to_the_scene_and_back()
{
    const haptics::DeviceState state = some_state();
    haptics::WorkspacePlacement placement;
    placement.rotation = haptics::WorkspacePlacement::z_up();
    placement.offset = Vector3(10, 20, 30);
    placement.force_scale = 3;
    const haptics::WorkspaceMapping mapping(placement);
    const haptics::ToolState tool = mapping.to_scene(state);
    expect(tool.position.isApprox(Vector3(10.1, 19.7, 30.2)), "position in the scene");
    expect(tool.angular_velocity.isApprox(Vector3(4, -6, 5)), "angular velocity in the scene");
    expect(mapping.placement().force_scale == 3, "force scale of the mapping");
    expect(mapping.to_device(haptics::Wrench{Vector3(0, 0, 1), Vector3::Zero()}).force.isApprox(Vector3(0, 3, 0)),
           "force at the device");
}

void record_and_read(const char *file)
{
    const haptics::DeviceState state = some_state();
    {
        haptics::Recorder recorder(file, {}, haptics::Recorder::Flush::by_caller, 10);
        expect(recorder.add(1, state, Vector3(1, 0, 0)) && recorder.add(2, state, Vector3(2, 0, 0)), "adding a tick");
        recorder.close();
    }
    const haptics::Recording recording = haptics::read_recording(file);
    std::remove(file);
    expect(recording.ticks.size() == 2 && same(recording.ticks[1].state, state) && recording.ticks[1].state.time == 2 &&
               recording.ticks[1].force.x() == 2,
           "a recorded tick");
}

void ask_for_a_body()
{
    dInitODE2(0);
    const dWorldID world = dWorldCreate();
    const dBodyID body = dBodyCreate(world);
    dBodySetLinearVel(body, 1, 2, 3);
    const haptics::ToolState state = haptics::tool_state_of(body);
    expect(state.orientation.isApprox(Quaternion::Identity()), "orientation of a body");
    expect(state.linear_velocity.isApprox(Vector3(1, 2, 3)), "velocity of a body");
    const dSpaceID space = dHashSpaceCreate(nullptr);
    haptics::TouchSensor sensor(space, 0.125);
    sensor.pose(state);
    expect(sensor.radius() == 0.125, "radius of a sensor");
}
} // namespace

int main(int, char **arguments)
{
    map_to_the_scene_and_back();
    record_and_read((std::string(arguments[0]) + ".recording").c_str());
    ask_for_a_body();
    std::printf("quaternions aligned to %d bytes here, structs to %d\n", static_cast<int>(alignof(Eigen::Quaterniond)),
                static_cast<int>(alignof(haptics::DeviceState)));
    return failures == 0 ? 0 : 1;
}
