// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <iostream>

#include "commands.h"
#include "json/json_value.h"
#include "output/schemas.h"
#include "paper/paper_fields.h"
#include "scenarios/populations/read_population.h"
#include "scenarios/schema.h"
#include "scenarios/tracks_json.h"

namespace vericone {
namespace {

using Print = void (*)();

void print(const Json& schema) { std::cout << input::schema_text(schema); }

}  // namespace

/// `vericone schema`: what an editor needs to complete and check a file (docs/schemas has its output).
int schema_command(CommandLine& line) {
  std::string kind;
  line.option("kind", kind,
              "One of body, scene, scenario, tracks, claims, figures, scan, pursuit, population")
      .required();
  line.quiet();
  line.read();
  input::choice<Print>({{"body", [] { print(input::body_schema()); }},
                        {"scene", [] { print(input::scene_schema()); }},
                        {"scenario", [] { print(scenario::scenario_schema()); }},
                        {"tracks", [] { print(scenario::tracks_schema()); }},
                        {"claims", [] { print(paper::claims_schema()); }},
                        {"figures", [] { print(paper::figures_schema()); }},
                        {"population", [] { print(populations::population_schema()); }},
                        {"scan", [] { hand_over("scan", "schema", {}, "kind"); }},
                        {"pursuit", [] { hand_over("pursue", "schema", {}, "kind"); }}})
      .read(kind, "kind")();
  return 0;
}

}  // namespace vericone
