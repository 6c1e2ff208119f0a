// SPDX-License-Identifier: BSD-3-Clause
//
// The program `vericone`: the core commands, and the way to the programs of the others.
#include "command/program.h"
#include "commands.h"

int main(int argc, char** argv) {
  auto commands = vericone::core_commands();
  commands.merge(vericone::simulation_commands());
  return vericone::run_family(argc, argv, commands);
}
