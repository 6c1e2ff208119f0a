// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "output/output_options.h"

namespace vericone::paper {

/// `out` empty: out/ and the paper's name.
struct FiguresOptions : OutputOptions {
  std::vector<std::string> ids;  // empty: all
  std::string paper;             // its folder, or the name of one of ours; empty: papers/dhal2022
  std::string scenario;  // file in place of the one scenario that the figures show; empty: the paper's
  std::vector<std::string> set;  // PATH=VALUE, in the scenarios that the figures show
  bool list = false;
};

/// `vericone figures`: makes the figures of a paper, each as PDF, PNG, CSV and JSON of its provenance, the
/// runs they show, claims.json and report.html. Returns the exit status, 130 interrupted. Throws InputError.
int run_figures(const FiguresOptions& options, std::ostream& out);

}  // namespace vericone::paper
