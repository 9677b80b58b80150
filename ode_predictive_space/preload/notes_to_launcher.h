// Notes from the processes of a program to the launcher that waits for its end: single bytes in a file without a name.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_NOTES_TO_LAUNCHER_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_NOTES_TO_LAUNCHER_H

#include <memory>
#include <string>

namespace ode_predictive_space::preload
{
enum class Note : char
{
    began = 'b',    ///< a process has a space; one that was forked, when it uses it
    finished = 'f', ///< that process has written all that was asked for
    lost = 'l'      ///< some output could not be written
};

/// In a process of the program: leaves a note, unless there is no launcher.
void leave_note(Note note);

/// The launcher's file. Processes find it by an environment variable and open it through the launcher's entry in /proc, so that
/// they inherit no open file.
class NotesToLauncher
{
public:
    /// An empty file, which is named in the environment; 0 with errno when the system does not give it.
    static std::unique_ptr<NotesToLauncher> create();

    ~NotesToLauncher();
    NotesToLauncher(const NotesToLauncher &) = delete;
    NotesToLauncher &operator=(const NotesToLauncher &) = delete;

    int file() const { return file_; }

    /// How many such notes there are.
    long count(Note note) const;

private:
    explicit NotesToLauncher(int file) : file_(file) {}

    int file_;
};
} // namespace ode_predictive_space::preload

#endif
