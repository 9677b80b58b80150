// Loads the stand-in for OpenHaptics' HD library, finds its control functions, and resets it.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_HD_CONTROL_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_HD_CONTROL_H

#include "tests/haptics/stand_ins/fake_hd.h"

#include <Eigen/Core>
#include <dlfcn.h>
#include <stdexcept>
#include <string>

class FakeHdControl
{
public:
    FakeHdControl() : handle_(dlopen(FAKE_HD, RTLD_NOW | RTLD_LOCAL))
    {
        if (handle_ == nullptr)
            throw std::runtime_error(dlerror());
        find("fake_hd_set_motion", set_motion);
        find("fake_hd_set_rate", set_rate);
        find("fake_hd_set_calibration", set_calibration);
        find("fake_hd_fail", fail);
        find("fake_hd_pause", pause);
        find("fake_hd_step", step);
        find("fake_hd_resume", resume);
        find("fake_hd_frames", frames);
        find("fake_hd_is_enabled", is_enabled);
        find("fake_hd_playing", playing_);
        find("fake_hd_playing_at_stop", playing_at_stop_);
        find("fake_hd_calls", calls_);
        void (*reset)() = nullptr;
        find("fake_hd_reset", reset);
        reset();
    }
    ~FakeHdControl() { dlclose(handle_); }
    FakeHdControl(const FakeHdControl &) = delete;
    FakeHdControl &operator=(const FakeHdControl &) = delete;

    decltype(&fake_hd_set_motion) set_motion = nullptr;
    decltype(&fake_hd_set_rate) set_rate = nullptr;
    decltype(&fake_hd_set_calibration) set_calibration = nullptr;
    decltype(&fake_hd_fail) fail = nullptr;
    decltype(&fake_hd_pause) pause = nullptr;
    decltype(&fake_hd_step) step = nullptr;
    decltype(&fake_hd_resume) resume = nullptr;
    decltype(&fake_hd_frames) frames = nullptr;
    decltype(&fake_hd_is_enabled) is_enabled = nullptr;

    Eigen::Vector3d playing() const
    {
        Eigen::Vector3d force;
        playing_(force.data());
        return force;
    }

    Eigen::Vector3d playing_at_stop() const
    {
        Eigen::Vector3d force;
        playing_at_stop_(force.data());
        return force;
    }

    std::uint64_t frames_without_force_at_stop() const
    {
        double force[3];
        return playing_at_stop_(force);
    }

    std::string calls() const { return calls_(); }

private:
    template <typename Function> void find(const char *name, Function *&function)
    {
        function = reinterpret_cast<Function *>(dlsym(handle_, name));
        if (function == nullptr)
            throw std::runtime_error(name);
    }

    void *handle_;
    decltype(&fake_hd_playing) playing_ = nullptr;
    decltype(&fake_hd_playing_at_stop) playing_at_stop_ = nullptr;
    decltype(&fake_hd_calls) calls_ = nullptr;
};

#endif
