#include "demos/ode/demo_probe.h"

#include "demos/ode/hand.h"
#include "ode_predictive_space/haptics/safety.h"

#include <cstdlib>
#include <iostream>
#include <ode_predictive_space/predictive_space.h>
#include <stdexcept>

namespace ode_predictive_space::ode_demos
{
namespace
{
constexpr std::size_t frames_per_key = 10;
constexpr long steps_per_check = 50; // of the predictive space, by brute force

class Demo
{
public:
    void read_options(int argc, char **argv);
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
    bool describe_run();

    std::string keys_;      ///< pressed one after the other
    bool headless_ = false; ///< without a window: drawstuff reads the number of steps
    Place place_;
    std::unique_ptr<Hand> hand_; ///< null: no probe
    dsFunctions functions_{};    ///< the demo's own
    std::size_t frames_ = 0;
    long steps_ = 0;
    long pairs_ = 0;    ///< calls of the near callback, without the probe's
    bool valid_ = true; ///< result of dPredictiveSpaceValidate()
};

Demo demo;

/// Ignores unknown options, as drawstuff does. @throws std::invalid_argument when an option lacks its value.
void Demo::read_options(int argc, char **argv)
{
    for (int i = 1; i < argc; ++i)
    {
        const std::string name = argv[i];
        if (name != "-probe" && name != "-keys" && name != "-headless")
            continue;
        if (++i >= argc)
            throw std::invalid_argument(name + " needs a value");
        if (name == "-probe")
            hand_ = std::make_unique<Hand>(argv[i]);
        else if (name == "-keys")
            keys_ = argv[i];
        else
            headless_ = true;
    }
}

void Demo::set_space(dSpaceID space, const dReal *bounds)
{
    place_.space = space;
    place_.bounds = {Vector3(bounds[0], bounds[2], bounds[4]), Vector3(bounds[1], bounds[3], bounds[5])};
}

bool Demo::touch(dGeomID first, dGeomID second)
{
    if (hand_ && hand_->touch(first, second))
        return true;
    ++pairs_;
    return false;
}

void Demo::step()
{
    if (headless_ && steps_ % steps_per_check == 0)
        check_space();
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
    if (frames_ % frames_per_key == 0 && next < keys_.size() && functions_.command != nullptr)
        functions_.command(keys_[next]);
}

void Demo::draw_frame(int pause)
{
    press_next_key();
    ++frames_;
    functions_.step(pause);
    if (hand_ && !headless_)
        hand_->draw();
    if (haptics::StopRequest::requested())
        dsStop();
}

/// @return whether a predictive space is valid.
bool Demo::describe_run()
{
    check_space();
    leave_space();
    std::cout << "steps: " << steps_ << '\n' << "pairs: " << pairs_ << '\n';
    if (dSpaceIsPredictive(place_.space) != 0)
        std::cout << "predictive space: " << (valid_ ? "valid" : "not valid") << '\n';
    if (hand_)
        std::cout << "steps with a force: " << hand_->frames_with_force() << '\n'
                  << "largest force: " << hand_->largest_force() << " N\n";
    return valid_;
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
    const bool ended_well = !headless_ || describe_run();
    hand_.reset();
    if (!ended_well)
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
    guarded([&] { demo.read_options(argc, argv); });
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
