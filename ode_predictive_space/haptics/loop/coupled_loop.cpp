#include "ode_predictive_space/haptics/loop/coupled_loop.h"

namespace ode_predictive_space::haptics
{
void run_coupled(LoopParts &parts, const SceneWork &work)
{
    if (const auto ask = parts.priority_request(false))
        ask();
    const LoopSettings &settings = parts.settings;
    const double period = 1 / settings.rate;
    Pacer pacer(parts.time.start, period, settings.most_steps_behind);
    for (std::uint64_t tick = 0; static_cast<double>(tick) * period < settings.duration && !parts.must_end(); ++tick)
    {
        parts.clock.sleep_until(pacer.due());
        const double now = parts.clock.now();
        parts.guard->beat(now);
        parts.servo.begin(now);
        parts.probe.begin(parts.time.first + static_cast<double>(tick) * period, now);
        parts.collide(work);
        parts.probe.render(period);
        parts.note_rendered(parts.probe.last_tick());
        parts.rendered.take();
        work.advance(period);
        parts.time.simulated = static_cast<double>(tick + 1) * period;
        parts.counts.dropped += pacer.go_on(parts.clock.now());
        parts.servo.end(parts.clock.now(), pacer.due());
    }
}
} // namespace ode_predictive_space::haptics
