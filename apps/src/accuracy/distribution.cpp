// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/distribution.h"

#include <vericone/geometry/error.h>

namespace vericone::accuracy {
namespace {

std::string range_text(const Range& range) { return to_text(range.low) + " to " + to_text(range.high); }

}  // namespace

Distribution distribution(const Options& options) {
  Distribution from;
  if (!options.semi_axes.empty()) from.semi_axes = {options.semi_axes.front(), options.semi_axes.back()};
  if (!options.distance.empty()) from.distance = {options.distance.front(), options.distance.back()};
  return from;
}

std::string distribution_text(const Distribution& from) {
  return "semi-axes " + range_text(from.semi_axes) + " m" +
         (from.distance ? ", distance " + range_text(*from.distance) + " m" : "");
}

std::string distribution_settings(const Options& options) {
  const Distribution from = distribution(options);
  return (options.semi_axes.empty() ? "" : ", semi-axes " + range_text(from.semi_axes)) +
         (from.distance ? ", distance " + range_text(*from.distance) : "");
}

ObstacleKind obstacle_kind(const std::string& name) {
  if (name == "ellipsoid") return ObstacleKind::ellipsoid;
  if (name == "biconcave") return ObstacleKind::biconcave;
  if (name == "biconvex") return ObstacleKind::biconvex;
  if (name == "star") return ObstacleKind::star;
  throw InputError("--obstacle", name, "ellipsoid, biconcave, biconvex or star");
}

}  // namespace vericone::accuracy
