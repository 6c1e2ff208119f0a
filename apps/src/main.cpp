// SPDX-License-Identifier: BSD-3-Clause
//
// The vericone command. Results go to standard output, progress and errors to standard error.
// Exit status: 0 done, 1 something outside the program failed, 2 bad input, 130 interrupted.
#include <vericone/geometry/error.h>
#include <CLI/CLI.hpp>
#include <iostream>

#include "accuracy/accuracy.h"
#include "accuracy/combined_accuracy.h"
#include "build_info.h"
#include "cone.h"
#include "fit/fit_command.h"
#include "pieces/gallery.h"
#include "query.h"
#include "scan/run_scan.h"
#include "shapes.h"
#include "signmap.h"
#include "simulation_commands.h"
#ifdef VERICONE_HAVE_VERIFY
#include "verify.h"
#endif

namespace {

int run(int argc, char** argv) {
  CLI::App app{"Collision cones with certified bounds"};
  app.set_version_flag("--version",
                       std::string("vericone ") + VERICONE_VERSION + " (" + VERICONE_COMMIT + ")");
  app.require_subcommand(1);
  int status = 0;

  vericone::ConeOptions cone;
  auto* cone_command = app.add_subcommand("cone", "The collision cone of one scene");
  cone_command->add_option("scene", cone.scene, "Scene file, YAML (docs/formats.md)")->required();
  cone_command
      ->add_option("--method", cone.method,
                   "exact: the true cone with its error bound; slice: the source's, too small")
      ->capture_default_str();
  cone_command
      ->add_option("--planes", cone.planes,
                   "Planes of the slice cone (36); half-planes of the cone of a body of pieces (64)")
      ->default_str("");
  cone_command
      ->add_option("--tangents", cone.tangents,
                   "Slices of combined quadrics: all candidates compared, or the source's choice, by-sides "
                   "(6.3.2) or printed (5.2.2)")
      ->capture_default_str();
  cone_command->add_option("--samples", cone.samples, "Boundary samples of the exact cone of ellipsoids")
      ->default_str(std::to_string(vericone::kDefaultSamples));
  cone_command
      ->add_option("--tolerance", cone.tolerance,
                   "Certified cone: solid angle between inner and outer, relative (0.01), combined quadrics "
                   "always; bodies of pieces: width of each extreme angle, radians (0.0001)")
      ->default_str("");
  std::vector<double> resolution, around;
  auto* map = cone_command
                  ->add_option("--map", resolution,
                               "Map of all directions: colliding, safe, undecided cells, down to this size")
                  ->type_name("[RADIANS]")
                  ->expected(0, 1)
                  ->default_str(vericone::to_text(vericone::kDefaultResolution));
  cone_command->add_option("--around", around, "x,y,z: the map's region that holds this direction")
      ->delimiter(',')
      ->expected(3)
      ->needs(map);
  cone_command->add_flag("--json", cone.json, "Print JSON");
  cone_command->add_option("--picture", cone.picture_folder, "Folder for a picture of bodies and cones");
  cone_command->callback([&] {
    if (map->count() > 0) {
      cone.map.emplace();
      if (!resolution.empty()) cone.map->resolution = resolution.front();
      if (!around.empty()) cone.map->around = Eigen::Vector3d(around[0], around[1], around[2]);
    }
    vericone::run_cone(cone, std::cout);
  });

  std::string cases;
  auto* query = app.add_subcommand("query", "Exact verdicts on engagements, one JSON object a line");
  query->add_option("cases", cases, "File of cases, or - for standard input")->required();
  bool with_rung = false;
  query->add_flag("--rung", with_rung, "Add the rung of the ladder that decided: triage, interval or exact");
  query->callback([&] { status = vericone::run_query(cases, with_rung, std::cout); });

  vericone::accuracy::Options accuracy;
  auto* accuracy_command =
      app.add_subcommand("accuracy", "Accuracy of slice and exact cones against planes and samples");
  accuracy_command
      ->add_option("--obstacle", accuracy.obstacle,
                   "Obstacles of the random engagements: ellipsoid, biconcave, biconvex or star")
      ->capture_default_str();
  accuracy_command
      ->add_option("-N,--engagements", accuracy.engagements,
                   "Random engagements; by default 10000, or 1000 with other obstacles than ellipsoids")
      ->default_str("10000");
  accuracy_command
      ->add_option("--tolerance", accuracy.tolerance,
                   "Of the certified cone that slices are held against, with other obstacles than ellipsoids")
      ->default_str(vericone::to_text(vericone::accuracy::kReferenceTolerance));
  accuracy_command->add_option("--scan", accuracy.scans, "Mesh or cloud files, or folders of them")
      ->expected(1, -1);
  accuracy_command->add_option("--approaches", accuracy.approaches, "Engagements per scanned object")
      ->capture_default_str();
  accuracy_command->add_option("--planes", accuracy.planes, "Plane counts; the largest is the reference")
      ->delimiter(',')
      ->capture_default_str();
  accuracy_command->add_option("--seed", accuracy.seed, "Seed of all random numbers")->capture_default_str();
  accuracy_command->add_option("--out", accuracy.out, "Folder for tables and pictures")
      ->default_str("out/accuracy");
  accuracy_command->add_option("--threads", accuracy.threads, "Threads, 0: one per processor")
      ->capture_default_str();
  bool no_figures = false;
  accuracy_command->add_flag("--no-figures", no_figures, "Tables only");
  accuracy_command->add_flag("--quiet", accuracy.quiet, "No progress");
  accuracy_command->callback([&] {
    accuracy.figures = !no_figures;
    for (int i = 0; i < argc; ++i)
      accuracy.command_line.append(i ? " " : "").append(i ? argv[i] : "vericone");
    status = vericone::accuracy::run_accuracy(accuracy, std::cout);
  });

  vericone::SignMapOptions signmap;
  auto* signmap_command =
      app.add_subcommand("signmap", "Answers on the doubles around a velocity that grazes exactly");
  signmap_command->add_option("--out", signmap.out, "Folder for table and picture")->capture_default_str();
  signmap_command->add_option("--cells", signmap.cells, "Doubles along each axis")->capture_default_str();
  signmap_command->add_option("--seed", signmap.seed, "Seed of the engagement")->capture_default_str();
  bool no_signmap_figure = false;
  signmap_command->add_flag("--no-figures", no_signmap_figure, "Tables only");
  signmap_command->callback([&] {
    signmap.figures = !no_signmap_figure;
    for (int i = 0; i < argc; ++i) signmap.command_line.append(i ? " " : "").append(i ? argv[i] : "vericone");
    vericone::run_signmap(signmap, std::cout);
  });

  vericone::GalleryOptions gallery;
  auto* gallery_command =
      app.add_subcommand("gallery", "The cone of every mesh, cloud and octree map given, with pictures");
  gallery_command->add_option("files", gallery.files, "Files, or folders of them")
      ->required()
      ->expected(1, -1);
  gallery_command->add_option("--out", gallery.out, "Folder for tables and pictures")->capture_default_str();
  gallery_command->add_option("--planes", gallery.half_planes, "Half-planes of each cone")
      ->capture_default_str();
  gallery_command->add_option("--tolerance", gallery.tolerance, "Of their angles, radians")
      ->capture_default_str();
  gallery_command->add_option("--map", gallery.resolution, "Resolution of the cone maps, radians; 0: none")
      ->capture_default_str();
  gallery_command
      ->add_option("--radius", gallery.radius,
                   "Of the points of clouds, in parts of the cloud's largest side")
      ->capture_default_str();
  bool no_gallery_figures = false;
  gallery_command->add_flag("--no-figures", no_gallery_figures, "Tables only");
  gallery_command->callback([&] {
    gallery.figures = !no_gallery_figures;
    for (int i = 0; i < argc; ++i) gallery.command_line.append(i ? " " : "").append(i ? argv[i] : "vericone");
    status = vericone::run_gallery(gallery, std::cout);
  });

  vericone::ScanOptions scan;
  auto* scan_command = app.add_subcommand(
      "scan", "What simulated LiDARs on the agent see of a mesh, and the cone they get from it");
  scan_command->add_option("scene", scan.scene, "Scene file with a mesh and lidars (docs/formats.md)")
      ->required();
  scan_command->add_option("--out", scan.out, "Folder for cloud, tables and pictures")->capture_default_str();
  scan_command->add_option("--planes", scan.planes, "Planes through what is seen")->capture_default_str();
  scan_command
      ->add_option("--levels", scan.levels, "How often the beams are made twice as fine, and one more")
      ->capture_default_str();
  scan_command->add_option("--azimuth", scan.azimuth, "Of the plane of the picture, radians")
      ->capture_default_str();
  scan_command->add_option("--seed", scan.seed, "Seed of all random numbers")->capture_default_str();
  bool no_scan_figures = false;
  scan_command->add_flag("--no-figures", no_scan_figures, "Cloud and tables only");
  scan_command->add_flag("--quiet", scan.quiet, "No progress");
  scan_command->callback([&] {
    scan.figures = !no_scan_figures;
    for (int i = 0; i < argc; ++i) scan.command_line.append(i ? " " : "").append(i ? argv[i] : "vericone");
#ifdef VERICONE_HAVE_LIDAR
    vericone::run_scan(scan, std::cout);
#else
    throw vericone::InputError("scan", "a command without LiDARs", "a build with VERICONE_LIDAR");
#endif
  });

  vericone::FitCommandOptions fit;
  auto* fit_command = app.add_subcommand("fit", "A quadric hull of a scan, with what is proved of it");
  fit_command->add_option("file", fit.file, "Mesh, cloud or octree map (docs/files.md)")->required();
  fit_command
      ->add_option("--mode", fit.mode, "least-squares, robust, or containing: proved to contain the scan")
      ->capture_default_str();
  fit_command
      ->add_option(
          "--shape", fit.shape,
          "ellipse (a footprint), ellipsoid, biconcave, biconvex, star, or auto: chosen and explained")
      ->capture_default_str();
  double coverage = 1;
  auto* coverage_option =
      fit_command
          ->add_option("--coverage", coverage,
                       "Share of the points to be inside; containing: 1 if not given, otherwise the surface "
                       "stays where it was fitted")
          ->default_str("");
  fit_command->add_option("--margin", fit.margin, "Radius of balls about the points to be inside, metres")
      ->capture_default_str();
  fit_command->add_option("--pieces", fit.pieces, "Bodies whose union is the hull")->capture_default_str();
  fit_command->add_option("--seed", fit.seed, "Seed of all random numbers")
      ->check([](const std::string& text) {
        return text.starts_with("-") ? "got " + text + ", must be a whole number, 0 or more" : std::string();
      })
      ->capture_default_str();
  fit_command->add_option(
      "--cone", fit.cone,
      "Compare the cones of scan and hulls for an agent: x,y,z,radius, around:N, or a file");
  auto* check_option = fit_command->add_option(
      "--check", fit.check,
      "Instead of fitting: repeat the certificate of this fit.json; 1: it does not hold");
  fit_command->add_flag("--json", fit.json, "Print JSON");
  fit_command->add_option("--out", fit.out, "Folder for result, meshes and picture")->capture_default_str();
  bool no_fit_figures = false;
  fit_command->add_flag("--no-figures", no_fit_figures, "Result and meshes only");
  fit_command->add_flag("--quiet", fit.quiet, "No progress");
  fit_command->callback([&] {
    for (const char* other : {"--mode", "--shape", "--coverage", "--margin", "--pieces", "--seed", "--cone"})
      if (check_option->count() > 0 && fit_command->count(other) > 0)
        throw vericone::InputError("--check", fit.check,
                                   std::string("given without ") + other + ", which is of a fit");
    if (coverage_option->count() > 0) fit.coverage = coverage;
    fit.figures = !no_fit_figures;
    for (int i = 0; i < argc; ++i) fit.command_line.append(i ? " " : "").append(i ? argv[i] : "vericone");
#ifdef VERICONE_HAVE_FITTING
    status = vericone::run_fit(fit, std::cout);
#else
    throw vericone::InputError("fit", "a command without fits", "a build with VERICONE_FITTING");
#endif
  });

  vericone::ShapesOptions shapes;
  auto* shapes_command = app.add_subcommand("shapes", "Pictures and meshes of combined quadrics");
  shapes_command->add_option("--out", shapes.out, "Folder for data, pictures and meshes")
      ->capture_default_str();
  shapes_command
      ->add_option("--figure", shapes.which, "Names of figures (docs/combined.md); all if not given")
      ->delimiter(',');
  shapes_command->add_option("--mesh", shapes.mesh, "obj or ply: also write the surfaces as files");
  shapes_command
      ->add_option("--resolution", shapes.resolution, "Edges of the surfaces, in parts of the semi-axes")
      ->capture_default_str();
  bool no_shapes_figure = false;
  shapes_command->add_flag("--no-figures", no_shapes_figure, "Data only");
  shapes_command->callback([&] {
    shapes.figures = !no_shapes_figure;
    for (int i = 0; i < argc; ++i) shapes.command_line.append(i ? " " : "").append(i ? argv[i] : "vericone");
    vericone::run_shapes(shapes, std::cout);
  });

  std::string command_line = "vericone";
  for (int i = 1; i < argc; ++i) command_line.append(" ").append(argv[i]);
  vericone::add_simulation_commands(app, command_line, status);

#ifdef VERICONE_HAVE_VERIFY
  vericone::VerifyOptions verify;
  auto* verify_command =
      app.add_subcommand("verify", "Hold the library against exact constructions (CGAL); 1: wrong answers");
  verify_command->add_option("--cases", verify.cases, "Cases of each predicate, 0: none")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{10'000'000'000}))
      ->capture_default_str();
  verify_command->add_option("--pairs", verify.pairs, "Pairs of each family of sectors and cones, 0: none")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{10'000'000}))
      ->capture_default_str();
  verify_command->add_option("--seed", verify.seed, "Seed of all random numbers")->capture_default_str();
  verify_command->add_option("--threads", verify.threads, "Threads, 0: one per processor")
      ->capture_default_str();
  verify_command->add_flag("--json", verify.json, "Print JSON");
  verify_command->callback([&] { status = vericone::run_verify(verify, std::cout); });
#endif

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& e) {
    return app.exit(e);
  } catch (const CLI::CallForVersion& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    std::string text = e.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    std::cerr << "vericone: " << text << " (see vericone --help)\n";
    return 2;
  }
  std::cout.flush();
  if (!std::cout) {
    std::cerr << "vericone: could not write to standard output\n";
    return 1;
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const vericone::InputError& e) {
    std::cerr << "vericone: " << e.what() << '\n';
    return 2;
  } catch (const std::exception& e) {
    std::cerr << "vericone: " << e.what() << '\n';
    return 1;
  }
}
