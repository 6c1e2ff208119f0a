// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "command/default_seed.h"
#include "output/output_options.h"

namespace vericone {

struct FitCommandOptions : OutputOptions {
  FitCommandOptions() { out = "out/fit"; }
  std::string file;
  std::string mode = "containing";    // or "least-squares", "robust"
  std::string shape = "auto";         // or the name of one
  std::string kinds;                  // of solids, with commas; empty: `shape` says it
  std::string urdf, sdf;              // the robot again, with other collisions; empty: no robot
  std::vector<std::string> packages;  // NAME=FOLDER
  std::optional<double> coverage;
  double margin = 0;  // metres
  int pieces = 1;
  std::uint64_t seed = kDefaultSeed;
  std::string cone;         // the agent of a comparison of cones; empty: none
  std::string check;        // the written result to check instead of fitting; empty: none
  std::string certificate;  // beside it: the file for what proves it; empty: none
};

/// `vericone fit`: a quadric hull of a scan, with what is proved of it (docs/reference/formats.md). Writes
/// fit.json, body.yaml, hull.obj, hull.ply, provenance.json and pictures to `out`, all together at the end or
/// none. Returns the exit status: 0; 1 where what is to contain the scan is not proved to or a surface has
/// not converged, and of a check where it fails; 130 interrupted. Throws InputError naming the file or an
/// option.
int run_fit(const FitCommandOptions& options, std::ostream& out);

/// What a folder of a fit may have.
const std::vector<std::string>& names_of_fit_files();

/// The rows of a fit's table that name its files.
void print_written(const std::string& folder, const std::vector<std::filesystem::path>& files,
                   std::ostream& out);

}  // namespace vericone
