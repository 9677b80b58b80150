#ifndef ODE_PREDICTIVE_SPACE_RECORDING_HISTORY_FILE_H
#define ODE_PREDICTIVE_SPACE_RECORDING_HISTORY_FILE_H

#include <cstdint>
#include <string>

namespace ode_predictive_space::recording
{
/// The file of a recorder, locked while it is open. It ends with a whole record after each write, also after one that failed.
class HistoryFile
{
public:
    /// @param only_new refuses an existing file (EEXIST). Otherwise it is emptied, unless another recording writes it (EBUSY).
    HistoryFile(const std::string &path, bool only_new);
    ~HistoryFile();
    HistoryFile(HistoryFile &&other) noexcept;
    HistoryFile &operator=(HistoryFile &&) = delete;

    bool is_open() const { return file_ >= 0; }

    /// errno of the first failure; 0: there was none.
    int error() const { return error_; }

    std::uint64_t size() const { return size_; }

    /// @return whether all of it is written. After a failure nothing more is.
    bool write(const std::string &records);

    /// Ends writing because of an error outside of the file.
    void give_up(int error);

    bool close();

    /// Closes it in a forked process; the file remains the parent's.
    void abandon();

private:
    int take();
    void fail();

    int file_;
    int error_ = 0;
    std::uint64_t size_ = 0;
};
} // namespace ode_predictive_space::recording

#endif
