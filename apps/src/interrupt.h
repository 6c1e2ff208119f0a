// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vericone {

/// From here on, Ctrl-C and a termination request only set a flag; a second one ends the program.
void catch_interrupts();
bool interrupted();

/// The same for work that looks at the flag too seldom and has nothing to save: where it has not ended
/// some tenths of a second after the flag was set, the program ends and leaves no unfinished files.
void catch_interrupts_and_end();

inline constexpr int kExitInterrupted = 130;

}  // namespace vericone
