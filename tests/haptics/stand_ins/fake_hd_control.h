// Loads the stand-in for OpenHaptics' HD library, finds its control functions, and resets it.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_HD_CONTROL_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_HD_CONTROL_H

#include "tests/haptics/stand_ins/fake_hd.h"

#include <Eigen/Core>
#include <dlfcn.h>
#include <stdexcept>
#include <string>

class FakeHdControl : public FakeHd
{
public:
    FakeHdControl() : FakeHdControl(dlopen(FAKE_HD, RTLD_NOW | RTLD_LOCAL)) {}
    ~FakeHdControl() { dlclose(handle_); }
    FakeHdControl(const FakeHdControl &) = delete;
    FakeHdControl &operator=(const FakeHdControl &) = delete;

    Eigen::Vector3d playing() const
    {
        Eigen::Vector3d force;
        get_playing(force.data());
        return force;
    }

    Eigen::Vector3d playing_at_stop() const
    {
        Eigen::Vector3d force;
        get_playing_at_stop(force.data());
        return force;
    }

    std::uint64_t frames_without_force_at_stop() const
    {
        double force[3];
        return get_playing_at_stop(force);
    }

    std::string calls() const { return get_calls(); }

private:
    explicit FakeHdControl(void *handle) : FakeHd(control_in(handle)), handle_(handle) { reset(); }

    static const FakeHd &control_in(void *handle)
    {
        void *control = handle != nullptr ? dlsym(handle, "fake_hd_control") : nullptr;
        if (control == nullptr)
            throw std::runtime_error(dlerror());
        return *reinterpret_cast<decltype(&fake_hd_control)>(control)();
    }

    void *handle_;
};

#endif
