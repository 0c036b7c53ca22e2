#pragma once

namespace vlbeam {

/// Lets a computation end in good order where the user or the system wants it to (Ctrl-C, SIGTERM, SIGHUP, SIGXCPU):
/// what was computed so far is still reported. A second Ctrl-C, half a second later or more, ends the
/// program at once. A SIGHUP that is ignored already (nohup) stays ignored.
void install_interrupt_handler();

/// A file that grows beyond the user's limit becomes an error of writing, which leaves no part of the file behind;
/// without this it would end the program.
void ignore_file_size_signal();

/// Number of the signal that asked the program to stop; 0 if none did.
int interruption();
inline bool interrupted() { return interruption() != 0; }

/// Asks running computations to stop, as that signal would; 0 takes it back. For programs with signal handlers of their
/// own.
void ask_to_stop(int signal);

/// Exit code of a program that a signal stopped: 128 plus the signal, as in shells (130 for Ctrl-C).
inline int interrupted_exit_code() { return 128 + interruption(); }

}  // namespace vlbeam
