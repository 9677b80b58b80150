#include "ode_predictive_space/recording/history_file.h"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "ode_predictive_space/recording/no_signal_of_writing.h"

namespace ode_predictive_space::recording
{
HistoryFile::HistoryFile(const std::string &path, bool only_new)
    : file_(open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (only_new ? O_EXCL : 0), 0666))
{
    if (file_ < 0)
        error_ = errno;
    else if ((error_ = take()) != 0)
        ::close(std::exchange(file_, -1));
}

// Locks and empties the file. Devices, and files on a system without locks, are used without a lock. @return 0, or errno.
int HistoryFile::take()
{
    struct stat status;
    if (fstat(file_, &status) != 0 || !S_ISREG(status.st_mode))
        return 0;
    if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return EBUSY;
    return ftruncate(file_, 0) == 0 ? 0 : errno;
}

HistoryFile::~HistoryFile()
{
    close();
}

HistoryFile::HistoryFile(HistoryFile &&other) noexcept
    : file_(std::exchange(other.file_, -1)), error_(other.error_), size_(other.size_)
{}

bool HistoryFile::write(const std::string &records)
{
    const NoSignalOfWriting quiet;
    for (std::size_t done = 0; done < records.size() && error_ == 0;)
    {
        const ssize_t written = ::write(file_, records.data() + done, records.size() - done);
        if (written >= 0)
            done += static_cast<std::size_t>(written);
        else if (errno != EINTR)
            fail();
    }
    if (error_ == 0)
        size_ += records.size();
    return error_ == 0;
}

// The disk may be full: removes the part of a record that was written. A device keeps it.
void HistoryFile::fail()
{
    error_ = errno;
    [[maybe_unused]] const int cut = ftruncate(file_, static_cast<off_t>(size_));
}

void HistoryFile::give_up(int error)
{
    if (error_ == 0)
        error_ = error;
}

// A forked process may have the file open, and with it the lock: the lock is released explicitly.
bool HistoryFile::close()
{
    const int file = std::exchange(file_, -1);
    if (file >= 0)
        flock(file, LOCK_UN);
    if (file >= 0 && ::close(file) != 0 && error_ == 0)
        error_ = errno;
    return error_ == 0;
}

void HistoryFile::abandon()
{
    ::close(std::exchange(file_, -1));
}
} // namespace ode_predictive_space::recording
