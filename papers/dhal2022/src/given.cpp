// SPDX-License-Identifier: BSD-3-Clause
#include "given.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace vericone::dhal2022 {
namespace {

std::string text_of(const std::vector<double>& values) {
  std::string list;
  for (const double v : values) list.append(list.empty() ? "" : ", ").append(short_text(v));
  return values.size() > 1 ? "(" + list + ")" : list;
}

/// Semi-axes as the run has them, in the order of the body's axes.
std::vector<double> axes_of(const simulation::ShapeInTime& shape) {
  if (const auto* conic = std::get_if<simulation::DentedConic>(&shape)) return {conic->a_c, conic->b_c};
  if (const auto* quadric = std::get_if<simulation::DentedQuadric>(&shape))
    return {quadric->semi_axes.x(), quadric->semi_axes.y(), quadric->semi_axes.z()};
  const guidance::Shape& rigid = std::get<simulation::RigidShape>(shape).shape;
  // The scenario's bodies have their axes along those of their frame: the factor's columns.
  if (const auto* ellipse = std::get_if<CombinedEllipse>(&rigid)) {
    const Eigen::Matrix2d& f = ellipse->ellipsoid().factor();
    return {f.col(0).norm(), f.col(1).norm()};
  }
  if (const auto* ellipsoid = std::get_if<CombinedEllipsoid>(&rigid)) {
    const Eigen::Matrix3d& f = ellipsoid->ellipsoid().factor();
    return {f.col(0).norm(), f.col(1).norm(), f.col(2).norm()};
  }
  throw std::logic_error("a hull has no semi-axes");
}

}  // namespace

void given_body(const PaperRun& run, const std::string& section, const std::vector<std::string>& figures,
                const std::string& name, const GivenBody& printed, std::vector<Claim>& claims) {
  const simulation::Body& body = run.body(name);
  const auto add = [&](const char* what, const std::vector<double>& values, const std::vector<double>& ours,
                       const char* unit) {
    claims.push_back(given({section + "/" + run.file.stem().string() + "/" + name + "-" + what, section,
                            figures, name + ", " + what, "", false},
                           text_of(values), values, ours, unit));
  };
  if (!printed.semi_axes.empty()) add("axes", printed.semi_axes, axes_of(body.shape), "m");
  if (printed.k)
    add("k", {*printed.k}, {std::get<simulation::DentedConic>(body.shape).k.at(body.appears)}, "");
  if (!printed.position.empty()) {
    std::vector<double> ours(body.start.position.data(),
                             body.start.position.data() + printed.position.size());
    add("position", printed.position, ours, "m");
  }
  if (printed.speed) add("speed", {*printed.speed}, {body.start.velocity.norm()}, "m/s");
  if (!printed.heading_deg.empty()) {
    const guidance::Direction heading = guidance::direction_of(body.start.velocity);
    const double degree = 180 / std::numbers::pi;
    std::vector<double> ours{heading.azimuth * degree};
    if (printed.heading_deg.size() > 1) ours.push_back(heading.elevation * degree);
    add("heading", printed.heading_deg, ours, "deg");
  }
  if (printed.appears) add("appears", {*printed.appears}, {body.appears}, "s");
}

}  // namespace vericone::dhal2022
