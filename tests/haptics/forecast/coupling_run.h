// Hands push a scene in one thread or in two. In simulated time both threads run in one, so that all runs are alike.
// Such motions are very sensitive: a hand moved by a micrometre may change a peak by a factor of two. Therefore ensembles of
// hands are compared, not traces.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_FORECAST_COUPLING_RUN_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_FORECAST_COUPLING_RUN_H

#include "ode_predictive_space/haptics/loop.h"
#include "tests/haptics/forecast/coupling_scene.h"
#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/scripted_device.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace ode_predictive_space::haptics
{
constexpr int hands = 8;         // of an ensemble
constexpr double one_thread = 0; // Hz; in place of the scene's rate

struct Outcome
{
    double peak_force = 0;                                        ///< N
    double least_force = std::numeric_limits<double>::infinity(); ///< N; in the second half of the run
    double peak_speed = 0;                                        ///< m/s; of any body
    double impulse = 0;                                           ///< N s; the sum of magnitudes
    double given_to_hand = 0;                                     ///< J; at the end
    double given_to_scene = 0;                                    ///< J; at the end
    double made_energy = 0;                                       ///< J; largest sum given to the hand and the scene
    double hand_work = 0;                                         ///< J; done by the hand
    double unmatched = 0;       ///< the part of the impulse on the hand that the bodies did not get
    double force_at_change = 0; ///< N; when the program changed the scene
    int most_touches = 0;
    int notices = 0;
};

inline std::ostream &operator<<(std::ostream &stream, const Outcome &outcome)
{
    return stream << "force up to " << outcome.peak_force << " N, at last from " << outcome.least_force
                  << " N, fastest body " << outcome.peak_speed << " m/s, impulse " << outcome.impulse
                  << " N s, energy to the hand " << 1000 * outcome.given_to_hand << " mJ, to the scene "
                  << 1000 * outcome.given_to_scene << " mJ, made at most " << 1000 * outcome.made_energy
                  << " mJ, not matched " << outcome.unmatched;
}

/// Means; but the maxima of made_energy, unmatched and the counts, and the minimum of least_force.
inline Outcome mean_of(const std::vector<Outcome> &outcomes)
{
    Outcome mean;
    mean.least_force = outcomes.front().least_force;
    const double part = 1.0 / static_cast<double>(outcomes.size());
    for (const Outcome &outcome : outcomes)
    {
        mean.peak_force += part * outcome.peak_force;
        mean.peak_speed += part * outcome.peak_speed;
        mean.impulse += part * outcome.impulse;
        mean.given_to_hand += part * outcome.given_to_hand;
        mean.given_to_scene += part * outcome.given_to_scene;
        mean.hand_work += part * outcome.hand_work;
        mean.force_at_change += part * outcome.force_at_change;
        mean.least_force = std::min(mean.least_force, outcome.least_force);
        mean.made_energy = std::max(mean.made_energy, outcome.made_energy);
        mean.unmatched = std::max(mean.unmatched, outcome.unmatched);
        mean.most_touches = std::max(mean.most_touches, outcome.most_touches);
        mean.notices = std::max(mean.notices, outcome.notices);
    }
    return mean;
}

class CoupledRun
{
public:
    /// @param late s; simulated duration of each step of the scene.
    CoupledRun(const CouplingCase &scenario, const Vector3 &offset, Stepper stepper, double physics_rate,
               double late = 0)
        : scene_(stepper), scenario_(scenario), hand_(scenario.hand), decoupled_(physics_rate != one_thread)
    {
        dRandSetSeed(1);
        scenario_.build(scene_);
        hand_.from += offset;
        energy_before_ = scene_.energy();
        ScriptedDevice device([this](double seconds) { return hand_.at(seconds); });
        WriteLog log(device, clock_);
        HapticProbe probe(log, scene_.space, radius, with_law(scenario_.law()));
        probe.set_recorder([this](const RenderedTick &tick) { note(tick); });
        LoopSettings settings = simulated(clock_, HandWay::rests + hand_.duration, decoupled_, physics_rate);
        settings.notice = [this](const Notice &notice) {
            outcome_.notices += notice.kind == NoticeKind::coupling ? 1 : 0;
        };
        HapticLoop loop(probe, settings);
        loop.run({[&] {
                      scene_.collide(probe);
                      outcome_.most_touches = std::max(outcome_.most_touches, felt_in(probe.touches()));
                  },
                  [&](double step) {
                      pushed_ += step * scene_.force_of_hand();
                      scene_.step(step);
                      clock_.advance(late);
                      note_step();
                      change();
                  }});
        pushed_ += scene_.force_of_hand() / (decoupled_ ? physics_rate : 1000.0);
        if (outcome_.impulse > 0)
        {
            const Vector3 given = log.impulse();
            outcome_.unmatched = decoupled_ ? (pushed_ + given).norm() / given.norm() : 0;
        }
    }

    const Outcome &outcome() const { return outcome_; }

private:
    static int felt_in(const std::vector<Touch> &touches)
    {
        return static_cast<int>(
            std::count_if(touches.begin(), touches.end(), [](const Touch &touch) { return touch.depth > 0; }));
    }

    void note(const RenderedTick &tick)
    {
        const double force = tick.force.norm();
        outcome_.peak_force = std::max(outcome_.peak_force, force);
        outcome_.impulse += force * dt;
        if (tick.time > 0.5 * (HandWay::rests + hand_.duration))
            outcome_.least_force = std::min(outcome_.least_force, force);
        if (has_tick_)
            outcome_.given_to_hand += last_force_.dot(tick.tool.position - last_place_);
        outcome_.hand_work = -outcome_.given_to_hand;
        last_force_ = tick.force;
        last_place_ = tick.tool.position;
        has_tick_ = true;
    }

    void note_step()
    {
        outcome_.peak_speed = std::max(outcome_.peak_speed, scene_.speed());
        outcome_.given_to_scene = scene_.energy() - energy_before_;
        outcome_.made_energy = std::max(outcome_.made_energy, outcome_.given_to_hand + outcome_.given_to_scene);
    }

    /// Energy from the program's change counts for neither side.
    void change()
    {
        if (scenario_.change && !changed_ && clock_.now() >= HandWay::rests + scenario_.change_time)
        {
            changed_ = true;
            outcome_.force_at_change = last_force_.norm();
            const double before = scene_.energy();
            scenario_.change(scene_);
            energy_before_ += scene_.energy() - before;
        }
    }

    const OdeUse ode_;
    SimulatedClock clock_;
    CouplingScene scene_;
    const CouplingCase &scenario_;
    HandWay hand_;
    bool decoupled_;
    bool changed_ = false;
    Outcome outcome_;
    double energy_before_;
    Vector3 pushed_ = Vector3::Zero();
    Vector3 last_force_ = Vector3::Zero();
    Vector3 last_place_ = Vector3::Zero();
    bool has_tick_ = false;
};

inline void expect_as_one(const Outcome &found, const Outcome &truth, const CouplingCase &scenario, double rate)
{
    EXPECT_GE(found.peak_force, 0.8 * truth.peak_force);
    EXPECT_LE(found.peak_force, 1.15 * truth.peak_force);
    EXPECT_LE(found.peak_speed, 1.2 * std::max(truth.peak_speed, scenario.hand.speed));
    EXPECT_LE(found.unmatched, scenario.most_unmatched);
    EXPECT_LE(found.made_energy, truth.made_energy + (rate < 100 ? 0.1 : 0.05) * std::abs(found.hand_work));
}

inline Vector3 offset_of(const CouplingCase &scenario, int hand)
{
    const double y = scenario.spread_along * (-1 + 2 * (hand + 0.5) / hands);
    const double z = scenario.spread_across * std::sin(7.0 * hand + 1);
    return {0, y, z};
}

inline Outcome ensemble(const CouplingCase &scenario, Stepper stepper, double physics_rate, double late = 0)
{
    std::vector<Outcome> outcomes;
    for (int hand = 0; hand < hands; ++hand)
        outcomes.push_back(CoupledRun(scenario, offset_of(scenario, hand), stepper, physics_rate, late).outcome());
    return mean_of(outcomes);
}

/// @param rates Hz; of the scene in two threads.
inline void expect_as_one_at(const std::vector<double> &rates, const CouplingCase &scenario, Stepper stepper)
{
    const Outcome truth = ensemble(scenario, stepper, one_thread);
    ASSERT_GT(truth.peak_force, 0.1);
    ASSERT_TRUE(!scenario.change || truth.force_at_change > 0.1);
    for (const double rate : rates)
    {
        SCOPED_TRACE(std::to_string(rate) + " Hz");
        expect_as_one(ensemble(scenario, stepper, rate), truth, scenario, rate);
    }
}

const std::vector<double> all_rates = {60, 100, 200, 500};
} // namespace ode_predictive_space::haptics

#endif
