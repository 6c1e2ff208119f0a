// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/mesh/surface.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <vericone/internal/fitting/canonical.h>
#include <vericone/internal/fitting/containing.h>
#include <vericone/internal/geometry/decompositions.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "containing/barrier.h"
#include "containing/delimiter_starts.h"
#include "containing/least_about_balls.h"

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kRefined = 3;         // starts that are followed to the end
constexpr std::size_t kMostDelimiters = 3;  // of a star
constexpr std::size_t kStartsOfStars = 2;   // for each further delimiter
constexpr double kAny = std::numeric_limits<double>::infinity();
const double kUnitBall = std::log(4 * std::numbers::pi / 3);  // log volume
constexpr double kWorthwhile = 0.02;  // of log volume, for a further delimiter of a star

Ellipsoid from_factor(const Vector3d& center, const Matrix3d& factor) {
  const LeftSingular<3> svd = left_singular<3>(factor);
  Matrix3d axes = svd.u;
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return Ellipsoid::from_axes(center, svd.values, axes);
}

/// Back from the coordinates in which the least ellipsoid is the unit ball.
CombinedEllipsoid to_sample(const StarBody& body, const Ellipsoid& unit) {
  const Matrix3d lower = cholesky<3>(body.ellipsoid).lower;
  const Matrix3d root = lower.transpose().inverse();
  const Matrix3d back = unit.factor().inverse();
  std::vector<Delimiter<3>> delimiters;
  for (const Matrix3d& m : body.delimiters) {
    const Matrix3d form = back.transpose() * m * back;
    delimiters.push_back({(form + form.transpose()) / 2, 1});
  }
  return CombinedEllipsoid::trusted(
      from_factor(unit.center() + unit.factor() * body.center, unit.factor() * root), std::move(delimiters));
}

HullProblem problem_of(const CanonicalSample& sample, const Ellipsoid& unit, std::vector<Delimit> delimits,
                       double margin) {
  const Matrix3d inverse = unit.factor().inverse();
  std::vector<Vector3d> points;
  points.reserve(sample.points.size());
  for (const Vector3d& x : sample.points) points.push_back(inverse * (x - unit.center()));
  return HullProblem(std::move(points), sample.triangles, std::move(delimits), margin, unit.factor());
}

/// The best minimum from several starts with delimiters of the given kinds; the best rough one where that has
/// a greater log volume than `thorough_below`.
Minimum best_of(const CanonicalSample& grid, const Ellipsoid& unit, double margin,
                const std::vector<DelimiterStart>& starts, std::vector<Delimit> kinds, double thorough_below,
                int& followed, int& iterations, std::vector<Delimit>& kinds_found) {
  struct Rough {
    Minimum minimum;
    std::vector<Delimit> kinds;
  };
  std::vector<Rough> rough;
  for (const DelimiterStart& start : starts) {
    std::vector<Delimit> all = kinds;
    all.push_back(start.kind);
    const HullProblem problem = problem_of(grid, unit, all, margin);
    rough.push_back({minimise(problem, start.body, Descent::rough), all});
    iterations += rough.back().minimum.iterations;
    ++followed;
  }
  std::stable_sort(rough.begin(), rough.end(), [](const Rough& a, const Rough& b) {
    return a.minimum.log_volume < b.minimum.log_volume;
  });
  Minimum best;
  best.log_volume = std::numeric_limits<double>::infinity();
  if (!rough.empty() && !(rough.front().minimum.log_volume <= thorough_below)) {
    kinds_found = rough.front().kinds;
    return rough.front().minimum;
  }
  for (std::size_t i = 0; i < std::min(kRefined, rough.size()); ++i) {
    const HullProblem problem = problem_of(grid, unit, rough[i].kinds, margin);
    Minimum m = minimise(problem, rough[i].minimum.body, Descent::thorough);
    iterations += m.iterations;
    // A minimum is preferred to a point on the way that happens to be smaller.
    if (m.converged == best.converged ? m.log_volume < best.log_volume - 1e-9 : m.converged) {
      best = std::move(m);
      kinds_found = rough[i].kinds;
    }
  }
  return best;
}

/// Delimiters that do not cut the ellipsoid.
void drop_idle(StarBody& body) {
  const Matrix3d lower = cholesky<3>(body.ellipsoid).lower;
  const Matrix3d inverse = lower.inverse();
  std::erase_if(body.delimiters, [&](const Matrix3d& m) {
    const Matrix3d form = inverse * m * inverse.transpose();
    return !(symmetric_eigenvalues<3>((form + form.transpose()) / 2)(2) > 1 + 1e-9);
  });
}

ContainingFit combined(const CanonicalSample& sample, const CanonicalSample& grid, const Ellipsoid& unit,
                       Shape shape, const ContainingOptions& options) {
  ContainingFit fit;
  const HullProblem bare = problem_of(grid, unit, {}, options.margin);
  const std::vector<Vector3d> outermost = outermost_points(bare);
  const std::vector<Vector3d> directions = delimiter_directions(outermost);
  std::vector<Delimit> kinds;
  if (shape != Shape::biconvex) kinds.push_back(Delimit::dents);
  if (shape != Shape::biconcave) kinds.push_back(Delimit::waist);
  const bool star = shape == Shape::star;
  std::vector<Delimit> found;
  const double enough = options.promise > 0 ? kUnitBall - options.promise : kAny;
  Minimum best = best_of(
      grid, unit, options.margin,
      delimiter_starts(outermost, directions, StarBody{}, kinds, std::size_t(options.starts) * kinds.size()),
      {}, enough, fit.starts, fit.iterations, found);
  const bool promising = best.log_volume <= enough;
  // A further delimiter stays where it pays, and all of them only where they did in the end.
  const Minimum single = best;
  while (star && promising && found.size() < kMostDelimiters) {
    std::vector<Delimit> more;
    const Minimum next = best_of(grid, unit, options.margin,
                                 delimiter_starts(outermost, directions, best.body, kinds, kStartsOfStars),
                                 found, -kAny, fit.starts, fit.iterations, more);
    if (!(next.log_volume < best.log_volume - kWorthwhile)) break;
    best = next;
    found = more;
  }
  if (found.size() > 1) {
    best = minimise(problem_of(grid, unit, found, options.margin), best.body, Descent::thorough);
    fit.iterations += best.iterations;
    if (!(best.log_volume < single.log_volume)) best = single;
  }
  // The points themselves have the last word. Not of stars, whose conditions hold roughly only: what rounding
  // changed enclose() makes up for.
  if (promising && best.body.delimiters.size() <= 1) {
    found.resize(best.body.delimiters.size());
    const Minimum exact = minimise(problem_of(sample, unit, found, options.margin), best.body, Descent::last);
    fit.iterations += exact.iterations;
    if (exact.converged || !best.converged) best = exact;
  }
  drop_idle(best.body);
  fit.piece.body = to_sample(best.body, unit);
  fit.converged = best.converged;
  fit.stationarity = best.stationarity;
  fit.volume = std::exp(best.log_volume) * std::abs(unit.factor().determinant());
  return fit;
}

/// The least ellipsoid (ellipse) about balls of the margin, and what is known of it.
template <int D>
BasicEllipsoid<D> least_body(const std::vector<Eigen::Matrix<double, D, 1>>& points, double margin,
                             ContainingFit& fit) {
  if (margin > 0) {
    BallEnclosure<D> result = least_about_balls<D>(points, margin);
    fit.converged = result.converged;
    fit.stationarity = result.gap;
    fit.volume_ratio_bound = result.volume_ratio_bound;
    fit.iterations = result.rounds;
    return result.body;
  }
  MinVolumeResult<D> result = min_volume_ellipsoid<D>(points);
  fit.converged = result.converged();
  fit.stationarity = result.optimality_gap;
  fit.volume_ratio_bound = result.volume_ratio_bound;
  fit.iterations = result.iterations;
  return result.body;
}

ContainingFit footprint(const CanonicalSample& sample, double margin) {
  ContainingFit fit;
  fit.starts = 1;
  std::vector<Vector2d> points;
  fit.piece.low = std::numeric_limits<double>::infinity();
  fit.piece.high = -fit.piece.low;
  for (const Vector3d& y : sample.points) {
    const Vector3d x = sample.frame.to_world(y);
    fit.piece.low = std::min(fit.piece.low, x.z());
    fit.piece.high = std::max(fit.piece.high, x.z());
    points.push_back(x.head<2>());
  }
  fit.piece.footprint = least_body<2>(points, margin * sample.frame.scale, fit);
  fit.volume = fit.piece.footprint->volume();
  return fit;
}

ContainingFit ellipsoid(const CanonicalSample& sample, double margin) {
  ContainingFit fit;
  fit.starts = 1;
  fit.piece.body = CombinedEllipsoid(least_body<3>(sample.points, margin, fit));
  fit.volume = fit.piece.body.ellipsoid().volume();
  return fit;
}

}  // namespace

ContainingFit containing_fit(const CanonicalSample& sample, Shape shape, const ContainingOptions& options) {
  for (std::size_t i = 0; i < sample.triangles.size(); ++i)
    for (const auto corner : sample.triangles[i])
      if (!(static_cast<std::size_t>(corner) < sample.points.size()))
        throw InputError("triangles[" + std::to_string(i) + "]", std::to_string(corner),
                         "indices of points, below " + std::to_string(sample.points.size()));
  if (shape == Shape::ellipse) return footprint(sample, options.margin);
  const ContainingFit least = ellipsoid(sample, options.margin);
  if (shape == Shape::ellipsoid) return least;
  // The search for starts branches: it sees rounded coordinates. The last steps see the points.
  CanonicalSample grid = sample;
  for (Vector3d& y : grid.points) y = rounded(y);
  ContainingFit search;
  ContainingFit fit =
      combined(sample, grid, least_body<3>(grid.points, options.margin, search), shape, options);
  if (fit.volume < least.volume) return fit;
  // Nothing is to be cut away.
  fit.piece = least.piece;
  fit.volume = least.volume;
  fit.converged = least.converged;
  fit.stationarity = least.stationarity;
  return fit;
}

}  // namespace vericone::fitting
