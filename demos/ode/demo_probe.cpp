#include "demos/ode/demo_probe.h"

#include "demos/ode/census.h"
#include "demos/ode/hand.h"
#include "demos/ode/options.h"
#include "ode_predictive_space/haptics/safety.h"

#include <cstdlib>
#include <iostream>
#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space::ode_demos
{
namespace
{
constexpr std::size_t frames_per_key = 10;
constexpr long steps_per_check = 50; // of the predictive space, by brute force

class Demo
{
public:
    void set_options(Options options);
    void set_space(dSpaceID space, const dReal *bounds);
    bool touch(dGeomID first, dGeomID second);
    void step();
    void leave_space();
    void run(int argc, char **argv, int width, int height, dsFunctions &functions);

private:
    void start();
    void draw_frame(int pause);
    void press_next_key();
    void check_space();
    void tell_outcome();

    Options options_;
    Place place_;
    std::unique_ptr<Hand> hand_;
    dsFunctions functions_{}; ///< the demo's own
    std::size_t frames_ = 0;
    long steps_ = 0;
    long pairs_ = 0;    ///< calls of the near callback
    long contacts_ = 0; ///< contact joints, in all steps
    bool valid_ = true; ///< result of dPredictiveSpaceValidate()
    bool well_ = true;
};

Demo demo;

void Demo::set_options(Options options)
{
    options_ = std::move(options);
    if (!options_.device.empty())
        hand_ = std::make_unique<Hand>(options_.device);
}

void Demo::set_space(dSpaceID space, const dReal *bounds)
{
    place_.space = space;
    place_.bounds = {Vector3(bounds[0], bounds[2], bounds[4]), Vector3(bounds[1], bounds[3], bounds[5])};
}

bool Demo::touch(dGeomID first, dGeomID second)
{
    ++pairs_;
    return hand_ && hand_->touch(first, second);
}

void Demo::step()
{
    if (options_.headless)
    {
        contacts_ += take_census(place_.space).contacts;
        if (steps_ % steps_per_check == 0)
            check_space();
    }
    ++steps_;
    if (hand_)
        hand_->step(place_);
}

void Demo::leave_space()
{
    if (hand_)
        hand_->leave();
}

void Demo::check_space()
{
    valid_ = valid_ && (dSpaceIsPredictive(place_.space) == 0 || dPredictiveSpaceValidate(place_.space) != 0);
}

void Demo::start()
{
    if (functions_.start != nullptr)
        functions_.start();
    float direction[3];
    dsGetViewpoint(nullptr, direction);
    place_.heading = direction[0];
}

void Demo::press_next_key()
{
    const std::size_t next = frames_ / frames_per_key;
    if (frames_ % frames_per_key == 0 && next < options_.keys.size() && functions_.command != nullptr)
        functions_.command(options_.keys[next]);
}

void Demo::draw_frame(int pause)
{
    press_next_key();
    ++frames_;
    functions_.step(pause);
    if (hand_ && !options_.headless)
        hand_->draw();
    if (haptics::StopRequest::requested())
        dsStop();
}

void Demo::tell_outcome()
{
    check_space();
    leave_space();
    const Census census = take_census(place_.space);
    std::cout << options_.program << '\n'
              << "steps: " << steps_ << '\n'
              << "bodies: " << census.bodies << '\n'
              << "geoms: " << census.geoms << '\n'
              << "pairs: " << pairs_ << '\n'
              << "contacts: " << contacts_ << '\n'
              << "resting bodies: " << census.resting << '\n'
              << "mean height: " << census.mean_height << '\n'
              << "lowest: " << census.centres.min().z() << '\n'
              << "highest: " << census.centres.max().z() << '\n'
              << "positions: " << (census.finite ? "finite" : "not finite") << '\n';
    if (dSpaceIsPredictive(place_.space) != 0)
        std::cout << "predictive space: " << (valid_ ? "valid" : "not valid") << '\n';
    if (hand_)
        std::cout << "probe: " << hand_->name() << '\n'
                  << "steps with a force: " << hand_->frames_with_force() << '\n'
                  << "largest force: " << hand_->largest_force() << " N\n";
    well_ = census.finite && valid_;
}

void Demo::run(int argc, char **argv, int width, int height, dsFunctions &functions)
{
    const haptics::StopRequest stop_request; // signals end the loop, with zero force
    functions_ = functions;
    dsFunctions around = functions;
    around.start = [] { demo.start(); };
    around.step = [](int pause) { demo.draw_frame(pause); };
    dsSetPointerCallback([](const dsPointerEvent *event) {
        if (demo.hand_)
            demo.hand_->pointer(*event);
        return 0;
    });
    dsSimulationLoop(argc, argv, width, height, &around);
    if (options_.headless)
        tell_outcome();
    hand_.reset();
    if (!well_)
        std::exit(EXIT_FAILURE);
}

/// Exceptions must not pass through the demos, which are C.
template <typename Work> void guarded(Work work)
{
    try
    {
        work();
    }
    catch (const std::exception &failure)
    {
        dsError("%s", failure.what());
    }
}
} // namespace
} // namespace ode_predictive_space::ode_demos

using ode_predictive_space::ode_demos::demo;
using ode_predictive_space::ode_demos::guarded;

void demoProbeOptions(int argc, char **argv)
{
    guarded([&] { demo.set_options(ode_predictive_space::ode_demos::read_options(argc, argv)); });
}

void demoProbeSpace(dSpaceID space, const dReal *bounds)
{
    demo.set_space(space, bounds);
}

int demoProbeTouch(dGeomID o1, dGeomID o2)
{
    return demo.touch(o1, o2) ? 1 : 0;
}

void demoProbeStep()
{
    guarded([] { demo.step(); });
}

void demoProbeDestroy()
{
    demo.leave_space();
}

void demoSimulationLoop(int argc, char **argv, int window_width, int window_height, dsFunctions *fn)
{
    guarded([&] { demo.run(argc, argv, window_width, window_height, *fn); });
}
