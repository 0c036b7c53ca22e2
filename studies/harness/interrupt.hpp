#pragma once

namespace vlbeam {

/// Lets Ctrl-C end a computation in good order: what was computed so far is still reported.
/// A second Ctrl-C ends the program at once.
void install_interrupt_handler();

/// Whether the user asked to stop.
bool interrupted();

}  // namespace vlbeam
