#ifndef ODE_PREDICTIVE_SPACE_HISTORY_HISTORY_FILE_H
#define ODE_PREDICTIVE_SPACE_HISTORY_HISTORY_FILE_H

#include <cstdint>
#include <string>

namespace ode_predictive_space::history
{
/// The file that a recorder writes. It ends with a whole record at any time, also after a write that failed.
class HistoryFile
{
public:
    /// @param only_new a file that exists is left alone; otherwise its content is lost.
    HistoryFile(const std::string &path, bool only_new);
    ~HistoryFile();
    HistoryFile(HistoryFile &&other) noexcept;
    HistoryFile &operator=(HistoryFile &&) = delete;

    bool is_open() const { return file_ >= 0; }

    /// errno of the first call that failed; 0: none has.
    int error() const { return error_; }

    std::uint64_t size() const { return size_; }

    /// @return whether all of it is written. After a failure nothing more is.
    bool write(const std::string &records);

    /// @return whether everything is written.
    bool close();

    /// Closes it and takes it for another process's.
    void abandon();

private:
    void fail();

    int file_;
    int error_ = 0;
    std::uint64_t size_ = 0;
};
} // namespace ode_predictive_space::history

#endif
