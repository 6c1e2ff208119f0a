// SPDX-License-Identifier: BSD-3-Clause
#include "commands.h"

#include <vericone/geometry/error.h>
#include <iostream>

#include "accuracy/accuracy.h"
#include "accuracy/combined_accuracy.h"
#include "cone/cone.h"
#include "estimate/estimate_command.h"
#include "gallery/gallery.h"
#include "law/law_command.h"
#include "query/query.h"
#include "robust_law/robust_law_command.h"
#include "shapes/shapes.h"
#include "signmap/signmap.h"
#include "work/threads.h"

namespace vericone {
namespace {

int cone_command(CommandLine& line) {
  ConeCommand cone;
  line.option("scene", cone.scene, "Scene file, YAML (docs/reference/formats.md); - for standard input")
      .required();
  line.flag("--cases", cone.cases, "The file has a scene on every line, as JSON; prints an answer a line");
  line.option("--method", cone.method,
              "exact: the true cone with its error bound; slice: the source's, too small");
  line.option("--planes", cone.planes,
              "Planes of the slice cone (36); half-planes of the cone of a body of pieces (64)");
  line.option("--tangents", cone.tangents,
              "Slices of combined quadrics: all candidates compared, or the source's choice, by-sides "
              "(6.3.2) or printed (5.2.2)");
  line.option("--samples", cone.samples, "Boundary samples of the exact cone of ellipsoids")
      .shown_default(std::to_string(kDefaultSamples));
  line.option("--tolerance", cone.tolerance,
              "Certified cone: solid angle between inner and outer, relative (0.01), combined quadrics "
              "always; bodies of pieces: width of each extreme angle, radians (0.0001)");
  std::vector<double> resolution, around;
  const auto map = line.option("--map", resolution,
                               "Map of all directions: colliding, safe, undecided cells, down to this size")
                       .shown_type("[RADIANS]")
                       .words(0, 1)
                       .shown_default(to_text(kDefaultResolution));
  line.option("--around", around, "x,y,z: the map's region that holds this direction")
      .commas()
      .words(3, 3)
      .needs(map);
  line.flag("--json", cone.json, "Print JSON");
  line.option("--out,--picture", cone.picture_folder, "Folder for a picture of bodies and cones");
  line.negative_flag("--no-figures", cone.figures, "Of the picture, its data only");
  line.option("--threads", cone.threads, "Threads of map and picture, 0: one per processor");
  line.quiet();
  line.read();
  if (map.given()) {
    cone.map.emplace();
    cone.map->threads = threads_for(cone.threads);
    if (!resolution.empty()) cone.map->resolution = resolution.front();
    if (!around.empty()) cone.map->around = Eigen::Vector3d(around[0], around[1], around[2]);
  }
  return run_cone(cone, std::cout);
}

int query_command(CommandLine& line) {
  std::string cases;
  bool with_rung = false;
  line.option("cases", cases, "File of cases, or - for standard input").required();
  int threads = 0;
  line.flag("--rung", with_rung, "Add the rung of the ladder that decided: triage, interval or exact");
  line.option("--threads", threads, "Threads, 0: one per processor; the answers are the same");
  bool json = true;
  line.flag("--json", json, "Print JSON; this command prints nothing else");
  line.quiet();
  line.read();
  return run_query(cases, with_rung, threads_for(threads), std::cout);
}

int robust_law_command(CommandLine& line) {
  std::string cases;
  line.option("cases", cases, "File of cases (docs/explanation/robust-law.md), or - for standard input")
      .required();
  bool json = true;
  line.flag("--json", json, "Print JSON; this command prints nothing else");
  line.quiet();
  line.read();
  return run_robust_law(cases, std::cout);
}

int law_command(CommandLine& line) {
  std::string cases;
  line.option("states", cases, "File of states (docs/explanation/pursuit.md), or - for standard input")
      .required();
  bool json = true;
  line.flag("--json", json, "Print JSON; this command prints nothing else");
  line.quiet();
  line.read();
  return run_law(cases, std::cout);
}

int estimate_command(CommandLine& line) {
  EstimateOptions estimate;
  std::string out;
  line.option("track", estimate.track,
              "CSV with the columns t, x, y (s, m; x and y empty where hidden) and, where it has one, r (m); "
              "- for "
              "standard input")
      .required();
  line.option("--alpha", estimate.alpha, "Of Singer's model, 1/s");
  line.option("--variance", estimate.variance, "Of the acceleration along x and y, m^2/s^4")
      .words(2, 2)
      .shown_type("X Y")
      .shown_default("0.1 0.05");
  line.option("--noise", estimate.noise,
              "Standard deviation of a measured coordinate, m, where r does not say");
  line.option(
      "--hidden", estimate.hidden,
      "skip: a hidden target gives no measurement; source: its last estimate, with 10 times the variance");
  const auto folder =
      line.option("--out", out, "Folder for the table of estimates; if not given, it is printed");
  line.flag("--json", estimate.json, "Print JSON");
  line.quiet();
  line.read();
  if (folder.given()) estimate.out = out;
  estimate.command_line = line.text();
  run_estimate(estimate, std::cout);
  return 0;
}

int accuracy_command(CommandLine& line) {
  accuracy::Options options;
  line.option("--obstacle", options.obstacle,
              "Obstacles of the random engagements: ellipsoid, biconcave, biconvex or star");
  line.option("-N,--engagements", options.engagements,
              "Random engagements; by default 10000, or 1000 with other obstacles than ellipsoids")
      .shown_default("10000");
  line.option("--tolerance", options.tolerance,
              "Of the certified cone that slices are held against, with other obstacles than ellipsoids")
      .shown_default(to_text(accuracy::kReferenceTolerance));
  line.option("--semi-axes", options.semi_axes, "Of the random bodies, metres")
      .words(2, 2)
      .shown_type("LOW HIGH")
      .shown_default("1 10");
  line.option("--distance", options.distance,
              "Of their centres, metres; if not given, 1.5 to 3 times what just separates the bodies")
      .words(2, 2)
      .shown_type("LOW HIGH");
  line.option("--cases", options.cases,
              "Pairs of ellipsoids instead of random ones: a file of cases as of query, velocities left out "
              "or ignored");
  line.option("--scan", options.scans, "Mesh or cloud files, or folders of them").words(1, -1);
  line.option("--approaches", options.approaches, "Engagements per scanned object");
  line.option("--planes", options.planes, "Plane counts; the largest is the reference of the others")
      .words(1, -1)
      .commas();
  line.option("--seed", options.seed, "Seed of all random numbers");
  line.option("--out", options.out, "Folder for tables and pictures").shown_default("out/accuracy");
  line.option("--threads", options.threads, "Threads, 0: one per processor");
  line.negative_flag("--no-figures", options.figures, "Tables only");
  line.flag("--quiet", options.quiet, "No progress");
  line.flag("--json", options.json, "Print JSON: summary.json");
  line.read();
  options.command_line = line.text();
  return accuracy::run_accuracy(options, std::cout);
}

int signmap_command(CommandLine& line) {
  SignMapOptions signmap;
  line.option("--out", signmap.out, "Folder for table and picture");
  line.option("--cells", signmap.cells, "Doubles along each axis");
  line.option("--seed", signmap.seed, "Seed of the engagement");
  line.negative_flag("--no-figures", signmap.figures, "Tables only");
  line.flag("--json", signmap.json, "Print JSON: signmap.json");
  line.quiet();
  line.read();
  signmap.command_line = line.text();
  run_signmap(signmap, std::cout);
  return 0;
}

int gallery_command(CommandLine& line) {
  GalleryOptions gallery;
  line.option("files", gallery.files, "Files, or folders of them").required().words(1, -1);
  line.option("--out", gallery.out, "Folder for tables and pictures");
  line.option("--planes", gallery.half_planes, "Half-planes of each cone");
  line.option("--tolerance", gallery.tolerance, "Of their angles, radians");
  line.option("--map", gallery.resolution, "Resolution of the cone maps, radians; 0: none");
  line.option("--radius", gallery.radius, "Of the points of clouds, in parts of the cloud's largest side");
  line.option("--threads", gallery.threads, "Threads of maps and pictures, 0: one per processor");
  line.negative_flag("--no-figures", gallery.figures, "Tables only");
  line.flag("--quiet", gallery.quiet, "No progress");
  line.flag("--json", gallery.json, "Print JSON: gallery.json");
  line.read();
  gallery.command_line = line.text();
  return run_gallery(gallery, std::cout);
}

int shapes_command(CommandLine& line) {
  ShapesOptions shapes;
  line.option("--out", shapes.out, "Folder for data, pictures and meshes");
  line.option("--figure", shapes.which, "Names of figures (docs/explanation/combined.md); all if not given")
      .commas();
  line.option("--mesh", shapes.mesh, "obj or ply: also write the surfaces as files");
  line.option("--resolution", shapes.resolution, "Edges of the surfaces, in parts of the semi-axes");
  line.negative_flag("--no-figures", shapes.figures, "Data only");
  line.flag("--json", shapes.json, "Print JSON: the files written");
  line.quiet();
  line.read();
  shapes.command_line = line.text();
  run_shapes(shapes, std::cout);
  return 0;
}

}  // namespace

std::map<std::string, Command> core_commands() {
  return {{"cone", cone_command},
          {"query", query_command},
          {"accuracy", accuracy_command},
          {"signmap", signmap_command},
          {"gallery", gallery_command},
          {"shapes", shapes_command},
          {"robust-law", robust_law_command},
          {"law", law_command},
          {"estimate", estimate_command}};
}

}  // namespace vericone
