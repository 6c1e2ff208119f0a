// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vericone {

/// From here on, Ctrl-C and a termination request set a flag. Where the program has not ended some tenths of
/// a second after that, it is ended and leaves no unfinished files: most work looks at the flag too seldom,
/// or never. A second request ends it at once.
void catch_interrupts();
bool interrupted();

/// For a command that looks at the flag often and then tells what it has: it is not ended.
void end_by_ourselves();

inline constexpr int kExitInterrupted = 130;

}  // namespace vericone
