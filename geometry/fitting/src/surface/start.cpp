// SPDX-License-Identifier: BSD-3-Clause
#include "surface/start.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "dense_eigen.h"
#include "surface/robust_scale.h"

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

template <int D>
using VectorD = Eigen::Matrix<double, D, 1>;
template <int D>
using MatrixD = Eigen::Matrix<double, D, D>;

/// { x : (x - center)^T matrix (x - center) = 1 }.
struct Candidate {
  Vector3d center = Vector3d::Zero();
  Matrix3d matrix = Matrix3d::Zero();
};

template <int D>
struct Moments {
  VectorD<D> mean = VectorD<D>::Zero();
  MatrixD<D> covariance = MatrixD<D>::Zero();
};

template <int D>
Moments<D> moments(const Cloud& cloud) {
  Moments<D> m;
  double sum = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    sum += cloud.weights[i];
    m.mean += cloud.weights[i] * cloud.points[i].head<D>();
  }
  m.mean /= sum;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const VectorD<D> d = cloud.points[i].head<D>() - m.mean;
    m.covariance += cloud.weights[i] / sum * d * d.transpose();
  }
  return m;
}

template <int D>
Candidate embedded(const VectorD<D>& center, const MatrixD<D>& matrix) {
  Candidate c;
  c.center.template head<D>() = center;
  c.matrix.template topLeftCorner<D, D>() = 0.5 * (matrix + matrix.transpose());
  return c;
}

/// The matrix of the constraint on the second-order coefficients, squares first.
template <int D>
auto constraint(double k) {
  constexpr int n = D * (D + 1) / 2;
  MatrixD<n> c = MatrixD<n>::Zero();
  if constexpr (D == 2) {
    c(0, 1) = c(1, 0) = 0.5;
    c(2, 2) = -1;
  } else {
    c.template topLeftCorner<3, 3>().setConstant(0.5 * k - 1);
    for (int i = 0; i < 3; ++i) {
      c(i, i) = -1;
      c(i + 3, i + 3) = -k;
    }
  }
  return c;
}

// In the coordinates where the covariance is the identity the scatter of (2 u, 1) is diag(4, .., 4, 1), so
// the linear part is eliminated without a matrix to invert.
template <int D>
std::optional<Candidate> algebraic(const Cloud& cloud, double k) {
  constexpr int n = D * (D + 1) / 2;
  const Moments<D> m = moments<D>(cloud);
  const Cholesky<D> factor = cholesky<D>(m.covariance);
  if (!factor.positive) return std::nullopt;
  const MatrixD<D>& l = factor.lower;
  if (!(l.diagonal().minCoeff() > 1e-9 * l.diagonal().maxCoeff())) return std::nullopt;

  MatrixD<n> squares = MatrixD<n>::Zero();
  Eigen::Matrix<double, n, D + 1> mixed = Eigen::Matrix<double, n, D + 1>::Zero();
  double sum = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const VectorD<D> u = factor.half_solve(cloud.points[i].template head<D>() - m.mean);
    VectorD<n> q;
    q.template head<D>() = u.cwiseAbs2();
    if constexpr (D == 2)
      q(2) = 2 * u(0) * u(1);
    else
      q.template tail<3>() << 2 * u(1) * u(2), 2 * u(0) * u(2), 2 * u(0) * u(1);
    VectorD<D + 1> line;
    line << 2 * u, 1;
    squares += cloud.weights[i] * q * q.transpose();
    mixed += cloud.weights[i] * q * line.transpose();
    sum += cloud.weights[i];
  }
  squares /= sum;
  mixed /= sum;
  VectorD<D + 1> inverse = VectorD<D + 1>::Constant(0.25);
  inverse(D) = 1;
  MatrixD<n> reduced = squares - mixed * inverse.asDiagonal() * mixed.transpose();
  // Singular where the points are on a quadric exactly; a start needs no more than half the digits.
  reduced += 1e-12 * squares.trace() * MatrixD<n>::Identity();
  // Sizes of which the decompositions are compiled: 3 as it is, 6 as any.
  constexpr int size = n == 3 ? 3 : Eigen::Dynamic;
  SymmetricEigen<size> solver;
  if (!generalized_eigen<size>(constraint<D>(k), reduced, solver) || !(solver.values(n - 1) > 0))
    return std::nullopt;
  VectorD<n> v = solver.vectors.col(n - 1);
  if (v.template head<D>().sum() < 0) v = -v;
  const VectorD<D + 1> linear = -inverse.cwiseProduct(mixed.transpose() * v);
  MatrixD<D> a;
  if constexpr (D == 2)
    a << v(0), v(2), v(2), v(1);
  else
    a << v(0), v(5), v(4), v(5), v(1), v(3), v(4), v(3), v(2);
  const VectorD<D> spectrum = symmetric_eigenvalues<D>(a);
  if (!(spectrum(0) > 1e-6 * spectrum(D - 1))) return std::nullopt;
  const VectorD<D> p = linear.template head<D>(), center = -a.ldlt().solve(p);
  const double level = -p.dot(center) - linear(D);
  if (!(level > 0)) return std::nullopt;
  const MatrixD<D> li = l.inverse();
  return embedded<D>(m.mean + l * center, li.transpose() * (a / level) * li);
}

/// An ellipsoid's surface of this covariance, roughly: the mean square along an axis is a^2 / D.
template <int D>
Candidate principal(const Cloud& cloud) {
  const Moments<D> m = moments<D>(cloud);
  return embedded<D>(m.mean, m.covariance.inverse() / D);
}

/// |x|^2 = 2 c.x + e by linear least squares.
template <int D>
std::optional<Candidate> sphere(const Cloud& cloud) {
  MatrixD<D + 1> normal = MatrixD<D + 1>::Zero();
  VectorD<D + 1> right = VectorD<D + 1>::Zero();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const VectorD<D> x = cloud.points[i].template head<D>();
    VectorD<D + 1> row;
    row << 2 * x, 1;
    normal += cloud.weights[i] * row * row.transpose();
    right += cloud.weights[i] * row * x.squaredNorm();
  }
  const VectorD<D + 1> solution = normal.ldlt().solve(right);
  const VectorD<D> center = solution.template head<D>();
  const double square = solution(D) + center.squaredNorm();
  if (!(square > 0) || !(square < 1e4)) return std::nullopt;
  return embedded<D>(center, MatrixD<D>::Identity() / square);
}

/// Distance along the gradient of the gauge: first order near the surface, and sound far from it.
double rough_distance(const Candidate& c, const Vector3d& x) {
  const Vector3d y = x - c.center, my = c.matrix * y;
  const double gauge = std::sqrt(y.dot(my)), slope = my.norm();
  return slope > 0 ? std::abs(gauge - 1) * gauge / slope : 1e300;
}

std::vector<Residual> rough_residuals(const Candidate& c, const Cloud& cloud) {
  std::vector<Residual> r(cloud.points.size());
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = {rough_distance(c, cloud.points[i]), cloud.weights[i]};
  return r;
}

struct Scored {
  double score;
  Candidate candidate;
};

void sort_by_score(std::vector<Scored>& all, std::size_t most) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Scored& a, const Scored& b) { return a.score < b.score; });
  if (all.size() > most) all.resize(most);
}

double median_distance(const Candidate& c, const Cloud& cloud) {
  std::vector<Residual> r = rough_residuals(c, cloud);
  return weighted_quantile(r, 0.5);
}

/// Fits again and again to the points near the last one.
template <int D>
Scored improved(const Scored& start, const Cloud& cloud, double k) {
  Scored best = start;
  Candidate c = start.candidate;
  for (int round = 0; round < 5; ++round) {
    checkpoint();
    const std::vector<Residual> r = rough_residuals(c, cloud);
    const double near = 3 * robust_scale(r, 1e-12);
    Cloud inliers;
    for (std::size_t i = 0; i < r.size(); ++i)
      if (r[i].size <= near) {
        inliers.points.push_back(cloud.points[i]);
        inliers.weights.push_back(cloud.weights[i]);
      }
    const auto next = algebraic<D>(inliers, k);
    if (!next) break;
    c = *next;
    const double score = median_distance(c, cloud);
    if (score < best.score) best = {score, c};
  }
  return best;
}

template <int D>
std::vector<Scored> trials(const Cloud& cloud, std::uint64_t seed, std::size_t most) {
  // Three more than an ellipsoid has parameters: with 30 % of gross points 1.4 % of the samples have
  // none, and those with one or two are improved.
  constexpr int kTrials = 600, kSize = D == 3 ? 12 : 7;
  constexpr std::size_t kImproved = 8, kScored = 300;
  const Cloud few = thinned(cloud, kScored), more = thinned(cloud, 3 * kScored);
  std::vector<double> cumulative;
  double sum = 0;
  for (const double w : cloud.weights) cumulative.push_back(sum += w);
  std::mt19937_64 engine(seed);
  std::vector<Scored> all;
  Cloud sample;
  sample.weights.assign(kSize, 1.0);
  for (int t = 0; t < kTrials; ++t) {
    checkpoint();
    sample.points.clear();
    for (int i = 0; i < kSize; ++i) {
      const double at = double(engine() >> 11) * 0x1p-53 * sum;
      const auto it = std::upper_bound(cumulative.begin(), cumulative.end(), at);
      sample.points.push_back(
          cloud.points[std::min(static_cast<std::size_t>(it - cumulative.begin()), cloud.points.size() - 1)]);
    }
    for (const double k : {4.0, 12.0})
      if (const auto c = algebraic<D>(sample, k)) all.push_back({median_distance(*c, few), *c});
  }
  sort_by_score(all, kImproved);
  std::vector<Scored> better;
  for (Scored& s : all) {
    s.score = median_distance(s.candidate, more);
    for (const double k : {4.0, 20.0}) better.push_back(improved<D>(s, more, k));
  }
  sort_by_score(better, most);
  return better;
}

}  // namespace

std::optional<Parameters> algebraic_ellipsoid(const Cloud& cloud, bool planar, double k) {
  const auto c = planar ? algebraic<2>(cloud, k) : algebraic<3>(cloud, k);
  if (!c) return std::nullopt;
  return ellipsoid_parameters(planar, c->center, c->matrix);
}

std::vector<Parameters> ellipsoid_starts(const Cloud& cloud, bool planar) {
  std::vector<Parameters> starts;
  for (const double k : {4.0, 12.0, 100.0}) {
    if (planar && k > 4) break;
    if (const auto p = algebraic_ellipsoid(cloud, planar, k)) starts.push_back(*p);
  }
  const auto ball = planar ? sphere<2>(cloud) : sphere<3>(cloud);
  if (ball) starts.push_back(ellipsoid_parameters(planar, ball->center, ball->matrix));
  const Candidate axes = planar ? principal<2>(cloud) : principal<3>(cloud);
  starts.push_back(ellipsoid_parameters(planar, axes.center, axes.matrix));
  return starts;
}

Cloud concentrated(const Cloud& cloud, double share) {
  constexpr int kRounds = 30;
  Vector3d center;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> sorted;
    for (const Vector3d& x : cloud.points) sorted.push_back(x(k));
    std::sort(sorted.begin(), sorted.end());
    center(k) = sorted[sorted.size() / 2];
  }
  Matrix3d inverse = Matrix3d::Identity();
  Cloud part;
  for (int round = 0; round < kRounds; ++round) {
    checkpoint();
    std::vector<Residual> far(cloud.points.size());
    for (std::size_t i = 0; i < far.size(); ++i) {
      const Vector3d y = cloud.points[i] - center;
      far[i] = {y.dot(inverse * y), cloud.weights[i]};
    }
    std::vector<Residual> sorted = far;
    const double most = weighted_quantile(sorted, share);
    part = {};
    for (std::size_t i = 0; i < far.size(); ++i)
      if (far[i].size <= most) {
        part.points.push_back(cloud.points[i]);
        part.weights.push_back(cloud.weights[i]);
      }
    const Moments<3> m = moments<3>(part);
    center = m.mean;
    inverse = (m.covariance + 1e-12 * Matrix3d::Identity()).inverse();
  }
  return part;
}

std::vector<Parameters> trial_starts(const Cloud& cloud, bool planar, std::uint64_t seed, std::size_t most) {
  std::vector<Parameters> starts;
  for (const Scored& s : planar ? trials<2>(cloud, seed, most) : trials<3>(cloud, seed, most))
    starts.push_back(ellipsoid_parameters(planar, s.candidate.center, s.candidate.matrix));
  return starts;
}

}  // namespace vericone::fitting
