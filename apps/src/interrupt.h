// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vericone {

/// From here on, Ctrl-C and a termination request only set a flag; a second one ends the program.
void catch_interrupts();
bool interrupted();

inline constexpr int kExitInterrupted = 130;

}  // namespace vericone
