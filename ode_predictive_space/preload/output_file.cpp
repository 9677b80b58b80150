#include "ode_predictive_space/preload/output_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

#include "ode_predictive_space/preload/say.h"

namespace ode_predictive_space::preload
{
OutputFile::OutputFile(const std::string &path)
    : path_(path), file_(open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666))
{
    if (file_ < 0)
        fail();
}

OutputFile::~OutputFile()
{
    if (file_ >= 0 && close(file_) != 0)
        fail();
}

bool OutputFile::write(const std::string &text)
{
    const NoSignalOfWriting quiet;
    for (std::size_t done = 0; done < text.size() && !failed_;)
    {
        const ssize_t written = ::write(file_, text.data() + done, text.size() - done);
        if (written >= 0)
            done += static_cast<std::size_t>(written);
        else if (errno != EINTR)
            fail();
    }
    return !failed_;
}

void OutputFile::fail()
{
    if (!failed_.exchange(true))
        say("%s cannot be written: %s", path_.c_str(), std::strerror(errno));
}
} // namespace ode_predictive_space::preload
