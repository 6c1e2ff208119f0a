// SPDX-License-Identifier: BSD-3-Clause
//
// The volume of a union of solids: each along a column is one stretch, so what is counted too often is known;
// over the columns a lattice sums it up (as union_volume.cpp does for quadrics).
#include <vericone/geometry/error.h>
#include <vericone/internal/fitting/solids.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include "infinity.h"

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

struct SolidStretch {
  double from = -kInfinity, to = kInfinity;
  void keep(double low, double high) {
    from = std::max(from, low);
    to = std::min(to, high);
  }
};

/// Of p + t d where a t^2 + 2 b t + c <= 0, a >= 0.
void keep_below(double a, double b, double c, SolidStretch& s) {
  if (a < 1e-30) return c <= 0 ? void() : s.keep(kInfinity, -kInfinity);
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0)) return s.keep(kInfinity, -kInfinity);
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  const double first = q / a, second = q == 0 ? 0 : c / q;
  s.keep(std::min(first, second), std::max(first, second));
}

void keep_slab(double x, double way, double half, SolidStretch& s) {
  if (std::abs(way) < 1e-15) return std::abs(x) <= half ? void() : s.keep(kInfinity, -kInfinity);
  const double a = (-half - x) / way, b = (half - x) / way;
  s.keep(std::min(a, b), std::max(a, b));
}

SolidStretch in_ball(const Vector3d& p, const Vector3d& d, double radius) {
  SolidStretch s;
  keep_below(d.squaredNorm(), p.dot(d), p.squaredNorm() - radius * radius, s);
  return s;
}

SolidStretch in_cylinder(const Vector3d& p, const Vector3d& d, double radius, double height) {
  SolidStretch s;
  keep_below(d.head<2>().squaredNorm(), p.head<2>().dot(d.head<2>()),
             p.head<2>().squaredNorm() - radius * radius, s);
  keep_slab(p.z(), d.z(), 0.5 * height, s);
  return s;
}

/// Where the line y + t d is in the body, in its own frame: one stretch, since it is convex.
SolidStretch stretch_of(const Solid& solid, const Vector3d& y, const Vector3d& d) {
  const Vector3d& s = solid.sizes;
  switch (solid.kind) {
    case SolidKind::sphere:
      return in_ball(y, d, s(0));
    case SolidKind::cylinder:
      return in_cylinder(y, d, s(0), s(1));
    case SolidKind::capsule: {
      const Vector3d half(0, 0, 0.5 * s(1));
      SolidStretch whole{kInfinity, -kInfinity};
      for (const SolidStretch& part :
           {in_ball(y - half, d, s(0)), in_ball(y + half, d, s(0)), in_cylinder(y, d, s(0), s(1))})
        if (part.from < part.to) whole = {std::min(whole.from, part.from), std::max(whole.to, part.to)};
      return whole;
    }
    case SolidKind::box: {
      SolidStretch all;
      for (int k = 0; k < 3; ++k) keep_slab(y(k), d(k), s(k), all);
      return all;
    }
    case SolidKind::ellipsoid:
      break;
  }
  const double least = s.minCoeff();
  return in_ball(least * y.cwiseQuotient(s), least * d.cwiseQuotient(s), least);
}

/// Half of what the body covers along each of the axes.
Vector3d extent(const Solid& solid, const Matrix3d& axes) {
  const Matrix3d in_body = solid.rotation.transpose() * axes;
  const Vector3d& s = solid.sizes;
  Vector3d half;
  for (int k = 0; k < 3; ++k) {
    const Vector3d n = in_body.col(k);
    const bool round = solid.kind == SolidKind::sphere || solid.kind == SolidKind::capsule;
    if (solid.kind == SolidKind::box)
      half(k) = n.cwiseAbs().dot(s);
    else if (solid.kind == SolidKind::ellipsoid)
      half(k) = n.cwiseProduct(s).norm();
    else
      half(k) = s(0) * (round ? 1 : n.head<2>().norm()) +
                (solid.kind == SolidKind::sphere ? 0 : 0.5 * s(1) * std::abs(n.z()));
  }
  return half;
}

struct Shadowed {
  Solid solid;
  Vector2d low, high;  // of its shadow along the columns
};

class ColumnsOfSolids {
 public:
  ColumnsOfSolids(const std::vector<Solid>& solids, const Matrix3d& axes) : axes_(axes) {
    for (const Solid& s : solids) {
      const Vector2d center = (axes.transpose() * s.center).head<2>(), half = extent(s, axes).head<2>();
      solids_.push_back({s, center - half, center + half});
    }
    for (std::size_t i = 0; i < solids_.size(); ++i)
      for (std::size_t j = i + 1; j < solids_.size(); ++j) {
        const Vector2d low = solids_[i].low.cwiseMax(solids_[j].low),
                       high = solids_[i].high.cwiseMin(solids_[j].high);
        if (!(low.array() < high.array()).all()) continue;
        low_ = low_.cwiseMin(low);
        high_ = high_.cwiseMax(high);
      }
  }

  bool overlap() const { return (low_.array() < high_.array()).all(); }

  /// By a Fibonacci lattice of `count` points at four places; the mean and twice the deviation of the four.
  VolumeEstimate excess(std::size_t count, std::size_t before) const {
    constexpr std::array<std::array<double, 2>, 4> kShifts{
        {{0.125, 0.4142}, {0.375, 0.8934}, {0.625, 0.1371}, {0.875, 0.6718}}};
    const Vector2d size = high_ - low_;
    std::array<double, 4> sums{};
    std::vector<SolidStretch> found;
    for (std::size_t s = 0; s < 4; ++s) {
      for (std::size_t k = 0; k < count; ++k) {
        const double along = (double(k) + kShifts[s][0]) / double(count);
        const double turned = double((k * before) % count) / double(count) + kShifts[s][1];
        sums[s] += over(low_ + size.cwiseProduct(Vector2d(along, turned - std::floor(turned))), found);
      }
      sums[s] *= size.x() * size.y() / double(count);
    }
    const double mean = 0.25 * (sums[0] + sums[1] + sums[2] + sums[3]);
    double squares = 0;
    for (const double s : sums) squares += (s - mean) * (s - mean);
    return {mean, 2 * std::sqrt(squares / 3)};
  }

 private:
  double over(const Vector2d& p, std::vector<SolidStretch>& found) const {
    checkpoint();
    found.clear();
    const Vector3d from = axes_.leftCols<2>() * p;
    for (const Shadowed& s : solids_) {
      if ((p.array() < s.low.array()).any() || (p.array() > s.high.array()).any()) continue;
      const SolidStretch stretch = stretch_of(s.solid, s.solid.rotation.transpose() * (from - s.solid.center),
                                              s.solid.rotation.transpose() * axes_.col(2));
      if (stretch.from < stretch.to) found.push_back(stretch);
    }
    std::sort(found.begin(), found.end(),
              [](const SolidStretch& a, const SolidStretch& b) { return a.from < b.from; });
    double excess = 0, reached = -kInfinity;
    for (const SolidStretch& s : found) {
      if (s.from < reached) excess += std::min(s.to, reached) - s.from;
      reached = std::max(reached, s.to);
    }
    return excess;
  }

  Matrix3d axes_;
  std::vector<Shadowed> solids_;
  Vector2d low_ = Vector2d::Constant(kInfinity), high_ = Vector2d::Constant(-kInfinity);
};

}  // namespace

VolumeEstimate volume(const std::vector<Solid>& solids) {
  constexpr double kRelative = 2e-5;
  constexpr std::array<std::size_t, 6> kFibonacci{987, 4181, 17711, 75025, 317811, 1346269};
  constexpr std::array<std::size_t, 6> kBefore{610, 2584, 10946, 46368, 196418, 832040};
  if (solids.empty()) throw InputError("pieces", "none", "one piece or more");
  VolumeEstimate sum;
  std::vector<Solid> moved = solids;
  for (Solid& s : moved) {
    sum.value += s.volume();
    s.center -= solids.front().center;
  }
  sum.error = 1e-15 * double(solids.size()) * sum.value;
  // Sides of boxes along the columns would make their ends jump: askew by angles of no meaning.
  const Matrix3d askew = solids.front().rotation * (Eigen::AngleAxisd(0.37, Vector3d::UnitX()) *
                                                    Eigen::AngleAxisd(0.59, Vector3d::UnitY()))
                                                       .toRotationMatrix();
  const ColumnsOfSolids columns(moved, askew);
  if (!columns.overlap()) return sum;
  for (std::size_t k = 0;; ++k) {
    const VolumeEstimate excess = columns.excess(kFibonacci[k], kBefore[k]);
    const VolumeEstimate all{sum.value - excess.value, sum.error + excess.error};
    if (excess.error <= kRelative * all.value || k + 2 == kFibonacci.size()) return all;
  }
}

}  // namespace vericone::fitting
