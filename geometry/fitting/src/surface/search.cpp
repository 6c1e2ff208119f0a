// SPDX-License-Identifier: BSD-3-Clause
#include "surface/search.h"
#include <vericone/internal/fitting/fit_surface.h>

#include <algorithm>
#include <cmath>

#include "dense_eigen.h"
#include "surface/robust_scale.h"

namespace vericone::fitting {
namespace {

using Eigen::Vector3d, Eigen::VectorXd;

/// Of the biweight, in standard deviations: 95 % efficient for normal noise.
constexpr double kCutoff = 4.685;
/// Exact points have no scale; this is far above rounding and far below what matters, in the unit ball.
constexpr double kFloor = 1e-9;
constexpr std::size_t kFew = 250, kMore = 600, kPlenty = 1000;

std::vector<Residual> sizes_of(const VectorXd& r, const Cloud& cloud) {
  std::vector<Residual> all(cloud.points.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = {std::abs(r(static_cast<Eigen::Index>(i))), cloud.weights[i]};
  return all;
}

double scale_of(const SurfaceModel& model, const Parameters& parameters, const Cloud& cloud) {
  return robust_scale(sizes_of(residuals(model, parameters, cloud), cloud), kFloor);
}

bool is_open(const SurfaceModel& model, const Parameters& parameters, bool converged) {
  // A solver on its way to infinity does not arrive there.
  constexpr double kLongestKnown = 50, kLong = 10;
  return !(Surfaces(model, parameters).semi_axes()(0) < (converged ? kLongestKnown : kLong));
}

/// Some steps from a start.
struct Attempt {
  SurfaceStart start;
  VectorXd residuals;
  double scale = 0;
  double score = 0;  // what starts are compared by
  bool open = false;
};

Attempt attempt(const SurfaceStart& start, const Cloud& cloud, bool robust, int rounds, int iterations) {
  constexpr double kMedian = 0.6745;  // of |x| for normal x
  Attempt a;
  a.start = start;
  for (int k = 0; k < (robust ? rounds : 1); ++k) {
    double cutoff = 0;
    if (robust) {
      // The median, not the scale of the best part: a start has to find the rest yet.
      std::vector<Residual> sizes = sizes_of(residuals(start.model, a.start.parameters, cloud), cloud);
      cutoff = kCutoff * std::max(kFloor, weighted_quantile(sizes, 0.5) / kMedian);
    }
    const Solution s = descend(start.model, a.start.parameters, cloud, cutoff, iterations);
    a.start.parameters = s.parameters;
    a.score = s.cost;
  }
  a.residuals = residuals(start.model, a.start.parameters, cloud);
  a.scale = robust_scale(sizes_of(a.residuals, cloud), kFloor);
  a.open = is_open(start.model, a.start.parameters, true);
  return a;
}

/// One measure for all: the squares, but at most that of six times the least scale, so that a surface near
/// many points is better than one very near few.
void score_robustly(std::vector<Attempt>& all, const Cloud& cloud) {
  double least = all.front().scale;
  for (const Attempt& a : all) least = std::min(least, a.scale);
  const double most = 36 * least * least;
  for (Attempt& a : all) {
    a.score = 0;
    for (std::size_t i = 0; i < cloud.weights.size(); ++i)
      a.score += cloud.weights[i] * std::min(most, std::pow(a.residuals(static_cast<Eigen::Index>(i)), 2));
  }
}

/// The attempts with the least scores, best first.
std::vector<SurfaceStart> best(const std::vector<SurfaceStart>& starts, const Cloud& cloud, bool robust,
                               int rounds, int iterations, std::size_t most) {
  std::vector<Attempt> all;
  for (const SurfaceStart& s : starts) all.push_back(attempt(s, cloud, robust, rounds, iterations));
  if (robust) score_robustly(all, cloud);
  std::stable_sort(all.begin(), all.end(), [](const Attempt& a, const Attempt& b) {
    return a.open != b.open ? b.open : a.score < b.score;
  });
  std::vector<SurfaceStart> chosen;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i) chosen.push_back(all[i].start);
  return chosen;
}

FittedSurface refined(const SurfaceStart& start, const Cloud& cloud, const SurfaceFitOptions& options) {
  // Where points do not determine dents and waists the solver creeps to its last step. It does so with some
  // of very many points already.
  constexpr std::size_t kMany = 1500;
  if (!start.model.delimiters.empty() && cloud.points.size() > 2 * kMany) {
    FittedSurface some = refined(start, thinned(cloud, kMany), options);
    if (!some.solution.converged || is_open(some)) return some;
  }
  FittedSurface fit;
  fit.model = start.model;
  Parameters p = start.parameters;
  int iterations = 0;
  if (options.robust) {
    // The scale is settled first and then kept, so that the result is the minimum of one function.
    double last = 0;
    for (int round = 0; round < 20; ++round) {
      const double scale = scale_of(fit.model, p, cloud);
      fit.cutoff = kCutoff * scale;
      if (std::abs(scale - last) <= 1e-2 * scale) break;
      last = scale;
      const Solution s = descend(fit.model, p, cloud, fit.cutoff, std::min(10, options.max_iterations));
      p = s.parameters;
      iterations += s.iterations;
    }
  }
  // The solver may come to rest at a ridge, where points inside are about to change their surface. From a
  // place beside it, it goes on to a minimum.
  constexpr int kTries = 3;
  constexpr double kAside = 1e-4;
  for (int k = 0; k < kTries && !fit.solution.converged; ++k) {
    fit.solution = descend(fit.model, p, cloud, fit.cutoff, options.max_iterations);
    polish(fit.model, cloud, fit.cutoff, fit.solution);
    iterations += fit.solution.iterations;
    for (Eigen::Index i = 0; i < p.size(); ++i)
      p(i) = fit.solution.parameters(i) + ((i + k) % 2 ? kAside : -kAside);
  }
  fit.solution.iterations = iterations;
  fit.noise = least_squares_noise(fit.model, fit.solution.parameters, cloud);
  if (options.robust) {
    const double n = effective_points(cloud), left = n - fit.model.size();
    fit.noise = scale_of(fit.model, fit.solution.parameters, cloud) * std::sqrt(left > 0.5 ? n / left : 1);
  }
  return fit;
}

/// What is best: closed before open, converged before not converged, then the least noise.
bool better(const FittedSurface& a, const FittedSurface& b) {
  const bool a_open = is_open(a), b_open = is_open(b);
  if (a_open != b_open) return b_open;
  if (a.solution.converged != b.solution.converged) return a.solution.converged;
  return a.noise < b.noise;
}

FittedSurface refined_best(const std::vector<SurfaceStart>& starts, const Cloud& cloud,
                           const SurfaceFitOptions& options) {
  FittedSurface result = refined(starts.front(), cloud, options);
  for (std::size_t i = 1; i < starts.size(); ++i) {
    const FittedSurface other = refined(starts[i], cloud, options);
    if (better(other, result)) result = other;
  }
  return result;
}

/// Points near the surface: what the noise allows, and in any case most of them, since a first surface may be
/// near one part of the body only.
Cloud near_points(const FittedSurface& fit, const Cloud& cloud) {
  const VectorXd r = residuals(fit.model, fit.solution.parameters, cloud);
  std::vector<Residual> sizes = sizes_of(r, cloud);
  const double most = std::max(4 * fit.noise, 1.5 * weighted_quantile(sizes, 0.6));
  Cloud near;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (std::abs(r(static_cast<Eigen::Index>(i))) <= most) {
      near.points.push_back(cloud.points[i]);
      near.weights.push_back(cloud.weights[i]);
    }
  return thinned(near, kMore);
}

/// Starts about the densest share of the points.
void add_dense_starts(const SurfaceModel& model, const Cloud& cloud, int sheets, double share,
                      std::vector<SurfaceStart>& all) {
  const Cloud dense = thinned(concentrated(cloud, share), kMore);
  const Parameters p = ellipsoid_starts(dense, false).back();
  const Vector3d deepest = deepest_direction(thinned(dense, kFew), p.head<3>());
  for (const SurfaceStart& s : delimited_starts(model, p, sheets, dense, deepest)) all.push_back(s);
}

}  // namespace

bool is_open(const FittedSurface& fit) {
  return is_open(fit.model, fit.solution.parameters, fit.solution.converged);
}

VectorXd spread(const Cloud& cloud, bool planar) {
  Vector3d mean = Vector3d::Zero();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) mean += cloud.weights[i] * cloud.points[i];
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    covariance += cloud.weights[i] * (cloud.points[i] - mean) * (cloud.points[i] - mean).transpose();
  const int d = planar ? 2 : 3;
  return dense_eigen(covariance.topLeftCorner(d, d)).values;
}

bool is_flat(const FittedSurface& fit, const Cloud& cloud) {
  const bool planar = fit.model.planar;
  const double thickness = std::sqrt(std::max(0.0, spread(cloud, planar)(0)));
  const Vector3d a = Surfaces(fit.model, fit.solution.parameters).semi_axes();
  return thickness < 2.5 * fit.noise || a(planar ? 1 : 2) < 2 * fit.noise;
}

FittedSurface fit_ellipsoid(const Cloud& cloud, bool planar, const SurfaceFitOptions& options) {
  SurfaceModel model;
  model.planar = planar;
  std::vector<Parameters> starts = ellipsoid_starts(cloud, planar);
  if (options.robust) {
    starts.resize(1);
    for (const Parameters& p : trial_starts(cloud, planar, options.seed, 5)) starts.push_back(p);
  }
  std::vector<SurfaceStart> all;
  for (const Parameters& p : starts) all.push_back({model, p});
  all = best(all, thinned(cloud, options.robust ? kFew : kMore), options.robust, 3, 15, 3);
  if (options.robust) all = best(all, thinned(cloud, kMore), true, 2, 15, 1);
  if (cloud.points.size() > kPlenty) {
    // A plane or a cylinder shows in few of many points. With all of them the solver would creep to infinity.
    const Cloud some = thinned(cloud, kPlenty);
    SurfaceFitOptions short_way = options;
    short_way.max_iterations = std::min(options.max_iterations, 60);
    const FittedSurface few = refined(all.front(), some, short_way);
    if (is_open(few) || is_flat(few, some)) return few;
  }
  return refined_best({all.front()}, cloud, options);
}

FittedSurface base_ellipsoid(const Cloud& cloud, const SurfaceFitOptions& options) {
  constexpr double kStretched = 3;
  FittedSurface base = fit_ellipsoid(cloud, false, options);
  if (base.solution.converged && Surfaces(base.model, base.solution.parameters).semi_axes()(0) < kStretched)
    return base;
  base.solution.parameters = options.robust ? trial_starts(cloud, false, options.seed, 1).front()
                                            : ellipsoid_starts(cloud, false).back();
  base.noise = options.robust ? scale_of(base.model, base.solution.parameters, cloud)
                              : least_squares_noise(base.model, base.solution.parameters, cloud);
  return base;
}

FittedSurface add_delimiter(const FittedSurface& from, const Cloud& cloud, int sheets,
                            const SurfaceFitOptions& options) {
  const Cloud near = near_points(from, cloud);
  const Vector3d center = from.solution.parameters.head<3>();
  std::vector<SurfaceStart> all = delimited_starts(from.model, from.solution.parameters, sheets, near,
                                                   deepest_direction(thinned(near, kFew), center));
  const bool first = options.robust && from.model.delimiters.empty();
  // The first ellipsoid may be near one part of the body only.
  if (first) add_dense_starts(from.model, cloud, sheets, 0.65, all);
  const auto few = best(all, thinned(cloud, kFew), options.robust, 2, 8, 3);
  const auto one = best(few, thinned(cloud, kMore), options.robust, 2, 15, 1);
  FittedSurface fit = refined_best(one, cloud, options);
  if (!first || (fit.solution.converged && !is_open(fit))) return fit;
  // No body is found from there: once more, with more work.
  all.clear();
  for (const double share : {0.55, 0.75}) add_dense_starts(from.model, cloud, sheets, share, all);
  const auto more = best(all, thinned(cloud, kMore), true, 4, 15, 3);
  const FittedSurface again = refined_best(more, cloud, options);
  return better(again, fit) ? again : fit;
}

// One more delimiter is taken where the noise falls clearly: by a tenth, and by more than six parameters
// should make it fall (the Bayesian criterion). Both kinds are tried as the first, since the better one alone
// need not be part of the better pair.
FittedSurface fit_star(const FittedSurface& ellipsoid, const Cloud& cloud, const SurfaceFitOptions& options) {
  constexpr double kClear = 0.9;
  const double n = std::max(effective_points(cloud), 2.0), clear = std::exp(-6 * std::log(n) / (2 * n));
  const auto needed = [&](const FittedSurface& next, const FittedSurface& now) {
    if (is_open(next) || !next.solution.converged) return false;
    return is_open(now) || next.noise < std::min(kClear, clear) * now.noise;
  };
  const FittedSurface dents = add_delimiter(ellipsoid, cloud, 2, options);
  const FittedSurface waist = add_delimiter(ellipsoid, cloud, 1, options);
  FittedSurface star = better(waist, dents) ? waist : dents;
  std::vector<FittedSurface> parents{dents, waist};
  for (int count = 2; count <= 3; ++count) {
    FittedSurface best = star;
    for (const FittedSurface& parent : parents)
      for (const int sheets : {2, 1}) {
        const FittedSurface next = add_delimiter(parent, cloud, sheets, options);
        if (best.model.delimiters.size() < next.model.delimiters.size() || better(next, best)) best = next;
      }
    if (!needed(best, star)) break;
    star = best;
    parents = {star};
  }
  return star;
}

}  // namespace vericone::fitting
