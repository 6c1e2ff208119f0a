// SPDX-License-Identifier: BSD-3-Clause
//
// The program `vericone-pursue`, which links OpenCV (Apache-2.0) and its codecs.
#include <iostream>

#include "command/output_line.h"
#include "command/program.h"
#include "json/json_value.h"
#include "output/schemas.h"
#include "pursue/pursue_command.h"
#include "pursuits/read_pursuit.h"

namespace {

int pursue_command(vericone::CommandLine& line) {
  vericone::pursuit::PursueOptions pursue;
  line.option("scenario", pursue.scenario, "Pursuit, YAML (docs/reference/pursuits.md)").required();
  line.option("--camera", pursue.camera, "perspective, source (straight down, clean) or exact (no pictures)")
      .shown_default("perspective");
  line.option("--tracker", pursue.tracker, "ours or source").shown_default("ours");
  line.option("--law", pursue.law, "ours or source").shown_default("ours");
  line.option("--duration", pursue.duration, "Seconds").shown_default("the scenario's");
  line.option("--seed", pursue.seed, "Seed of all random numbers").shown_default("the scenario's");
  line.option("--video", pursue.video, "Also a video (MP4) of what the camera sees, with boxes");
  line.option("--frames", pursue.frames,
              "Also every picture as PNG, with own.csv, camera.yaml and boxes.txt for vericone track --own");
  line.option("--starts", pursue.starts, "In place of one run: so many, from starts near each other")
      .within(0, 100'000);
  line.option("--within", pursue.within, "Metres between the starts of --starts, at most");
  line.option("--random", pursue.random,
              "In place of one run: so many short ones, each with one vehicle hidden for 3 s")
      .within(0, 100'000);
  vericone::part_option(line, pursue);
  line.option("--out", pursue.out, "Folder for tables and pictures");
  line.option("--threads", pursue.threads, "Of --starts and --random; 0: one per processor");
  line.negative_flag("--no-figures", pursue.figures, "Tables only");
  line.flag("--quiet", pursue.quiet, "No progress");
  line.flag("--json", pursue.json, "Print JSON");
  line.read();
  vericone::keep_words(line, pursue);
  return vericone::pursuit::run_pursue(pursue, std::cout);
}

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
  return vericone::run_program(argc, argv, "pursue", pursue_command,
                               {{"check", check_command}, {"schema", schema_command}});
}
