// SPDX-License-Identifier: BSD-3-Clause
#include "composite/cells.h"

#include <vericone/geometry/combined.h>
#include <cmath>

namespace vericone::composite {
namespace {

using assembly::kUlp;

/// Bounds of y^T M y over |y - m| <= h, coordinate by coordinate.
struct Range {
  double least, most;
};
Range range_of_form(const Eigen::Matrix3d& form, const Eigen::Vector3d& m, const Eigen::Vector3d& h) {
  const Eigen::Vector3d slope = form * m;
  const double value = m.dot(slope), linear = 2 * slope.cwiseAbs().dot(h);
  double low = 0, high = 0;
  for (int i = 0; i < 3; ++i) {
    const double square = form(i, i) * h(i) * h(i);
    (square < 0 ? low : high) += square;
    for (int j = 0; j < i; ++j) {
      const double mixed = 2 * std::abs(form(i, j)) * h(i) * h(j);
      low -= mixed;
      high += mixed;
    }
  }
  const Eigen::Vector3d reach = m.cwiseAbs() + h;
  const double slack = 64 * kUlp * reach.dot(form.cwiseAbs() * reach) + 1e-280;
  return {value - linear + low - slack, value + linear + high + slack};
}

/// A number of 24 bits, not below x > 0.
double few_bits_above(double x) {
  const int exponent = std::ilogb(x) - 22;
  return std::ldexp(std::ceil(std::ldexp(x, -exponent)), exponent);
}

}  // namespace

CellTree::CellTree(const CombinedEllipsoid& body, double tolerance) : body_(body), round_(body.ellipsoid()) {
  for (int k = 0; k < 3; ++k) root_(k) = few_bits_above(round_.reach()(k));
  pad_ = 8 * kUlp * (body.center().cwiseAbs() + root_);
  round_.check_range(2 * root_.sum());
  most_levels_ = static_cast<std::uint32_t>(std::clamp(std::ceil(-std::log2(tolerance)), 1.0, 20.0));
}

Eigen::Vector3d CellTree::middle(const Cell& cell) const {
  Eigen::Vector3d m;
  for (int k = 0; k < 3; ++k)
    m(k) = root_(k) * (std::ldexp(2.0 * cell.at[k] + 1, -static_cast<int>(cell.level)) - 1);
  return m;
}

Eigen::Vector3d CellTree::half(const Cell& cell) const {
  return root_ * std::ldexp(1.0, -static_cast<int>(cell.level));
}

Box CellTree::box(const Cell& cell) const {
  const Eigen::Vector3d at = body_.center() + middle(cell), h = half(cell) + pad_;
  return {at - h, at + h};
}

bool CellTree::empty(const Cell& cell) const {
  const Eigen::Vector3d m = middle(cell), h = half(cell);
  const Eigen::Vector3d y = round_.to_frame() * m;
  const double length = y.norm();
  if (length > 0) {
    const Eigen::Vector3d back = round_.to_frame().transpose() * (y / length);
    const double slack = 64 * kUlp * round_.norm() * (m.norm() + h.norm()) + round_.beyond_range();
    if (length - back.cwiseAbs().dot(h) - slack > round_.outer()) return true;
  }
  for (const Delimiter<3>& d : body_.delimiters())
    if (range_of_form(d.matrix, m, h).least > d.level) return true;
  return false;
}

bool CellTree::full(const Cell& cell) const {
  // box() may stand out of the cell by the pad and the rounding of its place.
  const Eigen::Vector3d m = middle(cell), h = half(cell) + 2 * pad_;
  const double slack = 64 * kUlp * round_.norm() * (m.norm() + h.norm()) + round_.beyond_range();
  // The farthest point of a box is a corner.
  const Eigen::Matrix3d edges = round_.to_frame() * h.asDiagonal();
  const Eigen::Vector3d y = round_.to_frame() * m;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d e = edges * Eigen::Vector3d(1, i & 1 ? 1 : -1, i & 2 ? 1 : -1);
    if (!(std::max((y + e).norm(), (y - e).norm()) + slack < round_.inner())) return false;
  }
  for (const Delimiter<3>& d : body_.delimiters())
    if (!(range_of_form(d.matrix, m, h).most < d.level)) return false;
  return true;
}

CellTree::Quadratic CellTree::quadratic(std::size_t i, const Eigen::Vector3d& m,
                                        const Eigen::Vector3d& h) const {
  const Eigen::Vector3d reach = m.cwiseAbs() + h;
  if (i == 0) {
    const Eigen::Vector3d y = round_.to_frame() * m;
    const double far = round_.norm() * reach.norm(), outer = round_.outer();
    const double slack = 64 * kUlp * (far * far + outer * outer) + round_.beyond_range();
    return {2 * (round_.to_frame().transpose() * y), y.squaredNorm() - outer * outer, slack};
  }
  const Delimiter<3>& d = body_.delimiters()[i - 1];
  const Eigen::Vector3d slope = d.matrix * m;
  double bend = 64 * kUlp * (reach.dot(d.matrix.cwiseAbs() * reach) + d.level) + 1e-280;
  for (int j = 0; j < 3; ++j) {
    bend += std::max(0.0, -d.matrix(j, j)) * h(j) * h(j);
    for (int k = 0; k < j; ++k) bend += 2 * std::abs(d.matrix(j, k)) * h(j) * h(k);
  }
  return {2 * slope, m.dot(slope) - d.level, bend};
}

double CellTree::room(const Cell& cell, const Eigen::Vector3d& n) const {
  const Eigen::Vector3d m = middle(cell), h = half(cell);
  const double all = n.cwiseAbs().dot(h);
  double best = 0;
  for (std::size_t i = 0; i <= body_.delimiters().size(); ++i) {
    const Quadratic q = quadratic(i, m, h);
    // Linear in l between the values where an entry of n - l slope vanishes: the best is one of those.
    for (int k = 0; k < 3; ++k) {
      const double l = n(k) / q.slope(k);
      if (!(l > 0) || !std::isfinite(l)) continue;
      const Eigen::Vector3d rest = n - l * q.slope;
      const double cut = rest.cwiseAbs().dot(h) - l * (q.value - q.bend);
      const double slack = 64 * kUlp * (all + l * q.slope.cwiseAbs().dot(h) + l * std::abs(q.value));
      best = std::max(best, all - cut - slack);
    }
  }
  return best;
}

int CellTree::normals(const Cell& cell, Eigen::Vector3d (&out)[3]) const {
  const Eigen::Vector3d m = middle(cell), h = half(cell);
  int count = 0;
  for (std::size_t i = 0; i <= body_.delimiters().size() && count < 3; ++i) {
    const Quadratic q = quadratic(i, m, h);
    // Those whose surface may pass through the cell.
    if (q.value + q.slope.cwiseAbs().dot(h) + q.bend < 0 || q.slope.isZero(0)) continue;
    out[count++] = q.slope;
  }
  return count;
}

std::optional<Eigen::Vector3d> CellTree::witness(const Cell& cell) const {
  const Eigen::Vector3d m = middle(cell), at = body_.center() + m;
  if (!at.allFinite()) return std::nullopt;
  if (side<3>(body_, at) == Sign::negative) return at;
  // The body is star-shaped about its centre: what is pulled towards it comes inside.
  const double gauge = body_.gauge(m);
  if (!(gauge > 0) || !std::isfinite(gauge)) return std::nullopt;
  const double inwards = (1 - std::ldexp(0.03125, -static_cast<int>(cell.level))) / gauge;
  const Eigen::Vector3d pulled = body_.center() + inwards * m;
  const Eigen::Vector3d far = (pulled - at).cwiseAbs() - 2 * half(cell);
  if (far.maxCoeff() > 0 || side<3>(body_, pulled) != Sign::negative) return std::nullopt;
  return pulled;
}

}  // namespace vericone::composite
