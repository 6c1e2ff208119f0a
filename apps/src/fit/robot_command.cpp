// SPDX-License-Identifier: BSD-3-Clause
#include "fit/robot_command.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/solids.h>
#include <algorithm>
#include <iostream>

#include "fit/robot_shapes.h"
#include "fit/robot_text.h"
#include "fit/solid_command.h"
#include "fit/solid_json.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "output/output_file.h"
#include "output/progress.h"
#include "robot/robot.h"
#include "work/interrupt.h"

namespace vericone {
namespace {

using Eigen::Vector3d;
using fitting::Solid, fitting::SolidKind;

/// Whoever reads the file rounds poses, turns by angles and adds: a ball of this part of the link's reach
/// about each point is inside too.
constexpr double kSlack = 0x1p-40;

/// What became of a link.
struct FittedLink {
  std::string name;
  std::size_t triangles = 0, kept = 0;
  std::vector<Solid> solids;
  std::vector<fitting::SolidFit> fits;  // of its meshes; of its other shapes none
  bool mixed = false;                   // collisions of several properties became those of the first
};

class RobotFit {
 public:
  RobotFit(const FitCommandOptions& given, Progress& progress)
      : given_(given), progress_(progress), urdf_(!given.urdf.empty()), robot_(given.file, given.packages) {
    options_.pieces = given.pieces;
    options_.slack = kSlack;
    const std::vector<SolidKind> any{SolidKind::sphere, SolidKind::capsule, SolidKind::cylinder,
                                     SolidKind::box, SolidKind::ellipsoid};
    options_.kinds = solid_kinds(given);
    if (options_.kinds.empty() && given.shape != "auto")
      throw InputError("--shape", given.shape, "sphere, capsule, cylinder or box; or --kinds");
    // Readers of URDF that are in wide use know no capsule.
    if (options_.kinds.empty() && urdf_)
      options_.kinds = {SolidKind::sphere, SolidKind::cylinder, SolidKind::box};
    if (options_.kinds.empty()) options_.kinds = any;
    if (urdf_ && allows(SolidKind::ellipsoid))
      throw InputError("--kinds", given.kinds,
                       "some of sphere, cylinder, box and capsule: URDF has no ellipsoid");
  }

  /// The new text.
  std::string run() {
    if (robot_.is_urdf() != urdf_)
      throw InputError(urdf_ ? "--urdf" : "--sdf", urdf_ ? given_.urdf : given_.sdf,
                       std::string("left out: ") + given_.file +
                           (urdf_ ? " is SDF, --sdf" : " is URDF, --urdf") + " writes that");
    std::vector<fit::Replacement> replacements;
    for (const RobotShapes::Link& link : robot_.links())
      replacements.push_back(replaced(link.text, *link.shapes));
    if (replacements.empty()) throw InputError(given_.file, "no link with a collision", "a robot with some");
    return fit::with_collisions(robot_.text(), urdf_, replacements);
  }

  const std::vector<FittedLink>& links() const { return links_; }

 private:
  bool allows(SolidKind kind) const {
    return std::find(options_.kinds.begin(), options_.kinds.end(), kind) != options_.kinds.end();
  }

  fit::Replacement replaced(const fit::LinkText& link, const std::vector<robot::Geometry>& geometries) {
    FittedLink& fitted = links_.emplace_back();
    fitted.name = link.name;
    fit::Replacement result{link, {}, {}};
    fitting::Sample meshes;
    for (std::size_t i = 0; i < geometries.size(); ++i) {
      if (geometries[i].body && is_allowed(*geometries[i].body)) {
        ++fitted.kept;
        continue;
      }
      result.gone.push_back(i);
      fitted.mixed |= link.collisions[i].properties != link.collisions[result.gone.front()].properties;
      if (geometries[i].body)
        add(corners_around(geometries[i]), 1, link.name, fitted);
      else
        robot_.add_mesh(geometries[i], meshes);
    }
    fitted.triangles = meshes.triangles.size();
    if (meshes.is_mesh()) add(merged(std::move(meshes)), given_.pieces, link.name, fitted);
    result.solids = fitted.solids;
    return result;
  }

  bool is_allowed(const Convex& body) const {
    if (body.word() == "ball") return allows(SolidKind::sphere);
    return std::any_of(options_.kinds.begin(), options_.kinds.end(),
                       [&](SolidKind kind) { return fitting::to_string(kind) == body.word(); });
  }

  void add(const fitting::Sample& sample, int pieces, const std::string& name, FittedLink& fitted) {
    fitting::SolidOptions options = options_;
    options.pieces = pieces;
    options.progress = [&](const std::string& what, double share) {
      return progress_.show(name + ": " + what, share);
    };
    fitting::SolidFit fit = [&] {
      try {
        return fitting::fit_solids(sample, options);
      } catch (const InputError& e) {
        if (e.field() == "pieces") throw InputError("--pieces", e.value(), e.requirement());
        throw InputError(given_.file, "link " + name + ": " + e.field() + ": " + e.value(), e.requirement());
      }
    }();
    // Angles are what is written: the rotation that they are read as is the one that is proved.
    const fitting::Assignment homes = fitting::homes_of(fit.pieces, sample);
    for (Solid& solid : fit.pieces) solid.rotation = robot::turn_of(fit::angles_of(solid.rotation));
    fitting::enclose(fit.pieces, sample, homes, 0, kSlack);
    fit.certificate = fitting::check(fit.pieces, sample);
    fit.certified = fit.certificate.all_inside();
    if (!fit.certified) throw std::runtime_error("link " + name + " is not proved to be inside");
    fitted.solids.insert(fitted.solids.end(), fit.pieces.begin(), fit.pieces.end());
    if (sample.is_mesh()) fitted.fits.push_back(std::move(fit));
  }

  const FitCommandOptions& given_;
  Progress& progress_;
  bool urdf_;
  RobotShapes robot_;
  fitting::SolidOptions options_;
  std::vector<FittedLink> links_;
};

Json links_json(const std::vector<FittedLink>& links) {
  Json list = Json::array();
  for (const FittedLink& link : links) {
    Json one{
        {"name", link.name}, {"triangles", link.triangles}, {"kept", link.kept}, {"pieces", Json::array()}};
    for (const Solid& solid : link.solids)
      one["pieces"].push_back({{"kind", fitting::to_string(solid.kind)}, {"body", fit::solid_fields(solid)}});
    const fitting::SolidFit* fit = link.fits.empty() ? nullptr : &link.fits.front();
    one["volume"] = fit ? number_or_null(fit->volume.value) : Json(nullptr);
    one["convex_hull_volume"] = fit ? number_or_null(fit->convex_hull_volume) : Json(nullptr);
    one["protrusion"] =
        fit ? Json{{"mean", fit->protrusion.mean}, {"max", fit->protrusion.max}} : Json(nullptr);
    list.push_back(one);
  }
  return list;
}

void print_links(const std::vector<FittedLink>& links, std::ostream& out) {
  const auto row = [&](std::string label, const std::string& text) {
    label.resize(20, ' ');
    out << label << text << '\n';
  };
  row("certified",
      "yes: every triangle of each link is inside one of its pieces, with a ball of 2^-40 of its reach "
      "about each corner; coverage 1, no gap");
  for (const FittedLink& link : links) {
    std::string text = link.solids.empty() ? "" : fit::counts_of(link.solids);
    if (link.kept) text += (text.empty() ? "" : ", ") + std::to_string(link.kept) + " kept as written";
    if (!link.fits.empty()) {
      const fitting::SolidFit& fit = link.fits.front();
      text += " around " + std::to_string(link.triangles) + " triangles";
      if (fit.convex_hull_volume)
        text +=
            ", " + number_text(fit.volume.value / *fit.convex_hull_volume, 4) + " x the convex hull's volume";
      text += ", protrusion at most " + at_most_text(fit.protrusion.max, 4) + " m";
    }
    if (link.mixed) text += "; properties of several collisions became those of the first";
    row("link " + link.name + (link.name.size() > 14 ? " " : ""), text);
  }
}

}  // namespace

int run_robot_fit(const FitCommandOptions& given, std::ostream& out) {
  const bool urdf = !given.urdf.empty();
  if (urdf && !given.sdf.empty()) throw InputError("--urdf", given.urdf, "given without --sdf");
  const std::string& file = urdf ? given.urdf : given.sdf;
  if (given.margin != 0) throw InputError("--margin", to_text(given.margin), "left out of a robot's fit");
  try {
    std::vector<FittedLink> links;
    {
      Progress progress(given.quiet);
      RobotFit fit(given, progress);
      write_whole(file, fit.run());
      links = fit.links();
    }
    if (given.json)
      out << json_text({{"file", given.file}, {"written", file}, {"links", links_json(links)}}) << '\n';
    else
      print_links(links, out);
    if (!given.json) out << "written             " << file << '\n';
    return 0;
  } catch (const Interrupted&) {
    return kExitInterrupted;
  }
}

}  // namespace vericone
