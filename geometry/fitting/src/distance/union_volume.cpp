// SPDX-License-Identifier: BSD-3-Clause
//
// The volume of a union is that of its pieces less what is counted more than once. Along parallel columns
// both are known from roots of quadratics; over the columns a lattice sums up what is counted too often, so
// that its error is one of the overlaps alone.
#include <vericone/fitting/fit.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/lengths.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "infinity.h"

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
struct Stretch {
  double from, to;
};

struct Rectangle {
  Vector2d low = Vector2d::Constant(kInfinity), high = Vector2d::Constant(-kInfinity);

  bool empty() const { return !((low.array() < high.array()).all()); }
  bool contains(const Vector2d& p) const {
    return (low.array() <= p.array()).all() && (p.array() <= high.array()).all();
  }
};

/// { y : y^T matrix y <= level } about a piece's centre, in axes of which the third runs along the columns.
struct Region {
  Matrix3d matrix;
  double level;
};

/// A piece in the axes of the columns.
struct Columns {
  Vector3d center;
  std::vector<Region> regions;  // the first is bounded
  bool upright = false;         // a cylinder: between these heights wherever the region is cut
  Stretch height{0, 0};
  Rectangle shadow;

  /// Adds the intervals of the column over p that are in the piece.
  void cut(const Vector2d& p, std::vector<Stretch>& found) const;
};

/// Takes away where a t^2 + 2 b t + c > 0.
void restrict_to(double a, double b, double c, std::vector<Stretch>& intervals, std::size_t first) {
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0)) {
    if (a > 0 || (a == 0 && c > 0)) intervals.resize(first);
    return;
  }
  // No cancellation: the larger root by its formula, the other from the product.
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  double low = a == 0 ? kInfinity : q / a, high = q == 0 ? 0 : c / q;
  if (a == 0) low = b > 0 ? -kInfinity : kInfinity;  // 2 b t + c <= 0
  if (low > high) std::swap(low, high);
  const std::size_t count = intervals.size();
  for (std::size_t k = first; k < count; ++k) {
    const Stretch i = intervals[k];
    if (a >= 0) {
      intervals[k] = {std::max(i.from, low), std::min(i.to, high)};
    } else {
      intervals[k] = {i.from, std::min(i.to, low)};
      intervals.push_back({std::max(i.from, high), i.to});
    }
  }
  const auto is_empty = [](const Stretch& i) { return !(i.to > i.from); };
  intervals.erase(
      std::remove_if(intervals.begin() + static_cast<std::ptrdiff_t>(first), intervals.end(), is_empty),
      intervals.end());
}

void Columns::cut(const Vector2d& p, std::vector<Stretch>& found) const {
  const Vector3d q(p.x() - center.x(), p.y() - center.y(), 0);
  if (upright) {
    if (q.dot(regions[0].matrix * q) <= regions[0].level) found.push_back(height);
    return;
  }
  const std::size_t first = found.size();
  found.push_back({-kInfinity, kInfinity});
  for (const Region& r : regions) {
    const Vector3d mq = r.matrix * q;
    restrict_to(r.matrix(2, 2), mq.z(), q.dot(mq) - r.level, found, first);
    if (found.size() == first) return;
  }
  for (std::size_t k = first; k < found.size(); ++k) {
    found[k].from += center.z();
    found[k].to += center.z();
  }
}

Columns columns_of(const Piece& piece, const Vector3d& origin, const Matrix3d& axes) {
  Columns c;
  if (piece.footprint) {
    // Footprints come with the axes of space.
    const Ellipse& e = *piece.footprint;
    const Eigen::Matrix2d g = scaled_inverse<2>(e.factor());
    Matrix3d m = Matrix3d::Zero();
    m.topLeftCorner<2, 2>() = g.transpose() * g;
    c.center = Vector3d(e.center().x(), e.center().y(), 0) - origin;
    c.regions.push_back({m, 1});
    c.upright = true;
    c.height = {piece.low - origin.z(), piece.high - origin.z()};
    const Vector2d radius(e.radius(Vector2d::UnitX()), e.radius(Vector2d::UnitY()));
    c.shadow = {c.center.head<2>() - radius, c.center.head<2>() + radius};
    return c;
  }
  const Ellipsoid& e = piece.body.ellipsoid();
  const Matrix3d g = scaled_inverse<3>(e.factor()) * axes;
  c.center = axes.transpose() * (e.center() - origin);
  c.regions.push_back({g.transpose() * g, 1});
  for (const Delimiter<3>& d : piece.body.delimiters())
    c.regions.push_back({axes.transpose() * d.matrix * axes, d.level});
  const Vector2d radius(e.radius(axes.col(0)), e.radius(axes.col(1)));
  c.shadow = {c.center.head<2>() - radius, c.center.head<2>() + radius};
  return c;
}

/// Length of the column over p that is in pieces, counted as often as there are pieces, less counted once.
double counted_too_often(const std::vector<Columns>& pieces, const Vector2d& p, std::vector<Stretch>& found) {
  found.clear();
  for (const Columns& c : pieces)
    if (c.shadow.contains(p)) c.cut(p, found);
  std::sort(found.begin(), found.end(), [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
  double excess = 0, reached = -kInfinity;
  for (const Stretch& i : found) {
    if (i.from < reached) excess += std::min(i.to, reached) - i.from;
    reached = std::max(reached, i.to);
  }
  return excess;
}

/// Over a rectangle, by a Fibonacci lattice of `count` points at four places; the mean and twice the standard
/// deviation of the four.
VolumeEstimate lattice(const std::vector<Columns>& pieces, const Rectangle& box, std::size_t count,
                       std::size_t before) {
  constexpr std::array<std::array<double, 2>, 4> kShifts{
      {{0.125, 0.4142}, {0.375, 0.8934}, {0.625, 0.1371}, {0.875, 0.6718}}};
  const Vector2d size = box.high - box.low;
  const double n = static_cast<double>(count);
  std::array<double, 4> sums{};
  std::vector<Stretch> found;
  for (std::size_t s = 0; s < 4; ++s) {
    for (std::size_t k = 0; k < count; ++k) {
      // The index turns by whole numbers, so that no digit is lost.
      const double along = (static_cast<double>(k) + kShifts[s][0]) / n;
      const double turned = static_cast<double>((k * before) % count) / n + kShifts[s][1];
      const Vector2d p = box.low + size.cwiseProduct(Vector2d(along, turned - std::floor(turned)));
      sums[s] += counted_too_often(pieces, p, found);
    }
    sums[s] *= size.x() * size.y() / n;
  }
  const double mean = 0.25 * (sums[0] + sums[1] + sums[2] + sums[3]);
  double squares = 0;
  for (const double s : sums) squares += (s - mean) * (s - mean);
  return {mean, 2 * std::sqrt(squares / 3)};
}

VolumeEstimate volume_of(const Piece& piece) {
  if (!piece.footprint) return vericone::volume(piece.body);
  const double v = piece.footprint->volume() * (piece.high - piece.low);
  return {v, 16 * std::numeric_limits<double>::epsilon() * v};
}

/// Axes that belong to the pieces: those of the first, its second and third turned towards the others.
Matrix3d axes_of(const std::vector<Piece>& pieces) {
  for (const Piece& p : pieces)
    if (p.footprint) return Matrix3d::Identity();
  Vector3d mean = Vector3d::Zero();
  for (const Piece& p : pieces) mean += (p.body.center() - pieces[0].body.center()) / double(pieces.size());
  Matrix3d axes = pieces[0].body.ellipsoid().axis_directions();
  for (int k = 0; k < 2; ++k)
    if (axes.col(k).dot(mean) < 0) axes.col(k) *= -1;
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

}  // namespace

std::optional<VolumeEstimate> volume(const std::vector<Piece>& pieces) {
  constexpr double kRelative = 2e-6;
  constexpr std::array<std::size_t, 6> kFibonacci{987, 4181, 17711, 75025, 317811, 1346269};
  constexpr std::array<std::size_t, 6> kBefore{610, 2584, 10946, 46368, 196418, 832040};
  if (pieces.empty()) throw InputError("pieces", "none", "at least one");
  const auto is_flat = [](const Piece& p) { return p.footprint && !(p.high > p.low); };
  if (std::all_of(pieces.begin(), pieces.end(), is_flat)) return std::nullopt;

  VolumeEstimate sum;
  for (const Piece& p : pieces) {
    const VolumeEstimate v = volume_of(p);
    sum.value += v.value;
    sum.error += v.error;
  }
  const Matrix3d axes = axes_of(pieces);
  const Piece& first = pieces[0];
  const Vector3d origin =
      first.footprint ? Vector3d(first.footprint->center().x(), first.footprint->center().y(), first.low)
                      : first.body.center();
  std::vector<Columns> columns;
  for (const Piece& p : pieces) columns.push_back(columns_of(p, origin, axes));
  Rectangle box;
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t j = i + 1; j < columns.size(); ++j) {
      const Rectangle common{columns[i].shadow.low.cwiseMax(columns[j].shadow.low),
                             columns[i].shadow.high.cwiseMin(columns[j].shadow.high)};
      if (common.empty()) continue;
      box.low = box.low.cwiseMin(common.low);
      box.high = box.high.cwiseMax(common.high);
    }
  if (box.empty()) return sum;
  for (std::size_t k = 0;; ++k) {
    const VolumeEstimate excess = lattice(columns, box, kFibonacci[k], kBefore[k]);
    const VolumeEstimate all{sum.value - excess.value, sum.error + excess.error};
    if (excess.error <= kRelative * all.value || k + 1 == kFibonacci.size()) return all;
  }
}

}  // namespace vericone::fitting
