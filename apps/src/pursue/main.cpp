// SPDX-License-Identifier: BSD-3-Clause
//
// The program `vericone-pursue`, which links OpenCV (Apache-2.0) and its codecs.
#include <iostream>

#include "command/program.h"
#include "json/json_value.h"
#include "output/schemas.h"
#include "pursue/pursue_command.h"
#include "pursuits/read_pursuit.h"

namespace {

int check_command(vericone::CommandLine& line) {
  std::string file;
  bool json = false;
  line.option("file", file, "Pursuit, YAML (docs/reference/pursuits.md)").required();
  line.flag("--json", json, "Print JSON: labels with their texts");
  line.read();
  return vericone::pursuit::check_pursuit(file, json, std::cout);
}

int schema_command(vericone::CommandLine&) {
  std::cout << vericone::input::schema_text(vericone::pursuit::pursuit_schema());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return vericone::run_program(argc, argv, "pursue", vericone::pursue_command,
                               {{"check", check_command}, {"schema", schema_command}});
}
