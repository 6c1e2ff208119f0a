// SPDX-License-Identifier: BSD-3-Clause
#include "containing/delimiter_starts.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/convex_hull.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kBins = 24;           // a side of a cube of directions: 6 * 24^2 of them
constexpr double kLongEdge = 0.15;  // triangles are sampled as densely; the ellipsoid is the unit ball
constexpr int kBallPlaces = 64;     // of the balls of a margin
constexpr int kSpread = 64;         // directions on the half sphere
constexpr std::size_t kPockets = 8;
constexpr double kApart = 0.94;  // cosine of the angle at which two starts differ
const double kOpenings[] = {0.1, 0.4, 1.5, 5, 15};
const double kShifts[] = {0, 0.15, -0.15, 0.3, -0.3};

std::size_t bin(const Vector3d& y) {
  Eigen::Index axis = 0;
  const double size = y.cwiseAbs().maxCoeff(&axis);
  const auto cell = [&](double v) { return std::min(int((v / size + 1) / 2 * kBins), kBins - 1); };
  const int face = int(axis) * 2 + (y(axis) < 0);
  return std::size_t((face * kBins + cell(y((axis + 1) % 3))) * kBins + cell(y((axis + 2) % 3)));
}

bool is_new(const std::vector<Vector3d>& directions, const Vector3d& d) {
  return std::none_of(directions.begin(), directions.end(),
                      [&](const Vector3d& other) { return std::abs(other.dot(d)) > kApart; });
}

/// Middles of the convex hull's triangles and how far they are from the points, farthest first.
std::vector<Vector3d> pockets(const std::vector<Vector3d>& points) {
  std::vector<Vector3d> found;
  ConvexHull hull;
  try {
    hull = convex_hull(points);
  } catch (const InputError&) {
    return found;
  }
  std::vector<std::pair<double, Vector3d>> depths;
  for (const auto& t : hull.triangles) {
    const Vector3d middle = (points[t[0]] + points[t[1]] + points[t[2]]) / 3;
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3d& x : points) least = std::min(least, (x - middle).squaredNorm());
    depths.emplace_back(least, middle);
  }
  std::stable_sort(depths.begin(), depths.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [depth, middle] : depths) {
    if (found.size() >= kPockets) break;
    if (const Vector3d d = middle.normalized(); d.allFinite() && is_new(found, d)) found.push_back(d);
  }
  return found;
}

/// As steep as the points allow: the greatest s for which s * (positive part) - (negative part) <= 1 on them.
Matrix3d deepest(const std::vector<Vector3d>& points, const Vector3d& center, const Matrix3d& positive,
                 const Matrix3d& negative) {
  double steepest = std::numeric_limits<double>::infinity();
  for (const Vector3d& x : points) {
    const Vector3d y = x - center;
    if (const double q = y.dot(positive * y); q > 0)
      steepest = std::min(steepest, (1 + y.dot(negative * y)) / q);
  }
  return std::min(steepest, 1e6) * positive - negative;
}

}  // namespace

std::vector<Vector3d> outermost_points(const HullProblem& problem) {
  std::vector<double> farthest(std::size_t(6 * kBins * kBins), 0);
  std::vector<Vector3d> best(farthest.size());
  const auto offer = [&](const Vector3d& y) {
    if (const double r = y.squaredNorm(); r > 0)
      if (const std::size_t i = bin(y); r > farthest[i]) {
        farthest[i] = r;
        best[i] = y;
      }
  };
  const auto& points = problem.points();
  for (const Vector3d& y : points) offer(y);
  if (problem.has_margin())
    for (int k = 0; k < kBallPlaces; ++k) {
      const double z = 1 - (2 * k + 1.0) / kBallPlaces, r = std::sqrt(1 - z * z), a = 2.399963229728653 * k;
      const Vector3d shift = problem.in_ball({r * std::cos(a), r * std::sin(a), z});
      for (const Vector3d& y : points) offer(y + shift);
    }
  for (const auto& t : problem.triangles()) {
    const Vector3d &a = points[t[0]], u = points[t[1]] - a, v = points[t[2]] - a;
    const int parts = int(std::max({u.norm(), v.norm(), (u - v).norm()}) / kLongEdge);
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; parts > 0 && i + j <= parts; ++j) offer(a + (i * u + j * v) / parts);
  }
  std::vector<Vector3d> result;
  for (std::size_t i = 0; i < best.size(); ++i)
    if (farthest[i] > 0) result.push_back(best[i]);
  return result;
}

std::vector<Vector3d> delimiter_directions(const std::vector<Vector3d>& points) {
  std::vector<Vector3d> directions = pockets(points);
  const std::size_t count = directions.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const Vector3d d = directions[i].cross(directions[j]).normalized(); d.allFinite())
        directions.push_back(d);
  for (int k = 0; k < kSpread; ++k) {
    const double z = (k + 0.5) / kSpread, r = std::sqrt(1 - z * z), a = 2.399963229728653 * k;
    directions.emplace_back(r * std::cos(a), r * std::sin(a), z);
  }
  return directions;
}

std::vector<DelimiterStart> delimiter_starts(const std::vector<Vector3d>& points,
                                             const std::vector<Vector3d>& directions, const StarBody& body,
                                             const std::vector<Delimit>& kinds, std::size_t most) {
  struct Trial {
    DelimiterStart start;
    Vector3d direction;
  };
  std::vector<Trial> trials;
  for (const Delimit kind : kinds)
    for (const Vector3d& d : directions)
      for (const double shift : kShifts) {
        if (shift != 0 && !body.delimiters.empty()) continue;
        StarBody shifted = body;
        shifted.center += shift * d;
        double reach = 0;
        for (const Vector3d& x : points) {
          const Vector3d y = x - shifted.center;
          reach = std::max(reach, y.dot(body.ellipsoid * y));
        }
        if (shift != 0) shifted.ellipsoid = body.ellipsoid / reach;
        const Matrix3d along = d * d.transpose(), across = Matrix3d::Identity() - along;
        for (const double opening : kOpenings) {
          StarBody trial = shifted;
          trial.delimiters.push_back(kind == Delimit::dents
                                         ? deepest(points, trial.center, along, opening * across)
                                         : deepest(points, trial.center, across, opening * along));
          StarVolume v;
          if (star_volume(trial.ellipsoid, trial.delimiters, v))
            trials.push_back({{std::move(trial), kind, v.log}, d});
        }
      }
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.start.log_volume < b.start.log_volume; });
  std::vector<DelimiterStart> result;
  std::vector<std::pair<Delimit, Vector3d>> taken;
  for (const Trial& t : trials) {
    if (result.size() >= most) break;
    const bool seen = std::any_of(taken.begin(), taken.end(), [&](const auto& other) {
      return other.first == t.start.kind && std::abs(other.second.dot(t.direction)) > kApart;
    });
    if (seen) continue;
    taken.emplace_back(t.start.kind, t.direction);
    result.push_back(t.start);
  }
  return result;
}

}  // namespace vericone::fitting
