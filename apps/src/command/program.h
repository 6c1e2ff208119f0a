// SPDX-License-Identifier: BSD-3-Clause
//
// What the programs of the family have in common: `vericone`, which has the core commands and starts the
// others, and `vericone-NAME`, each with one command. Results go to standard output, progress and errors to
// standard error. Exit status: 0 done, 1 something outside the program failed, 2 bad input, 130 interrupted.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "command/command_line.h"

namespace vericone {

/// Declares its options, reads them and does its work; returns the exit status.
using Command = int (*)(CommandLine&);

/// The main function of `vericone`: carries out one of `commands`, or becomes the program of another one
/// (find_program.h).
int run_family(int argc, char** argv, const std::map<std::string, Command>& commands);

/// The main function of `vericone-NAME`; of `others` it carries out what hand_over() asked for.
int run_program(int argc, char** argv, const std::string& name, Command command,
                const std::map<std::string, Command>& others = {});

/// `vericone COMMAND WORDS...` goes on as the program of `owner`, which alone links what it takes.
/// Throws InputError naming `field` where that program is not there.
[[noreturn]] void hand_over(const std::string& owner, const std::string& command,
                            const std::vector<std::string>& words, const std::string& field);

}  // namespace vericone
