// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/sector.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "answers/elementary.h"
#include "combined/source/pole_polar.h"
#include "planar/sector_parts.h"

namespace vericone {
namespace {

using Eigen::Vector2d;

/// A tangent to A through a point of B, as an edge. All coordinates from A's centre.
struct TangentLine {
  SectorEdge edge;
  bool left = false;  // A on its left, seen from A to B

  TangentLine(const Vector2d& on_a, const Vector2d& on_b) {
    edge.point_on_a = on_a;
    edge.point_on_b = on_b;
    edge.direction = (on_b - on_a).normalized();
    left = side(Vector2d::Zero()) > 0;
    edge.normal = (left ? 1 : -1) * Vector2d(edge.direction.y(), -edge.direction.x());
  }
  /// Positive on the left.
  double side(const Vector2d& x) const { return cross(edge.direction, x - edge.point_on_a); }
};

class SourceTangents {
 public:
  SourceTangents(const Ellipse& a, const CombinedEllipse& b, bool keep_both)
      : center_b_(b.center() - a.center()), keep_both_(keep_both), inverse_a_(a.factor().inverse()) {
    // F_1^{-1} where A's centre is the origin: x^T S^{-1} x = 1.
    dual_ << a.shape(), Vector2d::Zero(), Eigen::RowVector2d::Zero(), -1;
    for (const Corner& corner : corners(b)) corners_.push_back(corner.point - a.center());
  }

  bool cornered() const { return !corners_.empty(); }

  /// Steps 2 to 5 for one lost tangent, which was a left one or not, or for both where the ellipses
  /// intersect: the tangents that are left over.
  std::vector<TangentLine> printed(const Vector2d& near) const {
    std::vector<Vector2d> chosen = corners_;
    std::sort(chosen.begin(), chosen.end(), [&](const Vector2d& x, const Vector2d& y) {
      return (x - near).squaredNorm() < (y - near).squaredNorm();
    });
    chosen.resize(std::min<std::size_t>(chosen.size(), 2));
    std::vector<TangentLine> kept;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const std::vector<TangentLine> separating = tangents(chosen[i]);
      if (separating.size() == 2 && (keep_both_ || grazes(chosen[i]))) return separating;  // without step 5
      for (const TangentLine& line : separating)
        if (line.side(chosen[1 - i]) * line.side(center_b_) >= 0) kept.push_back(line);
    }
    return kept;
  }

  /// 6.3.2: from all corners, those with the centres on opposite sides and all corners on one.
  std::vector<TangentLine> by_sides() const {
    std::vector<TangentLine> kept;
    for (const Vector2d& corner : corners_)
      for (const TangentLine& line : tangents(corner)) {
        double lowest = 0, highest = 0;
        for (const Vector2d& other : corners_)
          if (other != corner) {
            lowest = std::min(lowest, line.side(other));
            highest = std::max(highest, line.side(other));
          }
        if (lowest == 0 || highest == 0) kept.push_back(line);
      }
    return kept;
  }

 private:
  /// Step 4: tangents to A through a corner with the centres on opposite sides.
  std::vector<TangentLine> tangents(const Vector2d& corner) const {
    std::vector<TangentLine> kept;
    if (const auto both = tangents_by_polar(dual_, corner))
      for (const PolarTangent& t : *both) {
        const TangentLine line(t.point, corner);
        if (line.side(Vector2d::Zero()) * line.side(center_b_) < 0) kept.push_back(line);
      }
    return kept;
  }

  bool grazes(const Vector2d& corner) const { return (inverse_a_ * corner).norm() < 1 + 1e-9; }

  Vector2d center_b_;
  bool keep_both_;
  Eigen::Matrix2d inverse_a_;
  Eigen::Matrix3d dual_;
  std::vector<Vector2d> corners_;
};

/// The one wanted for the lost side where there is a choice.
std::optional<SectorEdge> pick(const std::vector<TangentLine>& lines, bool left) {
  for (const TangentLine& line : lines)
    if (line.left == left) return line.edge;
  return std::nullopt;
}

}  // namespace

std::optional<Sector> sector_by_source(const Ellipse& a, const CombinedEllipse& b, TangentChoice choice) {
  if (b.delimiters().size() > 1)
    throw InputError("obstacle.hyperboloids", std::to_string(b.delimiters().size()) + " of them",
                     "at most one: the source's procedure knows no more");
  const std::optional<Sector> ellipses = sector_by_degenerate_conics(a, b.ellipsoid());  // Algorithm 3
  if (b.is_ellipsoid() || !ellipses) return ellipses;
  const bool intersect = ellipses->relation != Relation::disjoint;

  // (6.13) with Q_h normalised so that the centre has a negative value.
  const auto on_body = [&](const SectorEdge& edge) {
    return !intersect && b.delimiters()[0].value(edge.point_on_b - b.center()) < 0;
  };
  const bool left_valid = on_body(ellipses->left), right_valid = on_body(ellipses->right);
  if (left_valid && right_valid) return ellipses;

  const SourceTangents source(a, b, choice == TangentChoice::keep_both);
  if (!source.cornered()) return std::nullopt;
  const auto replacement = [&](const SectorEdge& lost, bool left) {
    const Vector2d near =
        intersect ? Vector2d(0.5 * (b.center() - a.center())) : Vector2d(lost.point_on_b - a.center());
    std::optional<SectorEdge> edge =
        pick(choice == TangentChoice::by_sides ? source.by_sides() : source.printed(near), left);
    if (edge) edge->point_on_a += a.center(), edge->point_on_b += a.center();
    return edge;
  };
  const std::optional<SectorEdge> left =
      left_valid ? std::optional(ellipses->left) : replacement(ellipses->left, true);
  const std::optional<SectorEdge> right =
      right_valid ? std::optional(ellipses->right) : replacement(ellipses->right, false);
  if (!left || !right) return std::nullopt;

  Sector sector;
  sector.relation = Relation::disjoint;
  sector.left = *left;
  sector.right = *right;
  sector.psi = std::atan2(cross(right->direction, left->direction), right->direction.dot(left->direction));
  sector.theta_b = bisector_angle(right->direction, sector.psi);
  return sector;
}

}  // namespace vericone
