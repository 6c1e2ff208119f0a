// SPDX-License-Identifier: BSD-3-Clause
//
// The program `vericone-scan`, which links Embree (Apache-2.0) and Open3D (MIT).
#include <iostream>

#include "command/output_line.h"
#include "command/program.h"
#include "json/json_value.h"
#include "output/schemas.h"
#include "scan/lidar_fields.h"
#include "scan/run_scan.h"

namespace {

int scan_command(vericone::CommandLine& line) {
  vericone::ScanOptions scan;
  line.option("scene", scan.scene, "Scene file with a mesh and lidars (docs/reference/formats.md)")
      .required();
  line.option("--planes", scan.planes, "Planes through what is seen");
  line.option("--levels", scan.levels, "How often the beams are made twice as fine, and one more");
  line.option("--azimuth", scan.azimuth, "Of the plane of the picture, radians");
  line.option("--seed", scan.seed, "Seed of all random numbers");
  read_files_line(line, scan);
  vericone::run_scan(scan, std::cout);
  return 0;
}

int schema_command(vericone::CommandLine&) {
  std::cout << vericone::input::schema_text(vericone::scanning::scan_schema());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return vericone::run_program(argc, argv, "scan", scan_command, {{"schema", schema_command}});
}
