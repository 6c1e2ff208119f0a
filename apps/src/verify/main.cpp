// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program `vericone-verify`, which links CGAL.
#include <vericone/geometry/error.h>
#include <iostream>

#include "command/output_line.h"
#include "command/program.h"
#include "verify/verify_command.h"

namespace {

int verify_command(vericone::CommandLine& line) {
  vericone::VerifyOptions verify;
  line.option("--cases", verify.cases, "Cases of each predicate, 0: none").within(0, 10'000'000'000);
  const auto pairs =
      line.option("--pairs", verify.pairs, "Pairs of each family of sectors and cones, 0: none")
          .within(0, 10'000'000);
  line.option("--seed", verify.seed, "Seed of all random numbers");
  vericone::part_option(line, verify.part, "reports alone: one of each predicate and family");
  line.option("--threads", verify.threads, "Threads, 0: one per processor");
  line.flag("--quiet", verify.quiet, "No progress");
  line.flag("--json", verify.json, "Print JSON");
  line.read();
  if (verify.cases == 0 && !(pairs.given() && verify.pairs > 0))
    throw vericone::InputError("--cases", "0",
                               "above 0, or given with --pairs above 0: no case shows nothing");
  return vericone::run_verify(verify, std::cout);
}

}  // namespace

int main(int argc, char** argv) { return vericone::run_program(argc, argv, "verify", verify_command); }
