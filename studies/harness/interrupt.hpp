#pragma once

namespace vlbeam {

/// Lets a computation end in good order where the user or the system wants it to (Ctrl-C, SIGTERM, SIGHUP, SIGXCPU):
/// what was computed so far is still reported. A second Ctrl-C, half a second later or more, ends the
/// program at once. A SIGHUP that is ignored already (nohup) stays ignored.
void install_interrupt_handler();

/// Makes a file that grows beyond the user's limit an error of writing it, which leaves no part of the file behind,
/// instead of the end of the program.
void ignore_file_size_signal();

/// Number of the signal by which the program was asked to stop, or 0.
int interruption();
inline bool interrupted() { return interruption() != 0; }

/// Asks what runs to stop, as that signal would; 0 takes it back. For programs whose signals are not the harness's.
void ask_to_stop(int signal);

/// What the program then answers to its caller: 128 and the signal, as shells have it (130 for Ctrl-C).
inline int interrupted_exit_code() { return 128 + interruption(); }

}  // namespace vlbeam
