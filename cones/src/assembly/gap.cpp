// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/gap.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace vericone::assembly {
namespace {

constexpr int kMostSteps = 64;

/// Generators of the face that holds the point of least norm: at least one point, and rays.
struct Corral {
  static std::array<Eigen::Vector3d, 4> zeros() {
    return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
            Eigen::Vector3d::Zero()};
  }
  std::array<Eigen::Vector3d, 4> of = zeros(), on_piece = zeros();
  int ray[4] = {-1, -1, -1, -1};  // which ray; -1 for a point
  double weight[4] = {1, 0, 0, 0};
  int size = 0;

  void add(const Eigen::Vector3d& x, int which, const Eigen::Vector3d& piece = Eigen::Vector3d::Zero()) {
    of[size] = x;
    on_piece[size] = piece;
    ray[size] = which;
    weight[size] = 0;
    ++size;
  }

  bool has_ray(int i) const {
    for (int j = 0; j < size; ++j)
      if (ray[j] == i) return true;
    return false;
  }

  /// v without what rounding left of it along the rays of the face, where nothing is left in exact
  /// arithmetic. Near touching that is most of what v is off by.
  Eigen::Vector3d normal(Eigen::Vector3d v) const {
    Eigen::Vector3d basis[3];
    int n = 0;
    for (int i = 0; i < size; ++i) {
      if (ray[i] < 0 || n == 2) continue;
      basis[n] = of[i];
      if (n == 1) basis[1] -= basis[1].dot(basis[0]) * basis[0];
      const double length = basis[n].norm();
      if (length > 1e-12) basis[n++] /= length;
    }
    for (int sweep = 0; sweep < 2; ++sweep)
      for (int i = 0; i < n; ++i) v -= v.dot(basis[i]) * basis[i];
    return v;
  }

  void drop(int i) {
    --size;
    for (; i < size && i < 3; ++i) {
      of[i] = of[i + 1];
      on_piece[i] = on_piece[i + 1];
      ray[i] = ray[i + 1];
      weight[i] = weight[i + 1];
    }
  }

  /// The weights of the least norm in the affine hull; false where the generators are dependent.
  bool affine(double (&x)[4]) const {
    int base = 0;
    while (ray[base] >= 0) ++base;
    Eigen::Vector3d m[3];
    int index[3], n = 0;
    for (int i = 0; i < size; ++i)
      if (i != base) {
        m[n] = ray[i] >= 0 ? of[i] : of[i] - of[base];
        index[n++] = i;
      }
    // Least squares |of[base] + m x| by orthogonalisation, not by normal equations: the rays of a narrow
    // sector are nearly one.
    double r[3][3], x_of[3];
    Eigen::Vector3d rest = -of[base];
    for (int i = 0; i < n; ++i) {
      const double length = m[i].norm();
      for (int j = 0; j < i; ++j) r[j][i] = 0;
      for (int sweep = 0; sweep < 2; ++sweep)
        for (int j = 0; j < i; ++j) {
          const double part = m[j].dot(m[i]);
          r[j][i] += part;
          m[i] -= part * m[j];
        }
      r[i][i] = m[i].norm();
      if (!(r[i][i] > 1e-13 * length)) return false;
      m[i] /= r[i][i];
      x_of[i] = m[i].dot(rest);
      rest -= x_of[i] * m[i];
    }
    for (int i = n - 1; i >= 0; --i) {
      for (int j = i + 1; j < n; ++j) x_of[i] -= r[i][j] * x_of[j];
      x_of[i] /= r[i][i];
    }
    x[base] = 1;
    for (int i = 0; i < n; ++i) {
      x[index[i]] = x_of[i];
      if (ray[index[i]] < 0) x[base] -= x_of[i];
    }
    return true;
  }

  /// Drops generators until the point of least norm of the affine hull has positive weights. The weights so
  /// far are feasible, and stay so.
  bool minimise() {
    for (;;) {
      double x[4];
      if (!affine(x)) return false;
      double step = 1;
      int out = -1;
      for (int i = 0; i < size; ++i)
        if (!(x[i] > 0)) {
          const double s = weight[i] > 0 ? weight[i] / (weight[i] - x[i]) : 0;
          if (out < 0 || s < step) {
            step = s;
            out = i;
          }
        }
      if (out < 0) {
        for (int i = 0; i < size; ++i) weight[i] = x[i];
        return true;
      }
      for (int i = 0; i < size; ++i) weight[i] += step * (x[i] - weight[i]);
      int points = 0;
      for (int i = 0; i < size; ++i) points += ray[i] < 0;
      if (ray[out] < 0 && points == 1) return false;  // by rounding only: points have the weight 1 together
      drop(out);
    }
  }

  /// Whether 0 is a combination of the four generators with positive weights even if each point is off by
  /// `error` and each ray by `ray_error`. Points are divided by the length of the longest, so that the size
  /// of the scene does not matter. With M the matrix of the generators over a row that adds up the points'
  /// weights, M x = (0, 1); a change E of M moves x by no more than |M^-1| |E| |x| / (1 - |M^-1| |E|).
  bool surely_around_zero(double error, double ray_error) const {
    double longest = 0;
    for (int i = 0; i < 4; ++i)
      if (ray[i] < 0) longest = std::max(longest, of[i].norm());
    if (!(longest > 0)) return false;
    Eigen::Matrix4d m;
    Eigen::Vector4d x;
    double change = 0;
    for (int i = 0; i < 4; ++i) {
      const bool point = ray[i] < 0;
      const double unit = point ? longest : 1;
      m.col(i) << of[i] / unit, (point ? 1.0 : 0.0);
      x(i) = weight[i] * unit / longest;
      const double off = (point ? error / longest : ray_error) + 4 * kUlp;
      change += off * off;
    }
    const Eigen::Matrix4d inverse = m.inverse();
    if (!inverse.allFinite()) return false;
    const double norm = inverse.norm();
    const double relative = norm * std::sqrt(change);
    const double residual =
        norm * ((m * x - Eigen::Vector4d(0, 0, 0, 1)).norm() + 16 * kUlp * m.norm() * x.norm());
    if (!(relative < 0.01) || !((m * inverse - Eigen::Matrix4d::Identity()).norm() < 0.01)) return false;
    return x.minCoeff() > 1.1 * (relative * x.norm() + residual);
  }

  /// Point and ray part of the combination, with weights that are feasible without rounding to trust.
  void read(Gap& gap) const {
    double total = 0;
    for (int i = 0; i < size; ++i)
      if (ray[i] < 0) total += weight[i];
    gap.k.setZero();
    gap.on_piece.setZero();
    std::fill(gap.along, gap.along + 3, 0.0);
    Eigen::Vector3d d = Eigen::Vector3d::Zero();
    for (int i = 0; i < size; ++i) {
      if (ray[i] < 0) {
        gap.k += (weight[i] / total) * of[i];
        gap.on_piece += (weight[i] / total) * on_piece[i];
      } else {
        gap.along[ray[i]] = std::max(0.0, weight[i]);
        d += gap.along[ray[i]] * of[i];  // of = -ray
      }
    }
    gap.v = gap.k + d;
  }
};

}  // namespace

Gap gap(const Core& core, const Directions& directions, const Eigen::Vector3d& first, GapGoal goal,
        double relative, double enough) {
  Gap result;
  Eigen::Vector3d on_piece;
  const Eigen::Vector3d start = core.support(first, on_piece);
  // Most pieces are apart, and most of them by the first normal.
  const double reach = core.reach() + core.offset.cwiseAbs().sum();
  const auto least_along = [&](const Eigen::Vector3d& n, const Eigen::Vector3d& s) {
    return n.dot(s) - (core.error() + 32 * kUlp * reach + directions.slant(n) * reach);
  };
  if (goal == GapGoal::decide) {
    result.v = first / first.norm();
    result.least = std::max(0.0, least_along(result.v, start));
    if (result.least > core.outer_rounding()) {
      result.answer = Gap::Answer::apart;
      return result;
    }
  }
  Corral corral;
  corral.add(start, -1, on_piece);
  corral.weight[0] = 1;
  double last_norm = INFINITY;
  for (int step = 0; step < kMostSteps; ++step) {
    // Where the newest generator adds nothing that rounding would show, it does not come in.
    if (Corral next = corral; next.minimise()) corral = next;
    corral.read(result);
    const double norm = result.v.norm();

    // Met: the combination is within the inner ball, and what rounds it is known.
    if (goal == GapGoal::decide) {
      const double far = result.along[0] + result.along[1] + result.along[2];
      if (norm + core.error() + far * (directions.error + 8 * kUlp) + 16 * kUlp * (core.reach() + far) <
          core.inner_rounding()) {
        result.answer = Gap::Answer::met;
        return result;
      }
    }
    if (corral.size == 4) {
      if (goal == GapGoal::decide &&
          corral.surely_around_zero(core.error() + 64 * kUlp * core.reach(), directions.error + 64 * kUlp))
        result.answer = Gap::Answer::met;
      return result;
    }
    if (!(norm < last_norm) || !(norm > 8 * kUlp * core.reach())) return result;
    last_norm = norm;

    int ray = -1;
    // A ray of the face is perpendicular to v up to rounding, and need not come in again.
    double most = 4 * kUlp * norm;
    for (int i = 0; i < directions.count; ++i)
      if (const double slant = result.v.dot(directions.ray[i]); slant > most && !corral.has_ray(i)) {
        most = slant;
        ray = i;
      }
    const Eigen::Vector3d along = corral.normal(result.v);
    const Eigen::Vector3d n = along / along.norm();
    if (!n.allFinite()) return result;
    const Eigen::Vector3d s = core.support(n, on_piece);
    const double distance = n.dot(s);
    // Also where a ray slants: by rounding alone it does when it lies in the span of the face, as where a
    // side of the cell is parallel to an edge of the piece; then it would bring the search no further.
    const double least = least_along(n, s);
    if (least > result.least) result.least = least;
    if (least > core.outer_rounding()) {
      result.answer = Gap::Answer::apart;
      if (goal == GapGoal::decide) return result;
    }
    if (ray < 0) {
      if (result.least > enough) return result;
      if (norm - distance <= std::max(relative, 2 * kUlp) * norm) return result;
      corral.add(s, -1, on_piece);
    } else {
      corral.add(-directions.ray[ray], ray);
    }
  }
  return result;
}

}  // namespace vericone::assembly
