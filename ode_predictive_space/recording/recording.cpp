#include "ode_predictive_space/recording/recording.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "ode_predictive_space/recording/recording_check.h"

namespace ode_predictive_space::recording
{
Recording Recording::read(const std::string &path)
{
    std::error_code none;
    if (std::filesystem::is_directory(path, none))
        throw std::runtime_error("it is a folder");
    errno = 0;
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
    if (size < 0)
        throw std::runtime_error("cannot be read: " + std::string(std::strerror(errno ? errno : EIO)));
    std::vector<char> bytes(static_cast<std::size_t>(size));
    file.seekg(0);
    if (!file.read(bytes.data(), size))
        throw std::runtime_error("cannot be read: " + std::string(std::strerror(errno ? errno : EIO)));
    return Recording(std::move(bytes));
}

Recording::Recording(std::vector<char> bytes) : bytes_(std::move(bytes))
{
    Check check(*this);
    if (check.take_header())
        check.take_records();
}

std::size_t Recording::whole_bytes() const
{
    if (records_.empty())
        return std::min(bytes_.size(), header_size);
    return records_.back().content + records_.back().size;
}
} // namespace ode_predictive_space::recording
