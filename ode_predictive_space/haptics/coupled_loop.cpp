// The single-threaded loop: read, collide, force, step.

#include "ode_predictive_space/haptics/loop_parts.h"

namespace ode_predictive_space::haptics
{
void LoopParts::run_coupled(const SceneWork &work)
{
    if (const auto ask = priority_request(false))
    {
        ask();
    }
    const double period = 1 / settings.rate;
    Pacer pacer(start, period, settings.most_steps_behind);
    for (std::uint64_t tick = 0; static_cast<double>(tick) * period < settings.duration && !must_end(); ++tick)
    {
        clock.sleep_until(pacer.due());
        const double now = clock.now();
        guard->beat(now);
        servo.begin(now);
        probe.begin(first_time + static_cast<double>(tick) * period, now);
        collide(work);
        probe.render(period);
        note_rendered(probe.last_tick());
        rendered.take();
        work.advance(period);
        simulated = static_cast<double>(tick + 1) * period;
        dropped += pacer.go_on(clock.now());
        servo.end(clock.now(), pacer.due());
    }
}
} // namespace ode_predictive_space::haptics
