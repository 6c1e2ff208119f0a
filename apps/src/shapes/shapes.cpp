// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/geometry/mesh/surface.h>
#include <vericone/work/staged_folder.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "commands.h"
#include "json/json_value.h"
#include "output/figures.h"
#include "output/output_file.h"
#include "output/output_options.h"
#include "picture/engagements.h"
#include "picture/shape_json.h"
#include "work/provenance.h"

namespace vericone {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

struct ShapesOptions : OutputOptions {
  ShapesOptions() { out = "out/shapes"; }
  std::vector<std::string> which;  // names of figures, docs/explanation/combined.md; empty: all
  double resolution = 0.09;        // of the surfaces, in parts of the semi-axes
  std::string mesh;                // also the bodies' surfaces as files: "obj" or "ply"
};

// The bodies of the pictures; the source prints no sizes. Lengths in metres.
CombinedEllipsoid biconcave() {
  return {Ellipsoid::from_axes({0, 0, 0}, {2, 3, 3}), {hyperboloid(2, {0.8, 1.3, 1.3})}};
}

CombinedEllipsoid biconvex() {
  return {Ellipsoid::from_axes({0, 0, 0}, {4, 2, 2}), {hyperboloid(1, {1.6, 0.9, 0.9})}};
}

/// A ball with a dent at both ends of every axis given.
CombinedEllipsoid star(const std::vector<Vector3d>& axes, double bottom, double width) {
  std::vector<Delimiter<3>> dents;
  for (const Vector3d& axis : axes) {
    Eigen::Matrix3d r;
    r.col(0) = axis.normalized();
    r.col(1) = r.col(0).unitOrthogonal();
    r.col(2) = r.col(0).cross(r.col(1));
    dents.push_back(hyperboloid(2, {bottom, width, width}, r));
  }
  return {Ellipsoid::from_axes({0, 0, 0}, {3, 3, 3}), dents};
}

CombinedEllipsoid eight_pointed() { return star({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1.0, 1.3); }

/// Dents about the axes of an icosahedron leave the corners of a dodecahedron.
CombinedEllipsoid twenty_pointed() {
  constexpr double kGolden = std::numbers::phi;
  return star({{0, 1, kGolden},
               {0, -1, kGolden},
               {1, kGolden, 0},
               {-1, kGolden, 0},
               {kGolden, 0, 1},
               {kGolden, 0, -1}},
              1.5, 1.3);
}

CombinedEllipse six_pointed() {
  std::vector<Delimiter<2>> dents;
  dents.reserve(3);
  for (int i = 0; i < 3; ++i) dents.push_back(hyperbola({1.3, 0.8}, i * std::numbers::pi / 3));
  return {Ellipse::from_axes({0, 0}, {3, 3}), dents};
}

/// What the figures share: the options, and which surfaces have been written as files.
class Shapes {
 public:
  Shapes(const ShapesOptions& options, const work::StagedFolder& folder, std::ostream& out)
      : options_(options), folder_(folder), out_(out) {}

  Json solid(const std::string& name, const CombinedEllipsoid& body, const std::string& part = "whole") {
    const CombinedSurface whole = surface(body, options_.resolution);
    if (!options_.mesh.empty() && files_.insert(name).second) {
      const std::filesystem::path file = folder_.path() / (name + "." + options_.mesh);
      write_whole(file, options_.mesh == "obj" ? to_obj(whole) : to_ply(whole));
      const VolumeEstimate v = volume(body);
      out_ << "surface   " << folder_.published(file).string() << ": " << whole.triangles.size()
           << " triangles, volume " << to_text(enclosed_volume(whole)) << " of " << to_text(v.value)
           << " m^3\n";
    }
    return solid_json(body, whole, part);
  }

  /// The whole ellipsoid, and the hyperboloid as far as an ellipsoid `reach` times as large.
  Json intersecting(const std::string& name, const CombinedEllipsoid& body, double reach) {
    const Ellipsoid& e = body.ellipsoid();
    return Json::array({solid(name + "_ellipsoid", CombinedEllipsoid(e)),
                        solid(name + "_hyperboloid", {e.scaled(reach), body.delimiters()}, "delimiters")});
  }

  double resolution() const { return options_.resolution; }

 private:
  const ShapesOptions& options_;
  const work::StagedFolder& folder_;
  std::ostream& out_;
  std::set<std::string> files_;
};

Json panel(const std::string& title, const Json& solids) { return {{"title", title}, {"solids", solids}}; }

/// (a) ellipsoid and hyperboloid, (b) ellipsoid delimited by hyperboloid, (c) the reverse, (d) both.
Json four_panels(Shapes& shapes, const std::string& name, const CombinedEllipsoid& body, double reach,
                 const std::string& title) {
  return {
      {"panels",
       {panel("(a) ellipsoid and hyperboloid", shapes.intersecting(name, body, reach)),
        panel("(b) ellipsoid delimited by hyperboloid", Json::array({shapes.solid(name, body, "ellipsoid")})),
        panel("(c) hyperboloid delimited by ellipsoid",
              Json::array({shapes.solid(name, body, "delimiters")})),
        panel("(d) " + title, Json::array({shapes.solid(name, body)}))}}};
}

constexpr double kBiconcaveReach = 1.5, kBiconvexReach = 1.25;

Json dented_conic_figure() {
  constexpr double kA = 6, kB = 2, kPhi = std::numbers::pi / 6, kShown = 0.5;
  Json family = Json::array();
  for (const double k : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const CombinedEllipse body = dented_conic({0, 0}, kA, kB, k, 0);
    Json one = outline_json(body);
    one["k"] = k;
    one["area"] = area(body);
    family.push_back(one);
  }
  return {{"a_c", kA},
          {"b_c", kB},
          {"k", kShown},
          {"phi", kPhi},
          {"body", outline_json(dented_conic({10, 5}, kA, kB, kShown, kPhi))},
          {"family", family}};
}

struct ShapeFigure {
  const char* name;
  const char* script;
  Json (*data)(Shapes&);
};

const std::vector<ShapeFigure>& shape_figures() {
  static const std::vector<ShapeFigure> all{
      {"dented_conic", "combined_planar.py", [](Shapes&) { return dented_conic_figure(); }},
      {"biconcave", "combined_solids.py",
       [](Shapes& s) {
         return four_panels(s, "biconcave", biconcave(), kBiconcaveReach, "biconcave ellipsoid");
       }},
      {"biconvex", "combined_solids.py",
       [](Shapes& s) {
         return four_panels(s, "biconvex", biconvex(), kBiconvexReach, "biconvex hyperboloid");
       }},
      {"combinations", "combined_solids.py",
       [](Shapes& s) -> Json {
         return {{"panels",
                  {panel("(a) ellipsoid and two-sheeted hyperboloid",
                         s.intersecting("biconcave", biconcave(), kBiconcaveReach)),
                   panel("(b) ellipsoid and one-sheeted hyperboloid",
                         s.intersecting("biconvex", biconvex(), kBiconvexReach)),
                   panel("(c) biconcave ellipsoid", Json::array({s.solid("biconcave", biconcave())})),
                   panel("(d) biconvex hyperboloid", Json::array({s.solid("biconvex", biconvex())}))}}};
       }},
      {"stars", "combined_solids.py",
       [](Shapes& s) -> Json {
         return {
             {"planar", outline_json(six_pointed())},
             {"planar_title", "(a) ellipse, three hyperbolas"},
             {"panels",
              {panel("(b) ball, three hyperboloids", Json::array({s.solid("star_8", eight_pointed())})),
               panel("(c) ball, six hyperboloids", Json::array({s.solid("star_20", twenty_pointed())}))}}};
       }},
      {"section", "combined_engagement.py",
       [](Shapes& s) { return section_figure(biconcave(), s.resolution()); }},
      {"notch", "combined_engagement.py", [](Shapes& s) { return notch_figure(biconvex(), s.resolution()); }},
  };
  return all;
}

/// `vericone shapes`: pictures of combined quadrics and of their cones, with the data they are drawn from
/// (docs/explanation/combined.md). Writes NAME.json for each figure, shapes.json, provenance.json, the
/// pictures and meshes to `out`. Throws InputError naming "--figure", "--mesh" or "--resolution".
void run_shapes(const ShapesOptions& options, std::ostream& out) {
  if (!options.mesh.empty() && options.mesh != "obj" && options.mesh != "ply")
    throw InputError("--mesh", options.mesh, "obj or ply");
  if (!(options.resolution >= 0.02 && options.resolution <= 0.5))
    throw InputError("--resolution", to_text(options.resolution), "between 0.02 and 0.5");
  std::vector<const ShapeFigure*> chosen;
  std::string names;
  for (const ShapeFigure& f : shape_figures()) {
    names.append(names.empty() ? "" : ", ").append(f.name);
    if (options.which.empty() || std::count(options.which.begin(), options.which.end(), f.name))
      chosen.push_back(&f);
  }
  for (const std::string& name : options.which)
    if (std::none_of(chosen.begin(), chosen.end(), [&](const ShapeFigure* f) { return f->name == name; }))
      throw InputError("--figure", name, "one of " + names);
  work::StagedFolder folder(options.out, "--out");
  std::ostream silent(nullptr);
  std::ostream& text = options.json ? silent : out;
  Shapes shapes(options, folder, text);
  std::vector<std::string> written, scripts, old;
  for (const ShapeFigure* f : chosen) {
    write_whole(folder.path() / (std::string(f->name) + ".json"), f->data(shapes).dump() + "\n");
    for (const char* end : {".pdf", ".png"}) old.push_back(std::string(f->name) + end);
    written.emplace_back(f->name);
    if (std::find(scripts.begin(), scripts.end(), f->script) == scripts.end())
      scripts.emplace_back(f->script);
  }
  write_whole(folder.path() / "shapes.json", Json{{"figures", written}}.dump(1) + "\n");
  Json origin = provenance(options.command_line, 1, {});
  origin["resolution"] = options.resolution;
  write_whole(folder.path() / "provenance.json", origin.dump(1) + "\n");
  if (options.figures)
    for (const std::string& script : scripts) draw_figures(script, folder.path());
  const auto files = folder.publish(old);
  for (const std::string& name : written)
    text << "data      " << (std::filesystem::path(options.out) / (name + ".json")).string() << '\n';
  for (const auto& picture : pictures_of(files)) text << "picture   " << picture.string() << '\n';
  Json list = Json::array();
  for (const auto& file : files) list.push_back(file.string());
  if (options.json) out << Json{{"figures", written}, {"files", list}}.dump(1) << '\n';
}

}  // namespace

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

}  // namespace vericone
