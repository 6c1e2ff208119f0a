// SPDX-License-Identifier: BSD-3-Clause
//
// The commands that the program `vericone` carries out itself: each declares its options, reads them and does
// its work, and returns the exit status. Each stands in a folder of its name.
#pragma once

#include "command/program.h"

namespace vericone {

int cone_command(CommandLine& line);
int query_command(CommandLine& line);
int bands_command(CommandLine& line);
int avoid_command(CommandLine& line);
int accuracy_command(CommandLine& line);
int signmap_command(CommandLine& line);
int gallery_command(CommandLine& line);
int shapes_command(CommandLine& line);
int merge_command(CommandLine& line);
int view_command(CommandLine& line);

// What moves: not in a build without VERICONE_SIMULATION.
int robust_law_command(CommandLine& line);
int law_command(CommandLine& line);
int estimate_command(CommandLine& line);
int check_command(CommandLine& line);
int schema_command(CommandLine& line);
int reach_command(CommandLine& line);
int certify_command(CommandLine& line);
int simulate_command(CommandLine& line);
int campaign_command(CommandLine& line);
int swarm_command(CommandLine& line);
int trials_command(CommandLine& line);
int claims_command(CommandLine& line);
int figures_command(CommandLine& line);
int paper_command(CommandLine& line);

}  // namespace vericone
