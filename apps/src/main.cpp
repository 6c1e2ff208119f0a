// SPDX-License-Identifier: BSD-3-Clause
//
// The program `vericone`: its own commands, and the way to the programs of the others.
#include "command/program.h"
#include "commands.h"

int main(int argc, char** argv) {
  using namespace vericone;
  std::map<std::string, Command> commands{{"cone", cone_command},         {"query", query_command},
                                          {"accuracy", accuracy_command}, {"signmap", signmap_command},
                                          {"gallery", gallery_command},   {"shapes", shapes_command},
                                          {"merge", merge_command},       {"bands", bands_command},
                                          {"avoid", avoid_command},       {"view", view_command}};
#ifdef VERICONE_WITH_SIMULATION
  commands.merge(std::map<std::string, Command>{{"robust-law", robust_law_command},
                                                {"law", law_command},
                                                {"estimate", estimate_command},
                                                {"check", check_command},
                                                {"schema", schema_command},
                                                {"reach", reach_command},
                                                {"certify", certify_command},
                                                {"simulate", simulate_command},
                                                {"campaign", campaign_command},
                                                {"swarm", swarm_command},
                                                {"trials", trials_command},
                                                {"claims", claims_command},
                                                {"figures", figures_command},
                                                {"paper", paper_command}});
#endif
  return run_family(argc, argv, commands);
}
