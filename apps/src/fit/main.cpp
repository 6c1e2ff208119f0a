// SPDX-License-Identifier: BSD-3-Clause
//
// The program `vericone-fit`, which links Ceres (BSD-3-Clause) and Qhull (its own licence, free with notice).
// Where Ceres brings SuiteSparse, the linked program is under the GPL by a part of CHOLMOD.
#include <vericone/geometry/error.h>
#include <iostream>

#include "command/program.h"
#include "fit/fit_command.h"

namespace {

std::string seed_complaint(const std::string& word) {
  return word.starts_with("-") ? "got " + word + ", must be a whole number, 0 or more" : std::string();
}

int fit_command(vericone::CommandLine& line) {
  vericone::FitCommandOptions fit;
  using Option = vericone::CommandLine::Option;
  std::vector<std::pair<std::string, Option>> of_fits;
  const auto option_of_fits = [&](const char* name, auto& target, const char* what) {
    return of_fits.emplace_back(name, line.option(name, target, what)).second;
  };
  line.option("file", fit.file, "Mesh, cloud or octree map, or a robot (docs/reference/files.md)").required();
  option_of_fits("--mode", fit.mode, "least-squares, robust, or containing: proved to contain the scan");
  option_of_fits("--shape", fit.shape,
                 "ellipse (a footprint), ellipsoid, biconcave, biconvex, star, or auto: chosen of these and "
                 "explained; or "
                 "sphere, capsule, cylinder, box");
  option_of_fits(
      "--kinds", fit.kinds,
      "In place of --shape: some of sphere, capsule, cylinder, box, ellipsoid, with commas; each piece is "
      "the smallest of them");
  double coverage = 1;
  const Option coverage_option =
      option_of_fits("--coverage", coverage,
                     "Share of the points to be inside; containing: 1 if not given, otherwise the surface "
                     "stays where it was fitted")
          .shown_default("");
  option_of_fits("--margin", fit.margin, "Radius of balls about the points to be inside, metres");
  option_of_fits("--pieces", fit.pieces, "Bodies whose union is the hull");
  option_of_fits(
      "--urdf", fit.urdf,
      "Of a robot, URDF: write it here again, the collisions of each link replaced by pieces that are "
      "proved to contain them");
  option_of_fits("--sdf", fit.sdf, "The same of SDF");
  line.option("--package", fit.packages,
              "NAME=FOLDER of a robot's package://NAME/ or model://NAME/ (repeatable)")
      .one_each();
  option_of_fits("--seed", fit.seed, "Seed of all random numbers").check(seed_complaint);
  option_of_fits("--cone", fit.cone,
                 "Compare the cones of scan and hulls for an agent: x,y,z,radius, around:N, or a file");
  const Option check = line.option(
      "--check", fit.check,
      "Instead of fitting: repeat the certificate of this fit.json, or of a robot against this one; 1: "
      "it does not hold");
  const Option certificate =
      line.option("--certificate", fit.certificate,
                  "With --check: write to this file what proves it, for programs that check it "
                  "(docs/reference/certificates.md)");
  line.flag("--json", fit.json, "Print JSON");
  line.option("--out", fit.out, "Folder for result, meshes and picture");
  line.negative_flag("--no-figures", fit.figures, "Result and meshes only");
  line.flag("--quiet", fit.quiet, "No progress");
  line.read();
  for (const auto& [name, option] : of_fits)
    if (check.given() && option.given())
      throw vericone::InputError("--check", fit.check, "given without " + name + ", which is of a fit");
  if (certificate.given() && !check.given())
    throw vericone::InputError("--certificate", fit.certificate, "given beside --check");
  if (coverage_option.given()) fit.coverage = coverage;
  fit.command_line = line.text();
  return vericone::run_fit(fit, std::cout);
}

}  // namespace

int main(int argc, char** argv) { return vericone::run_program(argc, argv, "fit", fit_command); }
