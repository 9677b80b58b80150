// OpenHaptics' HD library, loaded at run time, and what its errors mean to us.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_HD_LIBRARY_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_HD_LIBRARY_H

#include "ode_predictive_space/haptics/device.h"
#include "ode_predictive_space/haptics/device/hd_abi.h"

#include <string>
#include <vector>

namespace ode_predictive_space::haptics
{
/// What an error in the servo thread leads to.
enum class HdConsequence
{
    pause, ///< no force for a while
    lost,  ///< the device answers no more
    failed ///< the library cannot go on
};

HdConsequence consequence_of(std::uint32_t error_code);

/// As in the library's own header, "HD_WARM_MOTORS"; "unknown error" for a code that is not known.
const char *name_of_hd_error(std::uint32_t error_code);

/// The library. It stays in the process for good: it may have threads that run on.
class HdLibrary
{
public:
    /// Loads the first of the files that can be loaded.
    ///
    /// @throws DeviceError missing_library with the linker's words for each of the files; missing_symbol.
    explicit HdLibrary(const std::vector<std::string> &files);
    ~HdLibrary();
    HdLibrary(const HdLibrary &) = delete;
    HdLibrary &operator=(const HdLibrary &) = delete;

    const hd::Functions *operator->() const { return &functions_; }

    /// Takes all errors off the library's stack.
    ///
    /// @return the oldest of those that are more than a pause, which others follow from; if there is none, the oldest;
    /// if there is none at all, success.
    hd::ErrorInfo take_errors() const;

    /// "HD_WARM_MOTORS (0x200, internal code 5): " and what the library says of it.
    std::string describe(std::uint32_t error_code, int internal_code) const;

private:
    void *handle_ = nullptr;
    hd::Functions functions_{};
};
} // namespace ode_predictive_space::haptics

#endif
