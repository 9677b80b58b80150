// Moves a hand along a path through a scene, with both laws and both kinds of loops, and records each tick.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_CONTACT_CONTACT_FIXTURE_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_CONTACT_CONTACT_FIXTURE_H

#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/penalty_law.h"
#include "ode_predictive_space/haptics/proxy_law.h"
#include "tests/haptics/support/allocation_count.h"
#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/once.h"
#include "tests/haptics/support/probe_world.h"
#include "tests/haptics/support/ridges.h"
#include "tests/haptics/support/scripted_device.h"

#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <tuple>

namespace ode_predictive_space::haptics
{
constexpr double k = 500; // N/m

/// The parameters: whether the law is the proxy's, and whether the loop has two threads. With two, the space tests shapes.
class ContactTest : public testing::TestWithParam<std::tuple<bool, bool>>
{
protected:
    struct Sample
    {
        double time;
        Vector3 tool;
        Vector3 requested;         ///< N; the law's force
        Vector3 proxy;             ///< m; set by the proxy law only
        std::uint64_t allocations; ///< from the device's read() to its write()
    };

    bool proxy_law() const { return std::get<0>(GetParam()); }
    bool decoupled() const { return std::get<1>(GetParam()); }

    /// @param advanced called after each step of the scene, with the length of the step; may be empty.
    std::vector<Sample> run(const ScriptedDevice::Path &path, double duration,
                            const std::function<void(double)> &advanced = {})
    {
        Material properties;
        properties.stiffness = k;
        properties.friction = friction_;
        const auto penalty = std::make_shared<PenaltyLaw>(properties);
        const auto proxy = std::make_shared<ProxyLaw>(properties);
        ScriptedDevice device(path);
        HapticProbe probe(device, world_.space, radius, proxy_law() ? with_law(proxy) : with_law(penalty));
        probe_ = &probe;
        if (prepare_)
            prepare_(probe);
        std::vector<Sample> samples;
        std::uint64_t allocated = 0;
        device.before_read = [&] {
            allocated = allocation_count();
            if (clock_.now() > silent_from_ && clock_.now() < silent_until_)
                throw DeviceError(DeviceFault::failed, "it cannot be read");
        };
        probe.set_recorder([&](const RenderedTick &tick) {
            allocated = allocation_count() - allocated;
            samples.push_back({tick.time, tick.tool.position, tick.requested, proxy->proxy(), allocated});
        });
        LoopSettings settings = simulated(clock_, duration, decoupled(), physics_rate_);
        settings.rate = decoupled() ? 4000 : 1000;
        HapticLoop loop(probe, settings);
        loop.run(world_.work(probe, advanced));
        probe_ = nullptr;
        return samples;
    }

    static void expect_force_at_end(const std::vector<Sample> &samples, const Vector3 &force, double tolerance)
    {
        const Vector3 &last = samples.back().requested;
        EXPECT_LE((last - force).norm(), tolerance) << last.transpose() << " and not " << force.transpose();
    }

    static void expect_no_force(const std::vector<Sample> &samples, double from, double to)
    {
        for (const Sample &sample : samples)
        {
            if (sample.time >= from && sample.time < to)
            {
                ASSERT_TRUE(sample.requested.isZero(0))
                    << sample.time << " at " << sample.tool.transpose() << ": " << sample.requested.transpose();
            }
        }
    }

    const OdeUse ode_;
    ProbeWorld world_{decoupled() ? SpaceChoice::predictive_by_shape : SpaceChoice::predictive};
    SimulatedClock clock_;
    double friction_ = 0;
    double physics_rate_ = 1000;                 ///< Hz; of the scene, in two threads
    std::function<void(HapticProbe &)> prepare_; ///< called before the run; may be empty
    double silent_from_ = 0;                     ///< s; the device cannot be read from here
    double silent_until_ = 0;                    ///< s; to here
    HapticProbe *probe_ = nullptr;               ///< null between runs
};

/// Both laws in both kinds of loops.
const auto contact_tests = testing::Combine(testing::Bool(), testing::Bool());

inline std::string contact_test_name(const testing::TestParamInfo<std::tuple<bool, bool>> &parameters)
{
    return std::string(std::get<0>(parameters.param) ? "Proxy" : "Penalty") +
           (std::get<1>(parameters.param) ? "InTwoThreads" : "InOneThread");
}

/// Expects the forces of a slide over ridges within 1 % of the truth, and more than `least_pressed` samples above 0.5 N.
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

/// A heightfield in ODE, which points up along its frame's y, and its samples.
class OdeField
{
public:
    /// @param thickness m; of what ODE knows below the surface.
    explicit OdeField(HeightfieldSamples samples, double thickness = 0)
        : samples_(std::move(samples)), data_(dGeomHeightfieldDataCreate())
    {
        dGeomHeightfieldDataBuildDouble(data_, samples_.heights.data(), 1, samples_.width, samples_.depth,
                                        samples_.width_samples, samples_.depth_samples, samples_.scale, samples_.offset,
                                        thickness, 0);
    }
    ~OdeField() { dGeomHeightfieldDataDestroy(data_); }
    OdeField(const OdeField &) = delete;
    OdeField &operator=(const OdeField &) = delete;

    /// Adds the field with its y axis along the scene's z, and its x axis along x.
    dGeomID add_upright(dSpaceID space) const
    {
        const dGeomID geom = dCreateHeightfield(space, data_, 1);
        dMatrix3 turned;
        dRFromAxisAndAngle(turned, 1, 0, 0, std::acos(0.0));
        dGeomSetRotation(geom, turned);
        return geom;
    }

    dHeightfieldDataID data() const { return data_; }
    const HeightfieldSamples &samples() const { return samples_; }

private:
    HeightfieldSamples samples_;
    dHeightfieldDataID data_;
};

/// A cube about the origin whose surface only dCollide() knows.
class ConvexCube
{
public:
    explicit ConvexCube(dReal half)
    {
        for (int side = 0; side < 6; ++side)
        {
            const dReal sign = side % 2 == 0 ? 1 : -1;
            planes_.insert(planes_.end(),
                           {side / 2 == 0 ? sign : 0, side / 2 == 1 ? sign : 0, side / 2 == 2 ? sign : 0, half});
        }
        for (int corner = 0; corner < 8; ++corner)
            for (const int bit : {1, 2, 4})
                corners_.push_back((corner & bit) != 0 ? half : -half);
    }

    dGeomID add_to(dSpaceID space) const
    {
        return dCreateConvex(space, planes_.data(), 6, corners_.data(), 8, faces_.data());
    }

private:
    std::vector<dReal> planes_, corners_;
    const std::vector<unsigned> faces_ = {4, 1, 3, 7, 5, 4, 0, 4, 6, 2, 4, 2, 6, 7, 3,
                                          4, 0, 1, 5, 4, 4, 4, 5, 7, 6, 4, 0, 2, 3, 1};
};

/// A path from one point to another at constant speed, with a rest before and after it.
inline Vector3 between(const Vector3 &from, const Vector3 &to, double start, double length, double seconds)
{
    return from + std::clamp((seconds - start) / length, 0.0, 1.0) * (to - from);
}
} // namespace ode_predictive_space::haptics

#endif
