// Expects the forces of a slide over ridges within 1 % of the truth, and more than `least_pressed` samples above 0.5 N.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_CONTACT_RIDGE_FORCES_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_CONTACT_RIDGE_FORCES_H

#include "tests/haptics/contact/contact_fixture.h"
#include "tests/haptics/support/ridges.h"

namespace ode_predictive_space::haptics
{
template <typename Samples>
void expect_forces_of_ridges(const Samples &samples, const RidgeShape &ridges, double least_pressed)
{
    ProxyAboveRidges proxy(ridges, radius, samples.front().tool.x());
    int pressed = 0;
    for (const auto &sample : samples)
    {
        const Vector3 truth = k * (proxy.follow(sample.tool) - sample.tool);
        ASSERT_LE((sample.requested - truth).norm(), 0.01 * truth.norm() + 1e-6)
            << sample.time << ": " << sample.requested.transpose() << " and not " << truth.transpose();
        pressed += truth.norm() > 0.5 ? 1 : 0;
    }
    EXPECT_GT(pressed, least_pressed);
}
} // namespace ode_predictive_space::haptics

#endif
