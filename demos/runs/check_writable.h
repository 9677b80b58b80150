#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_CHECK_WRITABLE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_CHECK_WRITABLE_H

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace ode_predictive_space::worlds
{
/// Checks before a run that its results can be written; leaves the file as it was. @throws std::runtime_error when they cannot.
inline void check_writable(const std::string &file)
{
    const bool existed = std::filesystem::exists(file);
    errno = 0;
    if (!std::ofstream(file, std::ios::app))
        throw std::runtime_error(file + " cannot be written: " + std::strerror(errno ? errno : EIO));
    if (!existed)
        std::filesystem::remove(file);
}
} // namespace ode_predictive_space::worlds

#endif
